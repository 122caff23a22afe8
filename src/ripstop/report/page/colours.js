// Colour scales, and the colours of the theme.
"use strict";

const Colours = (() => {
  let cloth = null;

  /** Takes the program's own scale: 256 times red, green, blue. */
  function setCloth(text) {
    cloth = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  }

  const gamma = (linear) => 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055);

  // Oklab (B. Ottosson, 2020): the lightness rises evenly from a dark blue to nearly white.
  function blue(fraction) {
    const L = 0.36 + 0.6 * fraction, chroma = 0.11 * (1 - 0.75 * fraction), hue = (245 * Math.PI) / 180;
    const a = chroma * Math.cos(hue), b = chroma * Math.sin(hue);
    const l = (L + 0.3963377774 * a + 0.2158037573 * b) ** 3;
    const m = (L - 0.1055613458 * a - 0.0638541728 * b) ** 3;
    const s = (L - 0.0894841775 * a - 1.291485548 * b) ** 3;
    return [4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
            -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
            -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s].map((x) => Math.round(gamma(Math.min(1, Math.max(0, x)))));
  }

  let air = null;
  function airScale() {
    if (!air) air = Uint8Array.from(Array.from({ length: 256 }, (_, i) => blue(i / 255)).flat());
    return air;
  }

  const clothScale = () => cloth;

  /** A scale as the pixels of a texture, opaque. */
  function pixels(scale) {
    const rgba = new Uint8Array(4 * 256);
    for (let i = 0; i < 256; ++i) rgba.set([scale[3 * i], scale[3 * i + 1], scale[3 * i + 2], 255], 4 * i);
    return rgba;
  }

  const css = (scale) => {
    const stops = Array.from({ length: 17 }, (_, i) => Math.round((255 * i) / 16));
    return `linear-gradient(to right, ${stops.map((i) => `rgb(${scale[3 * i]} ${scale[3 * i + 1]} ${scale[3 * i + 2]})`).join(", ")})`;
  };

  const variable = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const series = (index) => variable(`--s${index % 7}`);

  return { setCloth, clothScale, airScale, pixels, css, variable, series };
})();
