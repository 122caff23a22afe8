// Tables: numbers to the right, units beside them, the full value as the cell's title.
"use strict";

const Tables = (() => {
  function cell(text, right) {
    if (!Numbers.isNumber(text)) return element("td", { title: Numbers.rounded(text) === text ? undefined : text }, Numbers.rounded(text));
    return element("td", { class: right ? "number" : undefined, title: text }, Numbers.shown(Number(text)));
  }

  /** Whether a column has numbers alone. */
  function isNumeric(rows, index) {
    const filled = rows.map((row) => row[index]).filter((text) => text !== "");
    return filled.length > 0 && filled.every(Numbers.isNumber);
  }

  function framed(id, title, note, table, kind = "") {
    return element("div", { class: `table panel ${kind}`, "data-table": id }, element("h3", {}, title),
                   note ? element("p", { class: "note" }, note) : null, table);
  }

  /** A table as the program made it. */
  function plain(table) {
    const right = table.columns.map((_, i) => isNumeric(table.rows, i));
    const head = table.columns.some((column) => column.text && column.text !== "unit")
      ? element("thead", {}, element("tr", {}, table.columns.map((column, i) => element("th", { scope: "col", class: right[i] ? "number" : undefined }, withUnit(column))))) : null;
    const body = element("tbody", {}, table.rows.map((row) => element("tr", {}, row.map((text, i) => cell(text, right[i])))));
    const kind = table.columns.length > 4 || table.id === "sources" ? "wide" : "";
    return framed(table.id, table.title, table.note, element("table", {}, head, body), kind);
  }

  /** Everything that result.json has as plain values. */
  function results(values) {
    const rows = values.filter((value) => value.key !== "title").map((value) => element("tr", { "data-key": value.key },
      element("td", {}, value.text),
      element("td", { class: typeof value.value === "string" ? "" : "number", title: JSON.stringify(value.value) }, Numbers.any(value.value)),
      element("td", { class: "unit" }, value.unit)));
    const half = Math.ceil(rows.length / 2);
    const part = (some) => element("table", {}, element("tbody", {}, some));
    return element("div", { class: "table panel wide", "data-table": "results" }, element("h3", {}, "All values of the result"),
                   element("div", { class: "tables" }, part(rows.slice(0, half)), part(rows.slice(half))));
  }

  /** Quantity, unit, then a run a column, with the difference from the first. */
  function comparison(table) {
    const body = table.rows.map((row) => {
      const first = Number(row[2]);
      return element("tr", {}, element("td", {}, row[0]), element("td", { class: "unit" }, row[1]), row.slice(2).map((text, i) => {
        const value = Number(text);
        // A share of a value about zero, as of a moment that changes its sign, means nothing.
        const change = i > 0 && first * value > 0 && value !== first ? ` ${value > first ? "+" : "−"}${Math.abs(100 * (value / first - 1)).toFixed(1)} %` : "";
        return element("td", { class: "number", title: text }, Numbers.shown(value), change ? element("small", {}, change) : null);
      }));
    });
    const head = element("tr", {}, table.columns.map((column, i) => element("th", { scope: "col", class: i > 1 ? "number" : undefined }, column.text)));
    return framed(table.id, table.title, table.note, element("table", {}, element("thead", {}, head), element("tbody", {}, body)), "wide");
  }

  const pairs = (id, title, list) => plain({ id, title, note: "", columns: [{ text: "", unit: "" }, { text: "", unit: "" }], rows: list });

  return { plain, results, comparison, pairs };
})();
