// A field for every key of a case, made from its schema: unit, range, default with its source, and problems.
"use strict";

class Form {
  /** `change(key, value)` gets a JSON value, or null to remove the key. */
  constructor(schema, change) {
    Object.assign(this, { schema, change });
    this.rows = new Map();
    this.type = null;
    this.search = element("input", { type: "search", placeholder: "Find a key", "aria-label": "Find a key", oninput: () => this.filter() });
    this.body = element("div");
    this.node = element("div", { class: "form", role: "form", "aria-label": "Keys of the case" }, this.search, this.body);
  }

  /** Keys of a table, and of the tables in it, in the order of the schema. */
  static groups(schema, prefix, type, groups) {
    const own = { name: prefix, about: schema.description, keys: [] };
    groups.push(own);
    for (const [key, described] of Object.entries(schema.properties)) {
      const name = prefix ? `${prefix}.${key}` : key;
      const one = described.anyOf ? described.anyOf.find((each) => each.properties.type?.const === type) ?? described.anyOf[0] : described;
      if (one.type === "object") {
        if (one.properties) Form.groups(one, name, type, groups);
      } else if (!(one.type === "array" && one.items.type === "object")) own.keys.push([name, one]);
    }
    return groups;
  }

  build(type) {
    this.type = type;
    this.rows.clear();
    const open = ["parachute", "parachute.lines", "flow"];
    this.sections = Form.groups(this.schema, "", type, []).filter((group) => group.keys.length).map((group) => {
      const count = element("small");
      const rows = group.keys.map(([name, described]) => this.row(name, described));
      const node = element("details", { open: open.includes(group.name) || !group.name },
        element("summary", { title: group.about }, group.name ? `[${group.name}] ` : "Title ", count), rows);
      return { node, count, names: group.keys.map(([name]) => name) };
    });
    this.body.replaceChildren(...this.sections.map((section) => section.node));
  }

  static range(s) {
    const parts = [];
    if (s.minimum !== undefined) parts.push(`at least ${s.minimum}`);
    if (s.exclusiveMinimum !== undefined) parts.push(`above ${s.exclusiveMinimum}`);
    if (s.maximum !== undefined) parts.push(`at most ${s.maximum}`);
    return parts.join(", ");
  }

  row(name, described) {
    const last = name.slice(name.lastIndexOf(".") + 1), id = `key-${name}`;
    const item = described.type === "array" ? described.items : described;
    const suffix = item.unit ? ` [${item.unit}]` : "";
    const words = last.replace(/_(m|m2|kg|m_s|s|n|pa|deg|hz|k|n_m|kg_m3|pa_s|n_s|n_s_m3)$/, "").replaceAll("_", " ");
    let input;
    if (described.const !== undefined) input = element("output", { id }, described.const);
    else if (described.enum || described.type === "boolean") {
      const values = described.enum ?? ["true", "false"];
      input = element("select", { id }, element("option", { value: "" }, "default"),
        values.map((value) => element("option", { value }, value === "true" ? "yes" : value === "false" ? "no" : value)));
    } else input = element("input", { id, spellcheck: false, autocomplete: "off", inputmode: described.type === "string" ? "text" : undefined });
    const remove = element("button", { type: "button", title: `Remove ${name} from the file: the default is used`, "aria-label": `Remove ${name}`, hidden: true,
      onclick: () => this.change(name, null) }, "✕");
    const from = element("p", { class: "from" }), problem = element("p", { class: "problem", id: `${id}-problem`, role: "alert", hidden: true });
    const help = element("p", { class: "help" }, `${name}: ${described.description ?? ""} ${Form.range(item)}`);
    input.setAttribute("aria-describedby", problem.id);
    const node = element("div", { class: "key", "data-key": name }, element("label", { for: id, title: described.description }, words, element("small", {}, suffix)),
      input, remove, from, problem, help);
    const row = { name, described, node, input, remove, from, problem, shown: "" };
    input.addEventListener("change", () => this.edited(row));
    this.rows.set(name, row);
    return node;
  }

  /** The text of a field as a JSON value; a number with a unit, as "40 in", is a text of the file. */
  static value(described, text) {
    if (described.type === "boolean") return text === "true";
    const number = (part) => {
      if (!Numbers.isNumber(part)) throw new Error("not a number");
      return Number(part);
    };
    if (described.type === "array") return text.replace(/[[\]]/g, "").split(",").map((part) => number(part.trim()));
    const numeric = described.type === "integer" || (Array.isArray(described.type) && described.type.includes("number")) || described.type === "number";
    if (!numeric || (Array.isArray(described.type) && /^[-+\d.].*[A-Za-z"']/.test(text) && !Numbers.isNumber(text))) return text;
    return number(text);
  }

  edited(row) {
    const text = row.input.value.trim();
    if (text === row.shown) return;
    if (text === "") {
      if (row.node.classList.contains("given")) this.change(row.name, null);
      return;
    }
    try {
      this.change(row.name, Form.value(row.described, text));
    } catch (error) {
      this.mark(row, `${text}: ${error.message}; ${Form.range(row.described)}`);
    }
  }

  mark(row, message) {
    row.problem.textContent = message;
    row.problem.hidden = !message;
    row.input.setAttribute("aria-invalid", String(Boolean(message)));
  }

  static shownLiteral(literal) {
    if (/^"[^\\]*"$/.test(literal) || /^'[^']*'$/.test(literal)) return literal.slice(1, -1);
    if (literal.startsWith("[")) return literal.slice(1, -1).replace(/#[^\n]*/g, "").replace(/\s+/g, " ").trim();
    try {
      const value = JSON.parse(literal);
      return typeof value === "string" ? value : literal;
    } catch { return literal; }
  }

  /** Values, sources and problems of the case as the server read it; problems of no field are returned. */
  show(data) {
    const written = data.written ?? {}, check = data.check;
    const type = Form.shownLiteral(written["parachute.type"] ?? '""');
    if (this.type !== type) this.build(type);
    const sources = new Map((check.sources ?? []).map((source) => [source.key, source]));
    const at = (name) => name.split(".").reduce((value, key) => value?.[key], check.case);
    for (const row of this.rows.values()) {
      const given = row.name in written, resolved = at(row.name), source = sources.get(row.name);
      row.node.classList.toggle("given", given);
      row.shown = given ? Form.shownLiteral(written[row.name]) : "";
      if (document.activeElement !== row.input || row.input.value.trim() === "" || given) row.input.value = row.shown;
      const usual = resolved !== undefined ? Numbers.any(resolved) : row.described.default !== undefined ? Numbers.any(row.described.default) : "";
      if (row.input.tagName === "INPUT") row.input.placeholder = usual;
      else if (row.input.tagName === "SELECT") row.input.options[0].textContent = usual ? `${usual} (default)` : "default";
      row.remove.hidden = !given || row.described.const !== undefined;
      row.from.textContent = given ? "" : source ? source.from : row.described.default !== undefined ? "default" : resolved !== undefined ? "follows from other keys" : "";
      this.mark(row, "");
    }
    const rest = [];
    for (const problem of check.problems ?? []) {
      const row = this.rows.get(problem.key?.replace(/\[\d+\]$/, ""));
      if (row) {
        this.mark(row, problem.message);
        row.node.closest("details").open = true;
      } else rest.push(problem.text ?? problem.message);
    }
    for (const section of this.sections) section.count.textContent = `${section.names.filter((name) => name in written).length} of ${section.names.length} given`;
    return rest;
  }

  filter() {
    const text = this.search.value.trim().toLowerCase();
    for (const section of this.sections) {
      let found = 0;
      for (const name of section.names) {
        const row = this.rows.get(name), hit = !text || name.includes(text.replaceAll(" ", "_")) || (row.described.description ?? "").toLowerCase().includes(text);
        row.node.hidden = !hit;
        found += hit;
      }
      section.node.hidden = !found;
      if (text && found) section.node.open = true;
    }
  }
}
