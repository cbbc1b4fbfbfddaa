// Walking: keys move the eye, dragging turns it.

const keys = { w: [0, 0, 1], s: [0, 0, -1], a: [-1, 0, 0], d: [1, 0, 0], e: [0, 1, 0], q: [0, -1, 0] };
const radiansAPixel = 0.004;

const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (v) => v.map((x) => x / Math.hypot(...v));
const rotated = (v, axis, angle) => {
  const c = Math.cos(angle), s = Math.sin(angle), x = cross(axis, v);
  const along = axis.reduce((sum, a, i) => sum + a * v[i], 0) * (1 - c);
  return v.map((value, i) => value * c + x[i] * s + axis[i] * along);
};

export class Walk {
  /** @param draw shows what the camera sees now */
  constructor(container, camera, draw) {
    this.enabled = false;
    this.speed = 1; // scene units a second
    this.camera = camera;
    this.draw = draw;
    this.pressed = new Set();
    container.addEventListener('pointerdown', (e) => { this.from = [e.clientX, e.clientY]; });
    addEventListener('pointerup', () => { this.from = null; });
    addEventListener('pointermove', (e) => this.turn(e));
    addEventListener('keydown', (e) => {
      if (!this.enabled || e.target.matches?.('select') || e.ctrlKey) return;
      this.fast = e.shiftKey;
      if (!keys[e.key.toLowerCase()] || this.pressed.has(e.key.toLowerCase())) return;
      this.pressed.add(e.key.toLowerCase());
      if (this.pressed.size === 1) this.step(performance.now());
    });
    addEventListener('keyup', (e) => {
      this.fast = e.shiftKey;
      this.pressed.delete(e.key.toLowerCase());
    });
    addEventListener('blur', () => this.pressed.clear());
  }

  frame() {
    const forward = unit(this.camera.getDirectionOfProjection());
    const right = unit(cross(forward, this.camera.getViewUp()));
    return { forward, right, up: cross(right, forward) };
  }

  turn(event) {
    if (!this.enabled || !this.from) return;
    const [dx, dy] = [event.clientX - this.from[0], event.clientY - this.from[1]];
    this.from = [event.clientX, event.clientY];
    const { forward, right } = this.frame();
    const up = unit(this.camera.getViewUp());
    const turned = rotated(rotated(forward, up, -dx * radiansAPixel), right, -dy * radiansAPixel);
    // Not past straight up or down.
    if (Math.hypot(...cross(unit(turned), up)) < 0.05) return;
    this.lookAlong(turned);
    this.draw();
  }

  lookAlong(direction) {
    const eye = this.camera.getPosition(), distance = this.camera.getDistance();
    this.camera.setFocalPoint(...eye.map((x, i) => x + distance * unit(direction)[i]));
  }

  step(before) {
    requestAnimationFrame((now) => {
      if (!this.enabled || this.pressed.size === 0) return;
      const { forward, right, up } = this.frame();
      const distance = (Math.min(now - before, 100) / 1000) * this.speed * (this.fast ? 4 : 1);
      const eye = [...this.camera.getPosition()];
      for (const key of this.pressed)
        for (let i = 0; i < 3; ++i)
          eye[i] += distance * (keys[key][0] * right[i] + keys[key][1] * up[i] + keys[key][2] * forward[i]);
      this.camera.setPosition(...eye);
      this.lookAlong(forward);
      this.draw();
      this.step(now);
    });
  }
}
