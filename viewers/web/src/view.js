// The picture: vtk.js draws the triangles in the colours that it is given, and lights nothing.
import '@kitware/vtk.js/Rendering/Profiles/Geometry.js';
import vtkActor from '@kitware/vtk.js/Rendering/Core/Actor.js';
import vtkDataArray from '@kitware/vtk.js/Common/Core/DataArray.js';
import vtkGenericRenderWindow from '@kitware/vtk.js/Rendering/Misc/GenericRenderWindow.js';
import vtkInteractorStyleTrackballCamera
  from '@kitware/vtk.js/Interaction/Style/InteractorStyleTrackballCamera.js';
import vtkMapper from '@kitware/vtk.js/Rendering/Core/Mapper.js';
import vtkPolyData from '@kitware/vtk.js/Common/DataModel/PolyData.js';
import { closeSeams } from './close_seams.js';
import { Walk } from './walk.js';

const background = [0.086, 0.094, 0.106];

export class View {
  constructor(container) {
    this.window = vtkGenericRenderWindow.newInstance({ background, listenWindowResize: true });
    this.window.setContainer(container);
    this.renderer = this.window.getRenderer();
    this.camera = this.renderer.getActiveCamera();
    this.interactor = this.window.getInteractor();
    this.orbit = vtkInteractorStyleTrackballCamera.newInstance();
    this.interactor.setInteractorStyle(this.orbit);
    this.walk = new Walk(container, this.camera, () => this.draw());
    new ResizeObserver(() => { this.window.resize(); this.draw(); }).observe(container);
    this.window.resize();
  }

  show(mesh) {
    this.mesh = mesh.arrays.some((array) => array.name === 'Level') ? closeSeams(mesh) : mesh;
    const { points, polys } = this.mesh;
    this.data = vtkPolyData.newInstance();
    // Floats about the middle: far from the origin they would be too coarse.
    const box = this.box = boxOf(points);
    this.middle = box.low.map((low, c) => 0.5 * (low + box.high[c]));
    this.data.getPoints().setData(
      Float32Array.from(points, (x, i) => x - this.middle[i % 3]), 3);
    this.data.getPolys().setData(polys);
    this.mapper = vtkMapper.newInstance();
    this.mapper.setInputData(this.data);
    this.mapper.setColorModeToDirectScalars();
    this.actor = vtkActor.newInstance();
    this.actor.setMapper(this.mapper);
    const property = this.actor.getProperty();
    property.setLighting(false);
    // Front and back of a surface lie in one place.
    property.setBackfaceCulling(true);
    property.setEdgeColor(0.1, 0.1, 0.1);
    property.setEdgeVisibility(Boolean(this.edges));
    this.renderer.removeAllViewProps();
    this.renderer.addActor(this.actor);
    this.size = Math.hypot(...box.high.map((high, c) => high - box.low[c]));
    this.walk.speed = 0.2 * this.size;
  }

  /** @param bytes RGB, one a cell or point */
  setColours(bytes, location) {
    const isCell = location === 'cell';
    const { cellOf } = this.mesh;
    const values = !isCell || !cellOf ? bytes
      : Uint8Array.from({ length: 3 * cellOf.length },
        (_, i) => bytes[3 * cellOf[Math.floor(i / 3)] + (i % 3)]);
    const array = vtkDataArray.newInstance({ name: 'Colours', numberOfComponents: 3, values });
    this.data.getCellData().setScalars(isCell ? array : null);
    this.data.getPointData().setScalars(isCell ? null : array);
    if (isCell) this.mapper.setScalarModeToUseCellData();
    else this.mapper.setScalarModeToUsePointData();
    this.data.modified();
    this.draw();
  }

  setEdges(on) {
    this.edges = on;
    this.actor.getProperty().setEdgeVisibility(on);
    this.draw();
  }

  setWalk(on) {
    this.interactor.setInteractorStyle(on ? null : this.orbit);
    this.walk.enabled = on;
  }

  look({ eye, lookAt, up, fov }) {
    const local = (p) => p.map((x, c) => x - this.middle[c]);
    this.camera.setPosition(...local(eye));
    this.camera.setFocalPoint(...local(lookAt));
    this.camera.setViewUp(...up);
    if (fov) this.camera.setViewAngle(fov);
    this.draw();
  }

  /** All of it, from the side. */
  lookAtAll() {
    this.camera.setViewAngle(45);
    this.camera.setPosition(0.35 * this.size, 0.3 * this.size, this.size);
    this.camera.setFocalPoint(0, 0, 0);
    this.camera.setViewUp(0, 1, 0);
    this.renderer.resetCamera();
    this.draw();
  }

  draw() {
    if (!this.mesh) return;
    // Near enough to stand before a wall, far enough to see the whole.
    const distance = Math.hypot(...this.camera.getPosition());
    this.camera.setClippingRange(1e-4 * this.size, distance + this.size);
    this.window.getRenderWindow().render();
  }

  async picture() {
    return this.window.getRenderWindow().captureImages()[0];
  }
}

function boxOf(points) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; ++i) {
    low[i % 3] = Math.min(low[i % 3], points[i]);
    high[i % 3] = Math.max(high[i % 3], points[i]);
  }
  return { low, high };
}
