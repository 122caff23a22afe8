// Elements and numbers as text. Text of a case only ever becomes text.
"use strict";

/** element("p", {class: "note"}, "text", child, ...); "on..." attributes are listeners. */
function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (value === true) made.setAttribute(name, "");
    else if (value !== false && value !== undefined && value !== null) made.setAttribute(name, value);
  }
  for (const child of children.flat()) {
    if (child === null || child === undefined) continue;
    made.append(child instanceof Node ? child : document.createTextNode(String(child)));
  }
  return made;
}

/** The button that switches between the colours of the system, light and dark ones; redraw() repaints canvases. */
function themeButton(redraw) {
  const order = ["auto", "light", "dark"], button = document.getElementById("theme");
  const set = (name) => {
    if (name === "auto") delete document.documentElement.dataset.theme; else document.documentElement.dataset.theme = name;
    button.textContent = `Theme: ${name}`;
    button.dataset.now = name;
    redraw();
  };
  button.addEventListener("click", () => set(order[(order.indexOf(button.dataset.now) + 1) % 3]));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
  set("auto");
}

const Numbers = (() => {
  /** `digits` significant ones; whole numbers whole; texts as they are. */
  function shown(value, digits = 5) {
    if (typeof value === "string") return value;
    if (value === null || value === undefined || Number.isNaN(value)) return "–";
    if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
    if (Number.isInteger(value) && Math.abs(value) < 1e7) return minus(String(value));
    const size = Math.abs(value);
    if (size !== 0 && (size < 1e-4 || size >= 1e7)) {
      const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
      return minus(`${trimmed(mantissa)}e${Number(exponent)}`);
    }
    // toPrecision() has an exponent where there are more digits before the point than asked for.
    return minus(size >= 10 ** digits - 0.5 ? value.toFixed(0) : trimmed(value.toPrecision(digits)));
  }
  const trimmed = (text) => (text.includes(".") ? text.replace(/\.?0+$/, "") : String(Number(text)));
  const minus = (text) => text.replace("-", "−");

  /** A number, a text, a list or yes and no of a result. */
  function any(value) {
    if (typeof value === "number") return shown(value);
    if (typeof value === "boolean") return value ? "yes" : "no";
    if (Array.isArray(value)) return value.map(any).join(", ");
    return value === null ? "–" : String(value);
  }

  /** A text with its long fractions rounded, as "[2.8000000000000003, 4]". */
  const rounded = (text) => text.replace(/(?<![\w.])-?\d+\.\d{7,}(e[-+]?\d+)?(?![\w.])/gi, (long) => shown(Number(long)));

  const pattern = /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i;
  const isNumber = (text) => pattern.test(text);

  /** Round values in steps of 1, 2 or 5 times a power of ten within [low, high]. */
  function ticks(low, high, count) {
    const raw = (high - low) / count;
    if (!(raw > 0)) return [low];
    const power = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].map((factor) => factor * power).find((candidate) => candidate >= raw);
    const all = [];
    for (let value = Math.ceil(low / step) * step; value <= high + 1e-9 * step; value += step) all.push(Number(value.toPrecision(12)));
    return all;
  }

  return { shown, any, rounded, isNumber, ticks };
})();

/** "drag [N]" */
const withUnit = (words) => (words.unit ? `${words.text} [${words.unit}]` : words.text);
