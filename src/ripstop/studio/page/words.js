// Messages of the program in the words of this page: an option of the command line, or a key of a file that the page writes, becomes the
// name of its field.
"use strict";

const Words = (() => {
  /** A label without its unit and example: "Cells, for example 40,40,60" is "Cells", "Angles FROM:TO:STEP [°]" is "Angles". */
  const name = (label) => label.split(/[,:[]| [A-Z]{2,}/)[0].trim();

  /** Names of the fields in a node, by their option. */
  const fields = (node) => Object.fromEntries([...node.querySelectorAll("[data-option]")].map((input) => [input.dataset.option, name(input.closest("label").firstChild.textContent)]));

  function inWords(text, names) {
    const keys = Object.keys(names).filter((one) => !one.startsWith("--"));
    const keyed = keys.length ? text.replace(new RegExp(`\\b(?:${keys.join("|")})\\b`, "g"), (key) => `"${names[key]}"`) : text;
    return keyed.replace(/ with --fresh\b/g, " as a new run with another name")
      .replace(/(^|[^A-Za-z0-9-])(--[a-z][a-z-]*[a-z])(?: [A-Z][A-Z0-9/:=,]*(?![a-z]))?/g, (all, before, option) => before + (names[option] ? `"${names[option]}"` : `the option ${option} of the command line`));
  }

  /** A message in which options and keys are fields, by `names`; command lines in it remain. */
  function shown(message, names = {}) {
    return String(message).replace(/ \(see ripstop [a-z -]*--help\)/g, "").split(/(\bripstop [a-z][^;,\n]*)/).map((part, i) => (i % 2 ? part : inWords(part, names))).join("");
  }

  return { name, fields, shown };
})();
