// The air of one run: a slice through a box of cells, and streamlines.
"use strict";

class Air {
  constructor(flow) {
    this.flow = flow;
    this.texture = null;
    this.plane = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.ShaderMaterial({
      glslVersion: THREE.GLSL3, side: THREE.DoubleSide, transparent: true, depthWrite: false,
      uniforms: { picture: { value: null } },
      vertexShader: "out vec2 at; void main() { at = uv; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }",
      fragmentShader: "precision highp float; in vec2 at; out vec4 result; uniform sampler2D picture; void main() { result = vec4(texture(picture, at).rgb, 0.86); }",
    }));
    this.plane.geometry.setAttribute("uv", new THREE.BufferAttribute(new Float32Array([0, 0, 1, 0, 1, 1, 0, 1]), 2));
    this.plane.geometry.setIndex([0, 1, 2, 0, 2, 3]);
    this.plane.visible = false;
    this.plane.frustumCulled = false;
    this.streamlines = this.makeStreamlines();
    this.streamlines.mesh.visible = false;
  }

  makeStreamlines() {
    const { streamlines: points, lengths, streamlineSpeed: speed } = this.flow;
    let count = 0;
    for (const length of lengths) count += Math.max(0, length - 1);
    const lines = new Segments(count, Colours.airScale(), 1.1);
    let point = 0, segment = 0;
    for (const length of lengths) {
      for (let i = 0; i + 1 < length; ++i, ++segment) {
        lines.head.array.set(points.subarray(3 * (point + i), 3 * (point + i) + 3), 3 * segment);
        lines.tail.array.set(points.subarray(3 * (point + i + 1), 3 * (point + i + 1) + 3), 3 * segment);
        lines.values.array.set([speed[point + i], speed[point + i + 1]], 2 * segment);
      }
      point += length;
    }
    const [low, high] = Canopy.rangeOf([speed], 0.005);
    lines.material.uniforms.low.value = low;
    lines.material.uniforms.high.value = high;
    this.speedRange = [low, high];
    return lines;
  }

  values(quantity) {
    return quantity === "pressure" ? this.flow.pressure : this.flow.speed;
  }
  range(quantity) {
    return Canopy.rangeOf([this.values(quantity)], 0.005);
  }
  extent(axis) {
    const low = this.flow.origin[axis] - 0.5 * this.flow.spacing[axis];
    return [low, low + this.flow.cells[axis] * this.flow.spacing[axis]];
  }

  /** The slice across `axis` (0, 1, 2) at `place` [m]. */
  cut(axis, place, quantity) {
    const { cells, origin, spacing } = this.flow, values = this.values(quantity);
    const [low, high] = this.range(quantity), scale = Colours.airScale();
    const u = axis === 0 ? 1 : 0, v = axis === 2 ? 1 : 2;
    const layer = Math.min(cells[axis] - 1, Math.max(0, (place - origin[axis]) / spacing[axis]));
    const near = Math.floor(layer), far = Math.min(near + 1, cells[axis] - 1), weight = layer - near;
    const stride = [1, cells[0], cells[0] * cells[1]];
    const rgba = new Uint8Array(4 * cells[u] * cells[v]);
    for (let j = 0; j < cells[v]; ++j)
      for (let i = 0; i < cells[u]; ++i) {
        const at = i * stride[u] + j * stride[v];
        const value = (1 - weight) * values[at + near * stride[axis]] + weight * values[at + far * stride[axis]];
        const colour = Math.round(255 * Math.min(1, Math.max(0, (value - low) / (high - low))));
        rgba.set([scale[3 * colour], scale[3 * colour + 1], scale[3 * colour + 2], 255], 4 * (i + cells[u] * j));
      }
    if (this.texture) this.texture.dispose();
    this.texture = new THREE.DataTexture(rgba, cells[u], cells[v], THREE.RGBAFormat, THREE.UnsignedByteType);
    this.texture.minFilter = this.texture.magFilter = THREE.LinearFilter;
    this.texture.needsUpdate = true;
    this.plane.material.uniforms.picture.value = this.texture;
    const [u0, u1] = this.extent(u), [v0, v1] = this.extent(v);
    const corners = [[u0, v0], [u1, v0], [u1, v1], [u0, v1]].map(([a, b]) => {
      const corner = [0, 0, 0];
      corner[axis] = place; corner[u] = a; corner[v] = b;
      return corner;
    });
    this.plane.geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(corners.flat()), 3));
  }

  dispose() {
    if (this.texture) this.texture.dispose();
    this.plane.geometry.dispose();
    this.plane.material.dispose();
    this.streamlines.dispose();
  }
}
