// What the arrays of a solution mean, in the order of the menu.

const radiance = 'W sr⁻¹ m⁻²';

/** name: label, unit; `picture`: shown as an exposed picture, else by a map of its values, of which
 * those with three channels are luminances. */
export const quantities = [
  { name: 'Radiance', label: 'Radiance, total', unit: radiance, picture: true },
  { name: 'Emission', label: 'Emission', unit: radiance, picture: true },
  { name: 'DirectRadiance', label: 'Direct', unit: radiance, picture: true },
  { name: 'FiniteElementRadiance', label: 'Finite elements (indirect)', unit: radiance, picture: true },
  { name: 'DirectIrradiance', label: 'Irradiance, direct', unit: 'W m⁻²', picture: true },
  { name: 'IndirectIrradiance', label: 'Irradiance, indirect', unit: 'W m⁻²', picture: true },
  { name: 'StandardError', label: 'Standard error', unit: radiance },
  { name: 'Level', label: 'Level of subdivision', unit: '' },
  { name: 'ErrorSpatial', label: 'V_s, spatial error', unit: 'W² sr⁻² m⁻⁴' },
  { name: 'ErrorDirectional', label: 'V_d, directional error', unit: 'W² sr⁻² m⁻⁴' },
  { name: 'Coverage', label: 'Coverage', unit: 'fragments' },
  { name: 'Area', label: 'Area', unit: 'scene units²' },
  { name: 'SourceObject', label: 'Object', unit: 'number' },
  { name: 'Material', label: 'Material', unit: 'number' },
];
