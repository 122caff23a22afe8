// Canopy and lines of one run as geometry that follows the frames of an opening.
"use strict";

const noValue = 3e38;  // what the shaders draw grey

/** Straight pieces of lines, each with a value at either end. */
class Segments {
  constructor(count, scale, width) {
    this.geometry = new THREE.InstancedBufferGeometry();
    this.geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array([-1, 0, 0, 1, 0, 0, 1, 1, 0, -1, 1, 0]), 3));
    this.geometry.setIndex([0, 1, 2, 0, 2, 3]);
    this.head = new THREE.InstancedBufferAttribute(new Float32Array(3 * count), 3);
    this.tail = new THREE.InstancedBufferAttribute(new Float32Array(3 * count), 3);
    this.values = new THREE.InstancedBufferAttribute(new Float32Array(2 * count), 2);
    this.geometry.setAttribute("head", this.head);
    this.geometry.setAttribute("tail", this.tail);
    this.geometry.setAttribute("values", this.values);
    this.geometry.instanceCount = count;
    this.material = Materials.lines(scale, width);
    this.mesh = new THREE.Mesh(this.geometry, this.material);
    this.mesh.frustumCulled = false;
  }
  changed() {
    this.head.needsUpdate = this.tail.needsUpdate = this.values.needsUpdate = true;
  }
  dispose() {
    this.geometry.dispose();
    this.material.uniforms.ramp.value.dispose();
    this.material.dispose();
  }
}

/** Between which of its frames an opening is at `time`. */
function between(frames, time) {
  let low = 0;
  while (low + 2 < frames.length && frames[low + 1].time <= time) ++low;
  const high = Math.min(low + 1, frames.length - 1);
  const span = frames[high].time - frames[low].time;
  return { low, high, weight: span > 0 ? Math.min(1, Math.max(0, (time - frames[low].time) / span)) : 0 };
}

class Canopy {
  constructor(shape) {
    this.shape = shape;
    this.points = new Float32Array(shape.frames[0].points);
    this.cells = shape.quads.length / 4;
    const vertices = 6 * this.cells;
    this.geometry = new THREE.BufferGeometry();
    for (const [name, size] of [["position", 3], ["normal", 3], ["value", 1]])
      this.geometry.setAttribute(name, new THREE.BufferAttribute(new Float32Array(size * vertices), size));
    this.material = Materials.cloth(Colours.clothScale());
    this.mesh = new THREE.Mesh(this.geometry, this.material);
    this.mesh.frustumCulled = false;
    this.normals = new Float32Array(this.points.length);
    this.values = new Float32Array(this.cells).fill(NaN);
    this.lines = new Segments(shape.segments.length / 2, Colours.clothScale(), 1.4);
    this.trail = shape.path ? new Segments(shape.path.times.length - 1, Colours.clothScale(), 1.4) : null;
    this.tension = null;
    this.time = shape.frames[shape.frames.length - 1].time;
  }

  /** Quantities that at least one frame has. */
  quantities() {
    const all = new Map();
    for (const frame of this.shape.frames)
      for (const cell of frame.cells) if (!all.has(cell.key)) all.set(cell.key, cell);
    return [...all.values()];
  }

  valuesIn(frame, key) {
    const found = frame.cells.find((cell) => cell.key === key);
    return found ? found.values : null;
  }

  /** [low, high] over all frames; but for `clipped` of the values at either end. */
  range(key, clipped) {
    return Canopy.rangeOf(this.shape.frames.map((frame) => this.valuesIn(frame, key)), clipped);
  }
  tensionRange() {
    const [low, high] = Canopy.rangeOf(this.shape.frames.map((frame) => frame.tension ?? null), 0);
    return [Math.max(0, low), high];
  }
  static rangeOf(lists, clipped) {
    let low = Infinity, high = -Infinity;
    for (const values of lists) {
      if (!values) continue;
      const sorted = Float32Array.from(values.filter((value) => !Number.isNaN(value))).sort();
      if (!sorted.length) continue;
      const skipped = Math.floor(clipped * (sorted.length - 1));
      low = Math.min(low, sorted[skipped]);
      high = Math.max(high, sorted[sorted.length - 1 - skipped]);
    }
    if (!(low <= high)) return [0, 1];
    return low === high ? [low - 0.5, high + 0.5] : [low, high];
  }

  /** Shape and values at a time, coloured by `key`. */
  set(time, key) {
    const { low, high, weight } = between(this.shape.frames, time);
    const a = this.shape.frames[low], b = this.shape.frames[high];
    this.time = time;
    for (let i = 0; i < this.points.length; ++i) this.points[i] = a.points[i] + weight * (b.points[i] - a.points[i]);
    // A frame without values, the folded start, takes its neighbour's place in the mean.
    const va = this.valuesIn(a, key) ?? this.valuesIn(b, key), vb = this.valuesIn(b, key) ?? va;
    for (let i = 0; i < this.cells; ++i) this.values[i] = va ? va[i] + weight * (vb[i] - va[i]) : NaN;
    const ta = a.tension ?? b.tension ?? null, tb = b.tension ?? ta;
    this.tension = ta ? Float32Array.from(ta, (value, i) => value + weight * (tb[i] - value)) : null;
    this.updateNormals();
    this.updateCloth();
    this.updateLines();
    if (this.trail) this.updateTrail();
  }

  updateNormals() {
    const { points: p, normals: n } = this, quads = this.shape.quads;
    n.fill(0);
    for (let q = 0; q < quads.length; q += 4) {
      const a = 3 * quads[q], b = 3 * quads[q + 1], c = 3 * quads[q + 2], d = 3 * quads[q + 3];
      const ux = p[c] - p[a], uy = p[c + 1] - p[a + 1], uz = p[c + 2] - p[a + 2];
      const vx = p[d] - p[b], vy = p[d + 1] - p[b + 1], vz = p[d + 2] - p[b + 2];
      const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
      n[a] += x; n[a + 1] += y; n[a + 2] += z;
      n[b] += x; n[b + 1] += y; n[b + 2] += z;
      n[c] += x; n[c + 1] += y; n[c + 2] += z;
      n[d] += x; n[d + 1] += y; n[d + 2] += z;
    }
    for (let i = 0; i < n.length; i += 3) {
      const length = Math.hypot(n[i], n[i + 1], n[i + 2]) || 1;
      n[i] /= length; n[i + 1] /= length; n[i + 2] /= length;
    }
  }

  updateCloth() {
    const position = this.geometry.attributes.position, normal = this.geometry.attributes.normal, value = this.geometry.attributes.value;
    const order = [0, 1, 2, 0, 2, 3], quads = this.shape.quads;
    for (let cell = 0, v = 0; cell < this.cells; ++cell) {
      const shown = Number.isNaN(this.values[cell]) ? noValue : this.values[cell];
      for (let k = 0; k < 6; ++k, ++v) {
        const node = 3 * quads[4 * cell + order[k]], at = 3 * v;
        position.array[at] = this.points[node]; position.array[at + 1] = this.points[node + 1]; position.array[at + 2] = this.points[node + 2];
        normal.array[at] = this.normals[node]; normal.array[at + 1] = this.normals[node + 1]; normal.array[at + 2] = this.normals[node + 2];
        value.array[v] = shown;
      }
    }
    position.needsUpdate = normal.needsUpdate = value.needsUpdate = true;
  }

  updateLines() {
    const { segments } = this.shape, head = this.lines.head.array, tail = this.lines.tail.array, values = this.lines.values.array;
    for (let s = 0; s < segments.length / 2; ++s) {
      for (let c = 0; c < 3; ++c) {
        head[3 * s + c] = this.points[3 * segments[2 * s] + c];
        tail[3 * s + c] = this.points[3 * segments[2 * s + 1] + c];
      }
      values[2 * s] = values[2 * s + 1] = this.tension ? this.tension[s] : noValue;
    }
    this.lines.changed();
  }

  /** The path so far, which ends at the payload. */
  updateTrail() {
    const { times, points, anchor } = this.shape.path, head = this.trail.head.array, tail = this.trail.tail.array;
    let now = 0;
    while (now + 2 < times.length && times[now + 1] <= this.time) ++now;
    const weight = Math.min(1, Math.max(0, (this.time - times[now]) / (times[now + 1] - times[now] || 1)));
    for (let c = 0; c < 3; ++c) {
      const shift = this.points[3 * anchor + c] - points[3 * now + c] - weight * (points[3 * now + 3 + c] - points[3 * now + c]);
      for (let s = 0; s + 1 < times.length; ++s) {
        head[3 * s + c] = s <= now ? points[3 * s + c] + shift : this.points[3 * anchor + c];
        tail[3 * s + c] = s < now ? points[3 * s + 3 + c] + shift : this.points[3 * anchor + c];
      }
    }
    this.trail.values.array.fill(noValue);
    this.trail.changed();
  }

  /** [lowest corner, highest corner] over all frames, lines too. */
  bounds() {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (const frame of [this.shape.frames[0], this.shape.frames[this.shape.frames.length - 1]])
      for (let i = 0; i < frame.points.length; ++i) {
        low[i % 3] = Math.min(low[i % 3], frame.points[i]);
        high[i % 3] = Math.max(high[i % 3], frame.points[i]);
      }
    return [low, high];
  }

  centre(cell) {
    const sum = [0, 0, 0];
    for (let k = 0; k < 4; ++k) for (let c = 0; c < 3; ++c) sum[c] += this.points[3 * this.shape.quads[4 * cell + k] + c] / 4;
    return sum;
  }

  dispose() {
    this.geometry.dispose();
    this.material.uniforms.ramp.value.dispose();
    this.material.dispose();
    this.lines.dispose();
    this.trail?.dispose();
  }
}
