// Shaders: cloth coloured by a value a cell, and lines of constant width on the screen coloured by a value.
"use strict";

const Materials = (() => {
  function rampTexture(scale) {
    const texture = new THREE.DataTexture(Colours.pixels(scale), 256, 1, THREE.RGBAFormat, THREE.UnsignedByteType);
    texture.minFilter = texture.magFilter = THREE.LinearFilter;
    texture.needsUpdate = true;
    return texture;
  }

  // The colour of a value; grey where there is none (far above any real one).
  const lookUp = `
    uniform sampler2D ramp; uniform float low, high;
    vec3 colour_of(float value) {
      if (value > 1e30) return vec3(0.62);
      float t = clamp((value - low) / (high - low), 0.0, 1.0);
      return texture(ramp, vec2((0.5 + 255.0 * t) / 256.0, 0.5)).rgb;
    }`;

  /** Shaded from the eye only so far that the form is seen and hues can still be compared with the bar. */
  function cloth(scale) {
    return new THREE.ShaderMaterial({
      glslVersion: THREE.GLSL3, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
      uniforms: { ramp: { value: rampTexture(scale) }, low: { value: 0 }, high: { value: 1 } },
      vertexShader: `
        in float value; out float shown; out vec3 toward; out vec3 facing;
        void main() {
          vec4 seen = modelViewMatrix * vec4(position, 1.0);
          shown = value; facing = normalMatrix * normal; toward = -seen.xyz;
          gl_Position = projectionMatrix * seen;
        }`,
      fragmentShader: `
        precision highp float;
        in float shown; in vec3 toward; in vec3 facing; out vec4 result; ${lookUp}
        void main() {
          float light = abs(dot(normalize(facing), normalize(toward)));
          result = vec4(colour_of(shown) * (0.58 + 0.42 * light), 1.0);
        }`,
    });
  }

  /** For the geometry of Segments: two triangles that are turned toward the eye, `width` pixels wide. */
  function lines(scale, width) {
    return new THREE.ShaderMaterial({
      glslVersion: THREE.GLSL3, side: THREE.DoubleSide,
      uniforms: { ramp: { value: rampTexture(scale) }, low: { value: 0 }, high: { value: 1 },
                  width: { value: width }, screen: { value: new THREE.Vector2(1, 1) } },
      vertexShader: `
        in vec3 head; in vec3 tail; in vec2 values; out float shown;
        uniform vec2 screen; uniform float width;
        void main() {
          mat4 view = projectionMatrix * modelViewMatrix;
          vec4 a = view * vec4(head, 1.0), b = view * vec4(tail, 1.0);
          vec2 along = (b.xy / b.w - a.xy / a.w) * screen;
          vec2 across = length(along) > 1e-6 ? normalize(vec2(-along.y, along.x)) : vec2(1.0, 0.0);
          vec4 here = mix(a, b, position.y);
          here.xy += across * position.x * width / screen * here.w;
          here.z -= 2e-4 * here.w;
          shown = mix(values.x, values.y, position.y);
          gl_Position = here;
        }`,
      fragmentShader: `
        precision highp float;
        in float shown; out vec4 result; ${lookUp}
        void main() { result = vec4(colour_of(shown), 1.0); }`,
    });
  }

  return { cloth, lines, rampTexture };
})();
