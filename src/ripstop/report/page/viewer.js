// The scene: camera, light and what is under the pointer. Drawn when something changed, not all the time.
"use strict";

class Viewer {
  constructor(stage) {
    this.stage = stage;
    this.renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "application");
    this.canvas.setAttribute("aria-label", "Canopy in 3D. Arrow keys turn, plus and minus zoom, 1 to 4 choose a view.");
    stage.append(this.canvas);
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(30, 1, 0.01, 1000);
    this.camera.up.set(0, 0, 1);
    this.controls = new THREE.OrbitControls(this.camera, this.canvas);
    this.controls.addEventListener("change", () => this.draw());
    this.canopy = this.air = null;
    this.waiting = false;
    new ResizeObserver(() => this.resize()).observe(stage);
  }

  show(canopy, air) {
    for (const old of [this.canopy, this.air]) if (old) old.dispose();
    this.scene.clear();
    this.canopy = canopy;
    this.air = air;
    this.scene.add(canopy.mesh, canopy.lines.mesh);
    if (canopy.trail) this.scene.add(canopy.trail.mesh);
    if (air) this.scene.add(air.plane, air.streamlines.mesh);
    const [low, high] = canopy.bounds();
    this.middle = new THREE.Vector3((low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2);
    this.resize();
    this.look("oblique");
  }

  /** "oblique", "side", "below" (into the mouth), "above". */
  look(view) {
    const direction = { oblique: [0.72, -0.62, 0.3], side: [1, 0, 0.0001], below: [0, -0.0001, -1], above: [0, -0.0001, 1] }[view];
    const toward = new THREE.Vector3(...direction).normalize();
    const distance = this.fitting(toward);
    this.controls.target.copy(this.middle);
    this.camera.position.copy(this.middle).addScaledVector(toward, distance);
    this.camera.near = distance / 100;
    this.camera.far = 20 * distance;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.draw();
  }

  /** How far away, seen from `toward`, all of the canopy fits the stage: d >= z + |x| / tan(half the angle). */
  fitting(toward) {
    const right = new THREE.Vector3().crossVectors(this.camera.up, toward).normalize(), up = new THREE.Vector3().crossVectors(toward, right);
    const tall = Math.tan((Math.PI / 360) * this.camera.fov), wide = tall * this.camera.aspect;
    const p = this.canopy.points, at = new THREE.Vector3();
    let distance = 0;
    for (let i = 0; i < p.length; i += 3) {
      at.set(p[i], p[i + 1], p[i + 2]).sub(this.middle);
      distance = Math.max(distance, at.dot(toward) + Math.max(Math.abs(at.dot(right)) / wide, Math.abs(at.dot(up)) / tall));
    }
    return 1.06 * distance;
  }

  /** About the axis by `turn` and over it by `tilt` [rad], nearer by `zoom`. */
  turn(turn, tilt, zoom = 1) {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const distance = offset.length() * zoom;
    const azimuth = Math.atan2(offset.y, offset.x) + turn;
    const height = Math.min(1.55, Math.max(-1.55, Math.asin(offset.z / offset.length()) + tilt));
    offset.set(Math.cos(height) * Math.cos(azimuth), Math.cos(height) * Math.sin(azimuth), Math.sin(height)).multiplyScalar(distance);
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.draw();
  }

  resize(width = this.stage.clientWidth, height = this.stage.clientHeight) {
    if (!width || !height) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  draw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => { this.waiting = false; this.drawNow(); });
  }

  drawNow() {
    if (!this.canopy) return;
    const size = this.renderer.getDrawingBufferSize(new THREE.Vector2());
    for (const lines of [this.canopy.lines, this.canopy.trail, this.air?.streamlines]) if (lines) {
      lines.material.uniforms.screen.value.copy(size);
      lines.material.uniforms.width.value = (lines === this.air?.streamlines ? 1.1 : 1.4) * Math.max(1, size.y / 700);
    }
    this.renderer.setClearColor(new THREE.Color(Colours.variable("--scene")), 1);
    this.renderer.render(this.scene, this.camera);
    this.stage.dispatchEvent(new Event("drawn"));
  }

  /** On the stage [px]. */
  project(point) {
    const p = new THREE.Vector3(...point).project(this.camera);
    return [(0.5 + 0.5 * p.x) * this.stage.clientWidth, (0.5 - 0.5 * p.y) * this.stage.clientHeight];
  }

  /** The nearest cell under a place on the stage, with the ray's length to it; null where there is none. */
  cellAt(x, y) {
    const from = this.camera.position;
    const toward = new THREE.Vector3((2 * x) / this.stage.clientWidth - 1, 1 - (2 * y) / this.stage.clientHeight, 0.5)
      .unproject(this.camera).sub(from).normalize();
    const p = this.canopy.points, quads = this.canopy.shape.quads;
    let best = null, nearest = Infinity;
    for (let q = 0; q < quads.length; q += 4)
      for (let half = 0; half < 2; ++half) {
        const t = Viewer.hit(p, 3 * quads[q], 3 * quads[q + 1 + half], 3 * quads[q + 2 + half], from, toward);
        if (t < nearest) { nearest = t; best = q / 4; }
      }
    return best === null ? null : { cell: best, distance: nearest };
  }

  // Moeller and Trumbore (1997): the ray's length to the triangle, infinite where it misses.
  static hit(p, a, b, c, from, toward) {
    const e1x = p[b] - p[a], e1y = p[b + 1] - p[a + 1], e1z = p[b + 2] - p[a + 2];
    const e2x = p[c] - p[a], e2y = p[c + 1] - p[a + 1], e2z = p[c + 2] - p[a + 2];
    const hx = toward.y * e2z - toward.z * e2y, hy = toward.z * e2x - toward.x * e2z, hz = toward.x * e2y - toward.y * e2x;
    const det = e1x * hx + e1y * hy + e1z * hz;
    if (Math.abs(det) < 1e-18) return Infinity;
    const sx = from.x - p[a], sy = from.y - p[a + 1], sz = from.z - p[a + 2];
    const u = (sx * hx + sy * hy + sz * hz) / det;
    if (u < 0 || u > 1) return Infinity;
    const qx = sy * e1z - sz * e1y, qy = sz * e1x - sx * e1z, qz = sx * e1y - sy * e1x;
    const v = (toward.x * qx + toward.y * qy + toward.z * qz) / det;
    if (v < 0 || u + v > 1) return Infinity;
    const t = (e2x * qx + e2y * qy + e2z * qz) / det;
    return t > 0 ? t : Infinity;
  }

  /** The line segment within a few pixels of a place, the nearest to the eye's place on the screen. */
  segmentAt(x, y, within = 5) {
    const { segments } = this.canopy.shape, p = this.canopy.points;
    let best = null, nearest = within;
    for (let s = 0; s < segments.length; s += 2) {
      const [ax, ay] = this.project(p.subarray(3 * segments[s], 3 * segments[s] + 3));
      const [bx, by] = this.project(p.subarray(3 * segments[s + 1], 3 * segments[s + 1] + 3));
      const length = (bx - ax) ** 2 + (by - ay) ** 2;
      const t = length > 0 ? Math.min(1, Math.max(0, ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / length)) : 0;
      const away = Math.hypot(ax + t * (bx - ax) - x, ay + t * (by - ay) - y);
      if (away < nearest) { nearest = away; best = s / 2; }
    }
    return best;
  }

  /** A still picture [px] as a data address, for paper. */
  picture(width, height) {
    const ratio = this.renderer.getPixelRatio();
    this.renderer.setPixelRatio(1);
    this.resize(width, height);
    this.drawNow();
    const address = this.canvas.toDataURL("image/jpeg", 0.9);
    this.renderer.setPixelRatio(ratio);
    this.resize();
    return address;
  }
}
