// A field for every key of a case, made from its schema: unit, range, default with its source, and problems.
"use strict";

class Form {
  /** `change` gets an object of keys with JSON values, or null to remove a key or a table. */
  constructor(schema, drawings, change) {
    Object.assign(this, { schema, drawings, change });
    this.rows = new Map();
    this.built = null;  // names of the groups that are shown
    this.search = element("input", { type: "search", placeholder: "Find a key", "aria-label": "Find a key", oninput: () => this.filter() });
    this.body = element("div");
    this.node = element("div", { class: "form", role: "form", "aria-label": "Keys of the case" }, this.search, this.body);
  }

  /** Keys of a table, and of the tables in it, in the order of the schema. `written`: keys of the file with their text. */
  static groups(schema, prefix, written, groups, removable = false) {
    const own = { name: prefix, about: schema.description, keys: [], removable };
    groups.push(own);
    for (const [key, described] of Object.entries(schema.properties)) {
      const name = prefix ? `${prefix}.${key}` : key, one = described.anyOf ? Form.variant(described.anyOf, name, written) : described;
      if (one.type === "object" && one.properties) Form.groups(one, name, written, groups);
      else if (one.type === "object") Form.repeated(one, name, written, groups, one.additionalProperties);
      else if (one.type === "array" && one.items.type === "object") Form.repeated(one, name, written, groups, one.items);
      else own.keys.push([name, one]);
    }
    return groups;
  }

  /** The key whose value selects one of several kinds of a table, such as `shape` of a body. */
  static selector(variants) {
    return variants.length > 1 ? Object.keys(variants[0].properties).find((key) => variants.every((one) => one.properties[key]?.const !== undefined)) : undefined;
  }

  static variant(variants, table, written) {
    const key = Form.selector(variants), chosen = Form.shownLiteral(written[`${table}.${key}`] ?? '""');
    return variants.find((one) => one.properties[key]?.const === chosen) ?? variants[0];
  }

  /** Tables of which a file can have several: named ones, or members of a list; and the form of a new one. */
  static repeated(schema, name, written, groups, each) {
    const variants = each.anyOf ?? [each], known = new Set(variants.flatMap((one) => Object.keys(one.properties)));
    const listed = schema.type === "array", tables = new Set();
    if (variants.length > 1 && !Form.selector(variants)) return;  // materials: in the text only
    for (const key of Object.keys(written)) {
      const found = key.startsWith(name) && key.slice(name.length).match(listed ? /^(\[\d+\])\.([^.[]+)/ : /^(\.[^.]+)\.([^.[]+)/);
      if (found && known.has(found[2])) tables.add(name + found[1]);
    }
    for (const table of tables) Form.groups(Form.variant(variants, table, written), table, written, groups, true);
    groups.push({ name, about: schema.description, keys: [], added: { variants, listed, next: listed ? `${name}[${tables.size}]` : null } });
  }

  build(groups, signature) {
    const before = new Map((this.sections ?? []).map((section) => [section.name, section.node.open]));
    const open = ["", "parachute", "parachute.lines", "flow"];
    this.built = signature;
    this.rows.clear();
    this.sections = groups.filter((group) => group.keys.length || group.added).map((group) => {
      const count = element("small"), title = group.added ? `New [${group.name}${group.added.listed ? "" : ".NAME"}]` : group.name ? `[${group.name}] ` : "Title ";
      const rows = group.added ? this.addition(group) : group.keys.map(([name, described]) => this.row(name, described));
      if (group.name === "parachute") rows.unshift(Form.drawing(this.drawings, group.keys.find(([key]) => key === "parachute.type")?.[1].const));
      const end = group.removable ? element("p", { class: "row" }, element("button", { type: "button", onclick: () => this.change({ [group.name]: null }) }, `Remove [${group.name}]`)) : null;
      const name = group.added ? `new ${group.name}` : group.name;
      const node = element("details", { open: before.get(name) ?? (!group.added && (group.removable ? !group.name.endsWith("]") : open.includes(group.name))), "data-group": name }, element("summary", { title: group.about }, title, count), rows, end);
      return { node, name, count, about: group.about ?? "", names: group.keys.map(([key]) => key) };
    });
    this.body.replaceChildren(...this.sections.map((section) => section.node));
  }

  /** The parameters of a canopy family. */
  static drawing(drawings, type) {
    const text = drawings.types[type];
    return element("img", { class: "drawing", hidden: !text, alt: `Drawing of the parameters of the type ${type}`, src: text ? `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text)}` : undefined });
  }

  /** Fields of a new table: its name, its kind, and the keys that it needs. */
  addition(group) {
    const { variants, listed, next } = group.added, key = Form.selector(variants), id = `new-${group.name}`;
    const name = element("input", { id: `${id}-name`, spellcheck: false, autocomplete: "off" });
    const kind = element("select", { id: `${id}-kind` }, variants.map((one) => element("option", {}, one.properties[key]?.const ?? "")));
    const fields = element("div"), problem = element("p", { class: "problem", role: "alert" });
    const labelled = (input, text) => element("div", { class: "key" }, element("label", { for: input.id }, text), input);
    let inputs = [];
    const draw = () => {
      const one = variants[kind.selectedIndex];
      inputs = (one.required ?? []).filter((each) => one.properties[each].const === undefined).map((each) => [each, one.properties[each], element("input", { id: `${id}-${each}`, spellcheck: false, autocomplete: "off" })]);
      fields.replaceChildren(...inputs.map(([each, described, input]) => labelled(input, Form.label(each, described))));
    };
    kind.addEventListener("change", draw);
    draw();
    const add = () => {
      try {
        const table = listed ? next : `${group.name}.${name.value.trim()}`, one = variants[kind.selectedIndex], changes = {};
        if (!listed && !/^[A-Za-z0-9][A-Za-z0-9_-]*$/.test(name.value.trim())) throw new Error("The name has letters, digits, _ and -.");
        if (key) changes[`${table}.${key}`] = kind.value;
        for (const [each, described, input] of inputs) changes[`${table}.${each}`] = Form.checked(described, input.value.trim(), each);
        if (!Object.keys(changes).length) {  // a table without a key that it needs begins with a default
          const [first, described] = Object.entries(one.properties).find(([, each]) => each.default !== undefined);
          changes[`${table}.${first}`] = described.default;
        }
        problem.textContent = "";
        this.change(changes);
      } catch (error) { problem.textContent = error.message; }
    };
    return [listed ? null : labelled(name, "name"), key ? labelled(kind, key.replaceAll("_", " ")) : null, fields, problem,
      element("p", { class: "row" }, element("button", { type: "button", id: `${id}-go`, onclick: add }, "Add"))];
  }

  static label(key, described) {
    const item = described.type === "array" ? described.items : described, units = /_(m|m2|kg|m_s|s|n|pa|deg|hz|k|n_m|kg_m2|kg_m3|pa_s|n_s|n_s_m3|pa_s_m|pa_s2_m2|1_m|1_m2)$/;
    return [(item.unit ? key.replace(units, "") : key).replaceAll("_", " "), element("small", {}, item.unit ? ` [${item.unit.replace(/([A-Za-z])([234])(?![0-9])/g, (all, letter, power) => letter + "²³⁴"[power - 2])}]` : "")];
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
    let input;
    if (described.const !== undefined) input = element("output", { id }, described.const);
    else if (described.enum || described.type === "boolean") {
      const values = described.enum ?? ["true", "false"];
      input = element("select", { id }, element("option", { value: "" }, "default"),
        values.map((value) => element("option", { value }, value === "true" ? "yes" : value === "false" ? "no" : value)));
    } else input = element("input", { id, spellcheck: false, autocomplete: "off", inputmode: described.type === "string" ? "text" : undefined });
    const remove = element("button", { type: "button", title: `Remove ${name} from the file: the default is used`, "aria-label": `Remove ${name}`, hidden: true,
      onclick: () => this.change({ [name]: null }) }, "✕");
    const from = element("p", { class: "from" }), problem = element("p", { class: "problem", id: `${id}-problem`, role: "alert", hidden: true });
    const help = element("p", { class: "help" }, `${name}: ${described.description ?? ""} ${Form.range(item)}`);
    input.setAttribute("aria-describedby", problem.id);
    const node = element("div", { class: described.maxLength > 64 ? "key wide" : "key", "data-key": name }, element("label", { for: id, title: described.description }, Form.label(last, described)),
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
      if (row.node.classList.contains("given")) this.change({ [row.name]: null });
      return;
    }
    try {
      this.change({ [row.name]: Form.checked(row.described, text) });
    } catch (error) {
      this.mark(row, error.message);
    }
  }

  /** Form.value() with a message for the field, or for the field `name`. */
  static checked(described, text, name) {
    const range = Form.range(described), field = name ? `${name}: ` : "";
    if (text === "") throw new Error(`${field}enter a value${range && `, ${range}`}`);
    try {
      return Form.value(described, text);
    } catch (error) {
      throw new Error(`${field}${text}: ${error.message}${range && `; ${range}`}`);
    }
  }

  mark(row, message) {
    row.problem.textContent = Words.shown(message);
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
    const groups = Form.groups(this.schema, "", written, []), signature = JSON.stringify(groups.map((group) => [group.name, group.keys.length, group.added?.next]));
    if (this.built !== signature || this.type !== written["parachute.type"]) this.build(groups, signature);
    this.type = written["parachute.type"];
    const sources = new Map((check.sources ?? []).map((source) => [source.key, source]));
    const at = (name) => name.replace(/\[(\d+)\]/g, ".$1").split(".").reduce((value, key) => value?.[key], check.case);
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
      const row = this.rows.get(problem.key) ?? this.rows.get(problem.key?.replace(/\[\d+\]$/, ""));
      if (row) {
        this.mark(row, problem.message);
        row.node.closest("details").open = true;
      } else rest.push(Words.shown(problem.text ?? problem.message));
    }
    for (const section of this.sections.filter((one) => one.names.length)) section.count.textContent = `${section.names.filter((name) => name in written).length} of ${section.names.length} given`;
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
      if (!section.names.length) found = !text || section.name.includes(text.replaceAll(" ", "_")) || section.about.toLowerCase().includes(text);
      section.node.hidden = !found;
      if (text && found) section.node.open = true;
    }
  }
}
