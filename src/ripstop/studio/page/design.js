// The design view: form, live shape, numbers, pattern and text of one case file.
"use strict";

class Design {
  constructor(schema, drawings, notice, state) {
    Object.assign(this, { notice, state });
    this.file = null;
    this.data = null;  // of the file, as the server read it
    this.history = new Map();  // file -> {undo: [text], redo: [text]}
    this.busy = Promise.resolve();
    this.form = new Form(schema, drawings, (changes) => this.changeAll(changes));
    const page = `page${Math.random().toString(36).slice(2)}`;
    this.shape = new ShapePane(`${page}-a`);
    this.other = new ShapePane(`${page}-b`);
    this.shape.onshown = this.other.onshown = () => this.linkViews();
    this.against = null;  // the design that this one is compared with, as the server read it
    this.pressure = element("input", { inputmode: "decimal", "aria-label": "Dynamic pressure in Pa", "data-control": "pressure", onchange: () => this.drawShapes() });
    this.choice = element("select", { "data-control": "against", onchange: () => this.compare(this.choice.value) }, element("option", { value: "" }, "no other"));
    this.names = [element("h2", { hidden: true }), element("h2", { hidden: true })];
    this.panes = element("div", { class: "panes" },
      element("section", { "aria-label": "Shape of the design" }, this.names[0], this.shape.timing, this.shape.node),
      this.otherPane = element("section", { "aria-label": "Shape of the other design", hidden: true }, this.names[1], this.other.timing, this.other.node));
    this.mass = this.asked("mass", "2.4");
    this.speed = this.asked("speed", "20");
    this.drag = this.asked("drag-coefficient", "");
    this.asking = element("div", { class: "fields" }, element("label", {}, "Payload mass [kg]", this.mass), element("label", {}, "Deployment speed [m/s]", this.speed), element("label", {}, "Drag coefficient on S0", this.drag));
    this.drag.placeholder = "of the family";
    this.stale = element("p", { class: "muted", hidden: true, "data-part": "stale" }, "The case has problems. These numbers are those of the last valid case.");
    this.facts = element("div", { "data-part": "facts" });
    this.loads = element("div", { "data-part": "loads" });
    this.node = element("div", { class: "view design", id: "view-design" }, this.form.node,
      element("div", { class: "middle" },
        element("div", { class: "above" }, element("label", {}, "Dynamic pressure [Pa] ", this.pressure), element("label", {}, "Compare with ", this.choice)), this.panes),
      element("aside", { class: "numbers", "aria-label": "Numbers" }, this.stale, this.facts, element("h2", {}, "Descent and opening"), this.asking, this.loads));
    this.pieces = element("div", { class: "pieces" });
    this.bill = element("div", { class: "tables" });
    this.patternNode = element("div", { class: "view", id: "view-pattern" },
      element("p", { class: "row" }, element("button", { type: "button", "data-control": "save-pattern", onclick: () => this.savePattern() }, "Save as DXF, SVG and PDF (A4)"), this.saved = element("span", { role: "status" })),
      this.bill, this.pieces);
    this.text = element("textarea", { class: "text", spellcheck: false, "aria-label": "Text of the case file" });
    this.textNode = element("div", { class: "view", id: "view-text" },
      element("p", { class: "row" }, element("button", { type: "button", "data-control": "save-text", onclick: () => this.write(this.text.value, true, this.textVersion) }, "Save the text")), this.text);
  }

  asked(name, usual) {
    return element("input", { inputmode: "decimal", "data-control": name, "data-option": `--${name}`, value: usual, onchange: () => this.drawLoads() });
  }

  /** The case files of the folder, of which one can be compared with this. */
  files(names) {
    this.folderFiles = names;
    const others = names.filter((name) => name !== this.file), known = JSON.stringify(others);
    if (this.choice.dataset.names === known) return;
    this.choice.dataset.names = known;
    this.choice.replaceChildren(element("option", { value: "" }, "no other"), ...others.map((name) => element("option", { value: name }, name)));
    this.choice.value = others.includes(this.against?.file) ? this.against.file : "";
    if (this.against && !this.choice.value) this.compare("");
  }

  async compare(file) {
    try {
      this.against = file ? await Server.get("/api/case", { file }) : null;
    } catch (error) {
      this.against = null;
      this.notice(error.message);
    }
    this.choice.value = this.against?.file ?? "";
    this.node.classList.toggle("two", Boolean(this.against));
    this.otherPane.hidden = !this.against;
    this.names.forEach((node) => { node.hidden = !this.against; });
    this.names[0].textContent = this.file;
    this.names[1].textContent = file;
    if (this.against) this.other.draw(file, this.pressure.value.trim());
    this.otherPacked = undefined;
    if (this.data.check.valid) this.showFacts();
    this.drawLoads();
    if (!this.against) return;
    try {
      this.otherPacked = 1000 * (await Server.get("/api/pattern", { file })).result.packed_volume_m3;
      if (this.against?.file === file) this.showFacts();
    } catch { this.otherPacked = undefined; }
  }

  /** Both shapes are seen from one side, in one scale. */
  linkViews() {
    const [a, b] = [this.shape, this.other];
    for (const [from, to] of [[a, b], [b, a]]) if (from.section && !from.linked) {
      from.linked = true;
      from.section.viewer.controls.addEventListener("change", () => {
        if (!this.against || this.following) return;
        this.following = true;
        to.follow(from);
        this.following = false;
      });
    }
    if (this.against && !this.following) {
      this.following = true;
      b.follow(a);
      this.following = false;
    }
  }

  past() {
    if (!this.history.has(this.file)) this.history.set(this.file, { undo: [], redo: [] });
    return this.history.get(this.file);
  }

  async open(file) {
    if (this.against?.file === file) await this.compare("");
    this.file = file;
    this.names[0].textContent = file;
    this.choice.dataset.names = "";
    const data = await Server.get("/api/case", { file });
    if (this.file !== file) return;
    this.show(data);
    const mass = this.data.check.case?.payload?.mass_kg;
    if (mass !== undefined) this.mass.value = mass;
    this.draw();
  }

  /** Requests that write are made one after the other, each with the version that the last one left. */
  queued(work) {
    this.busy = this.busy.then(work).catch((error) => {
      this.notice(error.message);
      if (error.conflict) return this.reread();
      this.form.show(this.data);
    });
    return this.busy;
  }

  change(key, value) { return this.changeAll({ [key]: value }); }

  /** `changes`: keys with their JSON values, null to remove one. */
  changeAll(changes) {
    return this.queued(async () => {
      const before = this.data.text;
      const data = await Server.post("/api/case/change", { file: this.file, version: this.data.version, changes });
      this.remember(before);
      this.show(data);
      this.draw();
    });
  }

  write(text, remember, version) {
    return this.queued(async () => {
      const before = this.data.text;
      const data = await Server.post("/api/case/write", { file: this.file, version: version ?? this.data.version, text });
      if (remember) this.remember(before);
      this.show(data);
      this.draw();
    });
  }

  remember(text) {
    const past = this.past();
    past.undo.push(text);
    if (past.undo.length > 200) past.undo.shift();
    past.redo = [];
  }

  async undo() { await this.step("undo", "redo"); }
  async redo() { await this.step("redo", "undo"); }
  async step(from, to) {
    const past = this.past();
    if (!past[from].length) return;
    const text = past[from].pop();
    past[to].push(this.data.text);
    await this.write(text, false);
    this.buttons();
  }

  /** The file was changed by another program. */
  async reread() {
    const before = this.data.text, data = await Server.get("/api/case", { file: this.data.file });
    if (data.file !== this.file) return;  // another case has been chosen
    this.show(data);
    if (before !== this.data.text) {
      this.remember(before);
      this.buttons();
      this.notice(`${this.file} was changed outside of this page. Its new content is shown; Undo returns to the content before.`);
    }
    this.draw();
  }

  buttons() {
    document.getElementById("undo").disabled = !this.past().undo.length;
    document.getElementById("redo").disabled = !this.past().redo.length;
  }

  show(data) {
    this.data = data;
    const rest = this.form.show(data);
    const typed = this.text.value !== (this.textShown ?? "") && this.textFile === data.file && this.text.value !== data.text;
    if (!typed) {  // text that is not saved yet remains, with the version that it began from
      if (this.text.value !== data.text) this.text.value = data.text;
      Object.assign(this, { textShown: this.text.value, textVersion: data.version, textFile: data.file });
    }
    this.notice(rest.length ? rest.join("\n") : "");
    this.stale.hidden = data.check.valid;
    this.buttons();
    const problems = data.check.problems?.length ?? 0, warnings = data.check.warnings?.length ?? 0;
    this.state(data.check.valid ? (warnings ? `${warnings} warning${warnings > 1 ? "s" : ""}` : "no problems") : `${problems} problem${problems === 1 ? "" : "s"}`);
    if (data.check.valid) this.showFacts();
  }

  /** Rows [text, value, unit, less important] as a table; with those of another design next to them. */
  static table(rows, others) {
    const shown = (value, unit) => [typeof value === "number" ? Numbers.shown(value, 4) : value ?? "–", unit && !others ? ` ${unit}` : ""];
    const known = (row) => row && row[1] !== undefined && row[1] !== null && !Number.isNaN(row[1]);
    const list = rows.filter(known);
    for (const row of others ?? []) if (known(row) && !list.some((one) => one[0] === row[0])) list.push([row[0], undefined, row[2], row[3]]);
    return element("table", {}, element("tbody", {}, list.map(([text, value, unit, apart]) => {
      const other = others?.find((row) => row[0] === text)?.[1];
      const share = typeof value === "number" && value > 0 && other > 0 && other !== value ? `${other > value ? "+" : "−"}${Numbers.shown(Math.abs(100 * (other / value - 1)), 2)} %` : "";
      return element("tr", { class: apart ? "apart" : undefined }, element("td", {}, text, others && unit ? ` [${unit}]` : ""), element("td", {}, shown(value, unit)),
        others ? [element("td", {}, shown(other)), element("td", {}, share)] : null);
    })));
  }

  static remarks(title, texts) {
    return element("details", { hidden: !texts.length }, element("summary", {}, `${title} (${texts.length})`), element("ul", {}, texts.map((text) => element("li", {}, Words.shown(text)))));
  }

  static factRows(check, packed) {
    const mass = check.mass_kg;
    return [["nominal area", check.nominal_area_m2, "m²"], ["vent", check.vent_area_m2, "m²"], ["geometric porosity", 100 * check.geometric_porosity, "%"],
      ["mass", 1000 * mass.total, "g"], ["cloth", 1000 * mass.cloth, "g", true], ["tape", 1000 * mass.tape, "g", true], ["lines", 1000 * mass.lines, "g", true], ["riser", 1000 * mass.riser, "g", true],
      ["packed volume", packed, "l"], ["air", check.density_kg_m3, "kg/m³"], ["nodes of a run", check.nodes], ["cells of its flow", check.flow_cells],
      ["estimated core time", check.core_time_s / 60, "min"]];
  }

  showFacts() {
    const check = this.data.check, other = this.against?.check.valid ? Design.factRows(this.against.check, this.otherPacked) : undefined;
    this.facts.replaceChildren(element("h2", {}, "Parachute"), other ? element("p", { class: "muted" }, `${this.file}, then ${this.against.file}`) : "",
      Design.table(Design.factRows(check, this.packed), other), Design.remarks("Warnings", check.warnings));
  }

  draw() {
    if (!this.data.check.valid) {
      this.shape.keep();
      this.loadNumber = (this.loadNumber ?? 0) + 1;
      this.patternNumber = (this.patternNumber ?? 0) + 1;
      return;
    }
    const check = this.data.check;
    this.pressure.placeholder = Numbers.shown(0.5 * check.density_kg_m3 * check.speed_m_s ** 2, 4);
    this.shape.draw(this.file, this.pressure.value.trim());
    this.drawLoads();
    this.drawPattern();
  }

  /** In the colours of another theme. */
  redraw() {
    this.shape.redraw();
    this.other.redraw();
  }

  drawShapes() {
    if (this.data.check.valid) this.shape.draw(this.file, this.pressure.value.trim());
    if (this.against) this.other.draw(this.against.file, this.pressure.value.trim());
  }

  static loadRows(load) {
    const stage = load.stages[0];
    return {
      descent: [[`descent at ${Math.round(load.height_m - load.steady_drop_m)} m`, load.steady_speed_m_s, "m/s"], ["drag coefficient", load.drag_coefficient], ["filling time", stage.filling_time_s, "s"]],
      methods: stage.methods.map((method) => {
        const design = method.method === load.design_method;
        return [design ? `${method.method} (design load)` : method.method, method.load_n, "N", !method.applies && !design];
      }),
      margins: [["design load", load.design_load_n, "N"], ["highest design load", load.highest_design_load_n, "N"], ["trajectory peak", load.peak_load_n, "N"],
        ...(load.margins_under_highest_design_load?.members ?? []).map((one) => [`margin of safety under the highest design load, ${one.member}`, one.margin_of_safety])],
    };
  }

  async drawLoads() {
    if (!this.data?.check.valid) return;
    const own = (this.loadNumber = (this.loadNumber ?? 0) + 1), against = this.against;
    const ask = (file) => Server.get("/api/load", { file, mass: this.mass.value.trim(), speed: this.speed.value.trim(), drag: this.drag.value.trim() }, Words.fields(this.asking));
    try {
      const load = await ask(this.file), rows = Design.loadRows(load);
      const other = against?.check.valid ? Design.loadRows(await ask(against.file)) : {};
      if (own !== this.loadNumber) return;
      this.loads.replaceChildren(Design.table(rows.descent, other.descent), element("h2", {}, "Opening load by method"), Design.table(rows.methods, other.methods),
        element("h2", {}, "Design load and margins"), Design.table(rows.margins, other.margins), Design.remarks("Remarks", load.warnings.map((text) => Words.shown(text, Words.fields(this.asking)))));
      this.loads.dataset.file = this.file;
      this.loads.dataset.against = against?.file ?? "";
    } catch (error) {
      if (own !== this.loadNumber) return;
      this.loads.replaceChildren(element("p", { class: "problem" }, error.message));
      this.loads.dataset.file = this.file;
    }
  }

  async drawPattern() {
    const own = (this.patternNumber = (this.patternNumber ?? 0) + 1);
    try {
      const pattern = await Server.get("/api/pattern", { file: this.file });
      if (own !== this.patternNumber) return;
      this.packed = 1000 * pattern.result.packed_volume_m3;
      if (this.data.check.valid) this.showFacts();
      this.bill.replaceChildren(Tables.plain({ id: "bill", title: "Bill of materials", note: "Cloth in m², tape and lines in m; cut with its allowances.",
        columns: ["part", "material", "count", "cut each", "finished", "cut", "mass [g]"].map((text) => ({ text, unit: "" })),
        rows: pattern.result.bill.map((row) => [row.part, row.material, String(row.count), row.cut_each.toPrecision(4), row.finished.toPrecision(4), row.cut.toPrecision(4), (1000 * row.mass_kg).toPrecision(4)]) }));
      this.pieces.replaceChildren(...pattern.pieces.map((piece) => element("figure", { class: "panel", "data-piece": piece.name }, element("figcaption", {}, piece.name),
        element("img", { alt: `Cutting pattern of ${piece.name}`, src: `data:image/svg+xml;charset=utf-8,${encodeURIComponent(piece.svg)}` }))));
    } catch (error) {
      if (own === this.patternNumber) this.pieces.replaceChildren(element("p", { class: "problem" }, error.message));
    }
  }

  async savePattern() {
    try {
      this.saved.textContent = ` saved in ${(await Server.post("/api/pattern", { file: this.file })).folder}`;
    } catch (error) { this.saved.textContent = error.message; }
  }
}
