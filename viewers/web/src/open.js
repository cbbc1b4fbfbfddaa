// Opens what is dropped or served: a solution's index with its folder, or one file.
import { Problem } from './problem.js';
import { readCameras, readGlb, readPly, readVtp } from './read_mesh.js';

const base = (path) => path.replace(/^.*\//, '');
const readers = { vtp: readVtp, glb: readGlb, ply: readPly };

/** The blocks of a solution's index: name to file. */
function blocksOf(text, file) {
  const xml = new DOMParser().parseFromString(text, 'text/xml');
  const whole = xml.querySelector('VTKFile[type=vtkMultiBlockDataSet] > vtkMultiBlockDataSet');
  if (!whole || xml.querySelector('parsererror'))
    throw new Problem(file, 'is no VTK multi-block file; accepted: what transillum bake writes');
  if (!whole.hasAttribute('transillum_format'))
    throw new Problem(file, 'was not written by transillum; accepted: what transillum bake writes');
  return new Map([...whole.querySelectorAll('DataSet')].map(
    (block) => [block.getAttribute('name'), block.getAttribute('file')]));
}

/** @param get gives the bytes of a file beside the index, or null where it is missing */
async function openSolution(file, text, get) {
  const blocks = blocksOf(text, file);
  const piece = async (name) => {
    const path = blocks.get(name);
    if (!path) throw new Problem(file, `has no block '${name}'`);
    const bytes = await get(path);
    if (!bytes) throw new Problem(path, `is missing; ${base(file)} needs the folder beside it`);
    return bytes;
  };
  const mesh = readVtp(await piece('radiance'), blocks.get('radiance'));
  mesh.cameras = readCameras(await piece('surface'), blocks.get('surface'));
  return mesh;
}

async function openFile(file, bytes) {
  const read = readers[base(file).replace(/^.*\./, '').toLowerCase()];
  if (!read) throw new Problem(file, 'cannot be opened; accepted: .vtm with its folder, .vtp, .glb, .ply');
  return read(bytes, file);
}

/** @param files what was dropped: path to File */
export async function openDropped(files) {
  const paths = [...files.keys()];
  const index = paths.find((path) => path.endsWith('.vtm'));
  // A folder dropped alone: its pieces tell what they are.
  const main = index ?? paths.find((path) => base(path) === 'radiance.vtp') ?? paths[0];
  if (!main) throw new Problem('nothing', 'was dropped; accepted: .vtm with its folder, .vtp, .glb, .ply');
  const name = base(main);
  if (!index) return { name, mesh: await openFile(main, await files.get(main).arrayBuffer()) };
  const get = async (path) => {
    const found = paths.find((p) => p === path || p.endsWith(`/${path}`))
      ?? paths.find((p) => base(p) === base(path));
    return found ? files.get(found).arrayBuffer() : null;
  };
  return { name, mesh: await openSolution(main, await files.get(main).text(), get) };
}

/** @param url of what a server holds */
export async function openServed(url) {
  const get = async (path) => {
    const response = await fetch(new URL(path, url));
    return response.ok ? response.arrayBuffer() : null;
  };
  const name = decodeURIComponent(base(url.pathname));
  const bytes = await get(url);
  if (!bytes) throw new Problem(name, 'is not served');
  const encoded = (path) => get(path.split('/').map(encodeURIComponent).join('/'));
  const mesh = name.endsWith('.vtm')
    ? await openSolution(name, new TextDecoder().decode(bytes), encoded) : await openFile(name, bytes);
  return { name, mesh };
}
