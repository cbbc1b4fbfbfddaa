// The page: what is opened, chosen and shown.
import { automaticStops, exposed, luminance, mapColour, mapped } from './colours.js';
import { openDropped, openServed } from './open.js';

const element = (id) => document.getElementById(id);
const state = { shown: false, error: '' };
window.transillum = state; // for whoever drives the page

function say(text, isError = false) {
  element('message').textContent = text;
  element('message').className = isError ? 'error' : '';
  state.error = isError ? text : '';
}

function fail(error) {
  console.error(error);
  element('panel').hidden = true;
  state.shown = false;
  say(error.message, true);
}

function option(select, value, text) {
  select.append(new Option(text, value));
}

/** One value a patch: the luminance where there are three. */
function scalars(array) {
  if (array.components === 1) return array.values;
  return Float32Array.from({ length: array.values.length / array.components },
    (_, i) => luminance(array.values, array.components * i));
}

/** All but a few outliers at either end, which would leave no colours to the rest. */
function range(values) {
  const sorted = Float64Array.from(values).sort();
  const at = (share) => sorted[Math.round(share * (sorted.length - 1))];
  const [low, high] = [at(0.005), at(0.995)];
  return { low, high, isCut: low > sorted[0] || high < sorted.at(-1) };
}

function showBar({ low, high, isCut }, unit) {
  const context = element('gradient').getContext('2d');
  for (let i = 0; i < 256; ++i) {
    context.fillStyle = `rgb(${mapColour(i / 255).join(' ')})`;
    context.fillRect(i, 0, 1, 1);
  }
  [low, 0.5 * (low + high), high].forEach((value, i) => {
    const text = Number(value.toPrecision(3)).toString();
    element('ticks').children[i].textContent = isCut ? ['≤ ', '', '≥ '][i] + text : text;
  });
  element('unit').textContent = unit;
}

class Page {
  constructor(view) {
    this.view = view;
    element('array').addEventListener('change', () => this.colour());
    element('exposure').addEventListener('input', () => this.colour());
    element('camera').addEventListener('change', () => this.look());
    element('walk').addEventListener('change', (e) => { view.setWalk(e.target.checked); e.target.blur(); });
    element('edges').addEventListener('change', (e) => view.setEdges(e.target.checked));
    element('save').addEventListener('click', () => this.save());
  }

  open({ name, mesh }) {
    this.mesh = mesh;
    this.stops = new Map();
    this.view.show(mesh);
    element('name').textContent = name;
    element('array').replaceChildren();
    mesh.arrays.forEach((array, i) => option(element('array'), i, array.label));
    element('camera').replaceChildren();
    mesh.cameras.forEach((camera, i) => option(element('camera'), i, camera.name));
    option(element('camera'), 'all', 'everything');
    element('counts').textContent = `${(mesh.polys.length / 4).toLocaleString('en')} triangles`;
    element('panel').hidden = false;
    say('');
    this.colour();
    this.look();
    state.arrays = mesh.arrays.map((array) => array.name);
    state.cameras = mesh.cameras.map((camera) => camera.name);
    state.shown = true;
  }

  array() {
    return this.mesh.arrays[element('array').value];
  }

  colour() {
    const array = this.array();
    element('exposure-row').hidden = !array.picture || array.isDisplay;
    element('bar').hidden = array.picture;
    if (array.picture) {
      // One exposure for all radiances, so that they can be compared.
      const stops = this.automatic(array) + Number(element('exposure').value || 0);
      element('stops').textContent = `${Number(element('exposure').value) > 0 ? '+' : ''}${element('exposure').value}`;
      this.view.setColours(exposed(array.values, array.isDisplay ? 0 : stops), array.location);
    } else {
      const values = scalars(array);
      const shown = range(values);
      showBar(shown, array.unit);
      this.view.setColours(mapped(values, shown.low, shown.high), array.location);
    }
  }

  automatic(array) {
    const isRadiance = array.name.endsWith('Radiance') || array.name === 'Emission';
    const by = isRadiance ? 'Radiance' : array.name;
    if (!this.stops.has(by)) {
      const values = this.mesh.arrays.find((a) => a.name === by)?.values ?? array.values;
      const emission = this.mesh.arrays.find((a) => a.name === 'Emission')?.values;
      this.stops.set(by, automaticStops(values, emission));
    }
    return this.stops.get(by);
  }

  look() {
    const camera = this.mesh.cameras[element('camera').value];
    if (camera) this.view.look(camera);
    else this.view.lookAtAll();
  }

  async save() {
    const link = document.createElement('a');
    link.href = await this.view.picture();
    link.download = `${element('name').textContent}.png`;
    link.click();
  }
}

/** Files of what was dropped, folders and all: path to File. */
async function droppedFiles(transfer) {
  const files = new Map();
  const add = async (entry) => {
    if (entry.isFile)
      files.set(entry.fullPath.replace(/^\//, ''), await new Promise((ok, no) => entry.file(ok, no)));
    if (!entry.isDirectory) return;
    const reader = entry.createReader();
    for (;;) {
      const some = await new Promise((ok, no) => reader.readEntries(ok, no));
      if (some.length === 0) return;
      for (const child of some) await add(child);
    }
  };
  const entries = [...transfer.items].map((item) => item.webkitGetAsEntry()).filter(Boolean);
  if (entries.length === 0) for (const file of [...transfer.files]) files.set(file.name, file);
  for (const entry of entries) await add(entry);
  return files;
}

async function main() {
  if (!document.createElement('canvas').getContext('webgl2'))
    throw new Error('This browser shows no WebGL 2, which the viewer needs: is it switched off, or the '
      + 'graphics driver missing?');
  const { View } = await import('./view.js');
  const page = new Page(new View(element('view')));
  state.page = page;
  state.open = async (opening) => {
    try {
      say('Opening …');
      page.open(await opening());
    } catch (error) {
      fail(error);
    }
  };
  addEventListener('dragover', (e) => { e.preventDefault(); document.body.classList.add('dropping'); });
  addEventListener('dragleave', () => document.body.classList.remove('dropping'));
  addEventListener('drop', (e) => {
    e.preventDefault();
    document.body.classList.remove('dropping');
    const files = droppedFiles(e.dataTransfer);
    state.open(async () => openDropped(await files));
  });
  const served = document.querySelector('meta[name=solution]')?.content;
  if (served)
    await state.open(() => openServed(new URL(`solution/${encodeURIComponent(served)}`, location.href)));
  else say('Drop a solution here: NAME.vtm together with its folder NAME,\nor a .vtp, .glb or .ply that transillum export wrote.');
}

main().catch(fail);
