// A headless Chromium, and what a solution looks like in it.
import puppeteer from 'puppeteer-core';

const software = ['--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'];

/** @param without WebGL */
export function launch({ without = false } = {}) {
  return puppeteer.launch({
    executablePath: process.env.CHROMIUM,
    // There is no sandbox for root.
    args: ['--no-sandbox', ...(without ? ['--disable-3d-apis'] : software)],
  });
}

/** Opens the page and waits until it shows something or says why not. */
export async function visit(browser, url, [width, height] = [500, 500]) {
  const page = await browser.newPage();
  await page.setViewport({ width, height });
  await page.goto(url);
  await settled(page);
  return page;
}

export async function settled(page) {
  await page.waitForFunction('window.transillum?.shown || window.transillum?.error', { timeout: 60000 });
}

export const said = (page) => page.$eval('#message', (message) => message.textContent);

/** Drops files on the page: [[name, bytes]]. */
export async function drop(page, files) {
  await page.evaluate((named) => {
    const transfer = new DataTransfer();
    for (const [name, base64] of named)
      transfer.items.add(new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], name));
    Object.assign(window.transillum, { shown: false, error: '' });
    dispatchEvent(new DragEvent('drop', { dataTransfer: transfer }));
  }, files.map(([name, bytes]) => [name, Buffer.from(bytes).toString('base64')]));
  await settled(page);
}

/** Mean absolute difference [1] of what the page shows, without its panel, from a PNG. */
export async function differenceFrom(page, png) {
  await page.$eval('#panel', (panel) => { panel.style.visibility = 'hidden'; });
  const shot = await page.screenshot({ encoding: 'base64' });
  return page.evaluate(async (pictures) => {
    const pixels = await Promise.all(pictures.map(async (base64) => {
      const image = new Image();
      image.src = `data:image/png;base64,${base64}`;
      await image.decode();
      const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
      context.drawImage(image, 0, 0);
      return context.getImageData(0, 0, image.width, image.height).data;
    }));
    let sum = 0;
    pixels[0].forEach((x, i) => { sum += i % 4 < 3 ? Math.abs(x - pixels[1][i]) : 0; });
    return sum / 255 / (0.75 * pixels[0].length);
  }, [shot, Buffer.from(png).toString('base64')]);
}
