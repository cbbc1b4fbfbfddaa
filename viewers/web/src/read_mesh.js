// Files to what is shown: { points, polys, arrays: [quantity with values and location], cameras }.
// Of .vtp files vtk.js reads the arrays; .glb and .ply are those that `transillum export` writes.
import vtkXMLPolyDataReader from '@kitware/vtk.js/IO/XML/XMLPolyDataReader.js';
import { Problem } from './problem.js';
import { quantities } from './quantities.js';

function readPolyData(bytes, file) {
  const reader = vtkXMLPolyDataReader.newInstance();
  try {
    reader.parseAsArrayBuffer(bytes);
  } catch (error) {
    throw new Problem(file, `cannot be read (${error.message}); accepted: a whole .vtp file`);
  }
  const data = reader.getOutputData(0);
  if (!data?.getPoints) throw new Problem(file, 'holds no PolyData; accepted: .vtp');
  return data;
}

function arraysOf(data, file) {
  const arrays = [];
  const places = [['cell', data.getCellData(), data.getPolys().getNumberOfCells()],
    ['point', data.getPointData(), data.getPoints().getNumberOfPoints()]];
  for (const quantity of quantities)
    for (const [location, attributes, count] of places) {
      const array = attributes.getArrayByName(quantity.name);
      if (!array) continue;
      const components = array.getNumberOfComponents();
      const values = array.getData();
      if (values.length !== count * components)
        throw new Problem(file, `array '${quantity.name}' holds ${values.length / components} `
          + `values; accepted: ${count}, one a ${location}`);
      arrays.push({ ...quantity, location, components, values });
    }
  if (arrays.length === 0)
    throw new Problem(file, 'holds none of the arrays of a solution, as Radiance');
  return arrays;
}

export function readVtp(bytes, file) {
  const data = readPolyData(bytes, file);
  const points = Float64Array.from(data.getPoints().getData());
  const count = points.length / 3;
  const polys = Uint32Array.from(data.getPolys().getData());
  if (count === 0 || polys.length === 0) throw new Problem(file, 'holds no triangles');
  for (let i = 0; i < polys.length; i += 4)
    if (polys[i] !== 3 || Math.max(polys[i + 1], polys[i + 2], polys[i + 3]) >= count)
      throw new Problem(file, `cell ${i / 4} is no triangle of its ${count} points`);
  return { points, polys, arrays: arraysOf(data, file), cameras: [] };
}

/** Cameras of a solution's surface.vtp. */
export function readCameras(bytes, file) {
  const fields = readPolyData(bytes, file).getFieldData();
  const array = (name) => fields.getArrayByName(name)?.getData() ?? [];
  const eyes = array('CameraEye');
  const [at, up, fov] = ['CameraLookAt', 'CameraUp', 'CameraVerticalFov'].map(array);
  const names = array('CameraName');
  const vector = (values, i) => Array.from(values.slice(3 * i, 3 * i + 3));
  return Array.from({ length: eyes.length / 3 }, (_, i) => ({
    name: names[i] ?? `camera ${i + 1}`,
    eye: vector(eyes, i), lookAt: vector(at, i), up: vector(up, i), fov: fov[i],
  }));
}

function triangles(indices) {
  const polys = new Uint32Array((indices.length / 3) * 4);
  for (let i = 0, to = 0; i < indices.length; i += 3) {
    polys[to++] = 3;
    for (let c = 0; c < 3; ++c) polys[to++] = indices[i + c];
  }
  return polys;
}

const display = { label: 'Display colours', unit: '', picture: true, isDisplay: true };

/** What `export` writes: meshes with COLOR_0 under one translated node. */
export function readGlb(bytes, file) {
  const view = new DataView(bytes);
  if (bytes.byteLength < 28 || view.getUint32(0, true) !== 0x46546c67
      || view.getUint32(8, true) !== bytes.byteLength)
    throw new Problem(file, 'is no whole binary glTF file');
  const length = view.getUint32(12, true);
  let json;
  try {
    json = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 20, length)));
  } catch (error) {
    throw new Problem(file, `holds no JSON (${error.message})`);
  }
  if (json.asset?.generator !== 'transillum' || !json.materials?.[0]?.extensions?.KHR_materials_unlit)
    throw new Problem(file, 'is of another program; accepted: what transillum export writes');
  const start = 20 + length + 8;
  const values = (number, Type, components) => {
    const accessor = json.accessors[number];
    const { byteOffset } = json.bufferViews[accessor.bufferView];
    return new Type(bytes, start + byteOffset, accessor.count * components);
  };
  const points = [], colours = [], indices = [];
  const move = json.nodes.find((n) => n.translation)?.translation ?? [0, 0, 0];
  for (const mesh of json.meshes ?? [])
    for (const primitive of mesh.primitives) {
      if (primitive.attributes.COLOR_0 === undefined)
        throw new Problem(file, 'holds no COLOR_0, as with a lightmap; accepted: what transillum export writes without one');
      const first = points.length / 3;
      values(primitive.attributes.POSITION, Float32Array, 3)
        .forEach((x, i) => points.push(x + move[i % 3]));
      values(primitive.attributes.COLOR_0, Float32Array, 3).forEach((x) => colours.push(x));
      values(primitive.indices, Uint32Array, 1).forEach((i) => indices.push(first + i));
    }
  if (indices.length === 0) throw new Problem(file, 'holds no triangles');
  return {
    points: Float64Array.from(points), polys: triangles(indices), cameras: [],
    arrays: [{ ...display, name: 'COLOR_0', location: 'point', components: 3,
      values: Float32Array.from(colours) }],
  };
}

/** What `export` writes: vertices of 39 bytes, of which the last 12 are the radiance. */
export function readPly(bytes, file) {
  const text = new TextDecoder('latin1').decode(new Uint8Array(bytes, 0, Math.min(bytes.byteLength, 2048)));
  const end = text.indexOf('end_header\n') + 11;
  const [vertices, faces] = ['vertex', 'face'].map(
    (what) => Number(text.match(new RegExp(`element ${what} (\\d+)`))?.[1] ?? 0));
  if (end < 11 || !text.includes('property float radiance_b\nelement face')
      || bytes.byteLength !== end + 39 * vertices + 13 * faces)
    throw new Problem(file, 'is no whole PLY file with radiance; accepted: what transillum export writes');
  const view = new DataView(bytes, end);
  const points = new Float64Array(3 * vertices), values = new Float32Array(3 * vertices);
  for (let v = 0; v < vertices; ++v)
    for (let c = 0; c < 3; ++c) {
      points[3 * v + c] = view.getFloat64(39 * v + 8 * c, true);
      values[3 * v + c] = view.getFloat32(39 * v + 27 + 4 * c, true);
    }
  const indices = new Uint32Array(3 * faces);
  for (let f = 0; f < faces; ++f)
    for (let c = 0; c < 3; ++c)
      indices[3 * f + c] = view.getUint32(39 * vertices + 13 * f + 1 + 4 * c, true);
  return { points, polys: triangles(indices), cameras: [],
    arrays: [{ ...quantities[0], location: 'point', components: 3, values }] };
}
