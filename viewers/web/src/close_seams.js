// Where patches differ in size, a vertex of the smaller lies within an edge of the larger, and
// rounding leaves pinholes between them. The larger one takes part in that vertex here: it becomes
// a fan about its middle. Vertices are midpoints of edges, exactly (of doubles): they are found by
// their place.

/** Numbers of points by their place. */
class Places {
  constructor(points) {
    this.points = points;
    this.mask = 2 ** Math.ceil(Math.log2((points.length / 3) * 2)) - 1;
    this.table = new Int32Array(this.mask + 1).fill(-1);
    this.bits = new Uint32Array(6);
    this.key = new Float64Array(this.bits.buffer);
    for (let i = 0; i < points.length / 3; ++i) {
      const slot = this.slot(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
      if (this.table[slot] < 0) this.table[slot] = i;
    }
  }

  /** Where a point at this place is, or would be. */
  slot(x, y, z) {
    // -0 is 0.
    this.key[0] = x + 0;
    this.key[1] = y + 0;
    this.key[2] = z + 0;
    let hash = 0x811c9dc5;
    for (const word of this.bits) {
      hash = Math.imul(hash ^ word, 0x01000193);
      hash ^= hash >>> 15;
    }
    for (let slot = hash & this.mask; ; slot = (slot + 1) & this.mask) {
      const i = 3 * this.table[slot];
      if (i < 0 || (this.points[i] === x && this.points[i + 1] === y && this.points[i + 2] === z))
        return slot;
    }
  }

  at(x, y, z) {
    return this.table[this.slot(x, y, z)];
  }
}

/** @returns triangles and the cell that each is of: { points, polys, cellOf } */
export function closeSeams({ points, polys }) {
  const places = new Places(points);
  const coordinate = (i, c) => points[3 * i + c];
  const middle = (a, b) => [0, 1, 2].map((c) => 0.5 * (coordinate(a, c) + coordinate(b, c)));
  const ring = [];
  /** Adds what lies between two ends, and the second. */
  const walk = (a, b) => {
    const between = places.at(...middle(a, b));
    if (between >= 0 && between !== a && between !== b) {
      walk(a, between);
      walk(between, b);
    } else {
      ring.push(b);
    }
  };
  const added = [], closed = [], cellOf = [];
  const add = (cell, a, b, c) => {
    closed.push(3, a, b, c);
    cellOf.push(cell);
  };
  for (let i = 0; i < polys.length; i += 4) {
    const [a, b, c] = polys.subarray(i + 1, i + 4);
    ring.length = 0;
    walk(a, b);
    walk(b, c);
    walk(c, a);
    if (ring.length === 3) {
      add(i / 4, a, b, c);
      continue;
    }
    const centre = points.length / 3 + added.length / 3;
    for (let k = 0; k < 3; ++k)
      added.push((coordinate(a, k) + coordinate(b, k) + coordinate(c, k)) / 3);
    ring.forEach((from, k) => add(i / 4, from, ring[(k + 1) % ring.length], centre));
  }
  const all = new Float64Array(points.length + added.length);
  all.set(points);
  all.set(added, points.length);
  return { points: all, polys: Uint32Array.from(closed), cellOf: Uint32Array.from(cellOf) };
}
