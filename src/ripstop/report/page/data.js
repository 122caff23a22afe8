// The data of the page: JSON, with arrays of numbers packed as encode.h says.
"use strict";

const Data = (() => {
  async function inflated(text) {
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  }

  // Byte planes of differences from the tuple before, back to whole numbers.
  function summed(planes, count, components, bytes) {
    const numbers = bytes === 2 ? new Uint16Array(count) : new Uint32Array(count);
    for (let b = 0; b < bytes; ++b)
      for (let i = 0; i < count; ++i) numbers[i] |= planes[b * count + i] << (8 * b);
    for (let i = components; i < count; ++i) numbers[i] += numbers[i - components];
    return numbers;
  }

  const noNumber = 65535;

  /** A packed array as Float32Array (values, not-a-number where there is none) or Uint32Array (indices). */
  async function unpack(packed) {
    const planes = await inflated(packed.data);
    const numbers = summed(planes, packed.n, packed.components, packed.bytes);
    if (!packed.step) return numbers;
    const values = new Float32Array(packed.n);
    for (let i = 0; i < packed.n; ++i) {
      const c = i % packed.components;
      values[i] = numbers[i] === noNumber ? NaN : packed.low[c] + packed.step[c] * numbers[i];
    }
    return values;
  }

  /** Replaces every packed array below `value` by its numbers. */
  async function unpackAll(value) {
    if (value === null || typeof value !== "object") return value;
    if (typeof value.data === "string" && "components" in value) return unpack(value);
    const keys = Object.keys(value);
    const parts = await Promise.all(keys.map((key) => unpackAll(value[key])));
    keys.forEach((key, i) => { value[key] = parts[i]; });
    return value;
  }

  const read = () => JSON.parse(document.getElementById("report-data").textContent);

  return { read, unpackAll };
})();
