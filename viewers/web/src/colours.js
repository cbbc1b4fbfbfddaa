// From values to colours. Radiance is shown as `transillum render` shows it: exposed, a shoulder
// that keeps hues, the curve of sRGB. Other values: a map from dark to bright (viridis).

const shoulder = 0.6;
const middleGrey = 0.18;

const srgb = new Uint8Array(4097).map((_, i) => {
  const x = i / 4096;
  return Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055));
});

export function luminance(values, i) {
  return 0.2126 * values[i] + 0.7152 * values[i + 1] + 0.0722 * values[i + 2];
}

/** Stops that show the median luminance of what is lit and no emitter as middle grey. */
export function automaticStops(radiance, emission) {
  const lit = [];
  for (let i = 0; i < radiance.length; i += 3) {
    if (emission && luminance(emission, i) > 0) continue;
    const y = luminance(radiance, i);
    if (y > 0) lit.push(y);
  }
  if (lit.length === 0) return 0;
  const median = Float64Array.from(lit).sort()[lit.length >> 1];
  return Math.log2(middleGrey / median);
}

/** Bytes of RGB from linear radiance. */
export function exposed(radiance, stops) {
  const factor = 2 ** stops;
  const bytes = new Uint8Array(radiance.length);
  for (let i = 0; i < radiance.length; i += 3) {
    const peak = factor * Math.max(radiance[i], radiance[i + 1], radiance[i + 2]);
    const range = 1 - shoulder;
    const scale = peak <= shoulder
      ? factor : (factor * (1 - range * Math.exp((shoulder - peak) / range))) / peak;
    for (let c = 0; c < 3; ++c) {
      const x = Math.min(Math.max(radiance[i + c] * scale, 0), 1);
      bytes[i + c] = srgb[Math.round(4096 * x)];
    }
  }
  return bytes;
}

const viridis = [[68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141],
  [39, 173, 129], [92, 200, 99], [170, 220, 50], [253, 231, 37]];

export function mapColour(share) {
  const x = Math.min(Math.max(share, 0), 1) * (viridis.length - 1);
  const i = Math.min(Math.floor(x), viridis.length - 2);
  return viridis[i].map((low, c) => Math.round(low + (viridis[i + 1][c] - low) * (x - i)));
}

export function mapped(values, low, high) {
  const bytes = new Uint8Array(3 * values.length);
  const table = Array.from({ length: 256 }, (_, i) => mapColour(i / 255));
  const scale = high > low ? 255 / (high - low) : 0;
  for (let i = 0; i < values.length; ++i) {
    const entry = table[Math.min(Math.max(Math.round((values[i] - low) * scale), 0), 255)];
    bytes.set(entry, 3 * i);
  }
  return bytes;
}
