// The design view: form, live shape, numbers, pattern and text of one case file.
"use strict";

class Design {
  constructor(schema, notice, state) {
    Object.assign(this, { notice, state });
    this.file = null;
    this.data = null;  // of the file, as the server read it
    this.history = new Map();  // file -> {undo: [text], redo: [text]}
    this.busy = Promise.resolve();
    this.form = new Form(schema, (key, value) => this.change(key, value));
    this.pressure = element("input", { inputmode: "decimal", "aria-label": "Dynamic pressure in Pa", "data-control": "pressure", onchange: () => this.drawShape() });
    this.timing = element("span", { class: "muted", role: "status", "data-part": "timing" });
    this.shapes = null;
    this.stage = element("div");
    this.mass = this.asked("mass", "2.4");
    this.speed = this.asked("speed", "20");
    this.facts = element("div", { "data-part": "facts" });
    this.loads = element("div", { "data-part": "loads" });
    this.node = element("div", { class: "view design", id: "view-design" }, this.form.node,
      element("div", { class: "middle" },
        element("div", { class: "above" }, element("label", {}, "Dynamic pressure [Pa] ", this.pressure), this.timing), this.stage),
      element("aside", { class: "numbers", "aria-label": "Numbers" }, this.facts, element("h2", {}, "Descent and opening"),
        element("div", { class: "fields" }, element("label", {}, "Payload mass [kg]", this.mass), element("label", {}, "Deployment speed [m/s]", this.speed)), this.loads));
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
    return element("input", { inputmode: "decimal", "data-control": name, value: usual, onchange: () => this.drawLoads() });
  }

  past() {
    if (!this.history.has(this.file)) this.history.set(this.file, { undo: [], redo: [] });
    return this.history.get(this.file);
  }

  async open(file) {
    this.file = file;
    this.show(await Server.get("/api/case", { file }));
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

  change(key, value) {
    return this.queued(async () => {
      const before = this.data.text;
      const data = await Server.post("/api/case/change", { file: this.file, version: this.data.version, changes: { [key]: value } });
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
    const before = this.data.text;
    this.show(await Server.get("/api/case", { file: this.file }));
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
    this.buttons();
    const problems = data.check.problems?.length ?? 0, warnings = data.check.warnings?.length ?? 0;
    this.state(data.check.valid ? (warnings ? `${warnings} warning${warnings > 1 ? "s" : ""}` : "no problems") : `${problems} problem${problems === 1 ? "" : "s"}`);
    if (data.check.valid) this.showFacts(data.check);
  }

  static table(rows) {
    return element("table", {}, element("tbody", {}, rows.filter((row) => row[1] !== undefined && row[1] !== null && !Number.isNaN(row[1])).map(([text, value, unit, apart]) =>
      element("tr", { class: apart ? "apart" : undefined }, element("td", {}, text), element("td", {}, typeof value === "number" ? Numbers.shown(value, 4) : value, unit ? ` ${unit}` : "")))));
  }

  static remarks(title, texts) {
    return element("details", { hidden: !texts.length }, element("summary", {}, `${title} (${texts.length})`), element("ul", {}, texts.map((text) => element("li", {}, text))));
  }

  showFacts(check) {
    const mass = check.mass_kg;
    this.facts.replaceChildren(element("h2", {}, "Parachute"), Design.table([
      ["nominal area", check.nominal_area_m2, "m²"], ["vent", check.vent_area_m2, "m²"], ["geometric porosity", 100 * check.geometric_porosity, "%"],
      ["mass", 1000 * mass.total, "g"], ["cloth", 1000 * mass.cloth, "g", true], ["tape", 1000 * mass.tape, "g", true], ["lines", 1000 * mass.lines, "g", true], ["riser", 1000 * mass.riser, "g", true],
      ["packed volume", this.packed, "l"], ["air", check.density_kg_m3, "kg/m³"], ["nodes of a run", check.nodes], ["cells of its flow", check.flow_cells],
      ["estimated core time", check.core_time_s / 60, "min"]]),
      Design.remarks("Warnings", check.warnings));
  }

  draw() {
    if (!this.data.check.valid) return;
    const check = this.data.check;
    this.pressure.placeholder = Numbers.shown(0.5 * check.density_kg_m3 * check.speed_m_s ** 2, 4);
    this.drawShape();
    this.drawLoads();
    this.drawPattern();
  }

  async drawShape() {
    if (!this.data.check.valid) return;
    const begin = performance.now(), own = (this.shapeNumber = (this.shapeNumber ?? 0) + 1);
    const text = this.pressure.value.trim(), request = { file: this.file, nodes: 3000 };
    if (text) request.pressure = text;
    this.timing.textContent = "computing the shape";
    try {
      const answer = await Server.get("/api/shape", request);
      if (answer.superseded && own === this.shapeNumber) setTimeout(() => this.drawShape(), 300);  // by another page
      if (answer.superseded || own !== this.shapeNumber) return;
      await this.showShape(answer);
      const r = answer.result;
      this.timing.textContent = `${r.nodes} nodes under ${Numbers.shown(r.pressure_pa, 4)} Pa in ${((performance.now() - begin) / 1000).toFixed(2)} s · projected diameter ${Numbers.shown(r.projected_diameter_m, 4)} m`
        + ` · highest line tension ${Numbers.shown(r.max_line_tension_n, 3)} N${r.converged ? "" : " · not in equilibrium"}`;
      this.timing.dataset.file = this.file;
      this.timing.dataset.shape = own;
    } catch (error) {
      if (own === this.shapeNumber) this.timing.textContent = error.message;
    }
  }

  async showShape(answer) {
    Colours.setCloth(answer.shape.colours);
    await Data.unpackAll(answer.shape);
    try {
      this.shapes ??= new ShapeSection();
    } catch {
      this.stage.replaceChildren(element("p", { class: "callout" }, "The 3D view needs WebGL, which this browser does not support."));
      return;
    }
    if (!this.shapes.node.isConnected) this.stage.replaceWith(this.shapes.node);
    const viewer = this.shapes.viewer, before = this.controls;
    const look = before && { offset: viewer.camera.position.clone().sub(viewer.controls.target) };
    if (look) look.share = look.offset.length() / viewer.fitting(look.offset.clone().normalize());
    this.controls = new Controls({ shape: answer.shape }, viewer, new Clock(0));
    if (before && this.controls.quantities.some((one) => one.key === before.key)) this.controls.key = before.key;
    this.shapes.show(this.controls);
    if (!look) return;
    const toward = look.offset.normalize();  // seen as before, in proportion to the new size
    viewer.camera.position.copy(viewer.middle).addScaledVector(toward, look.share * viewer.fitting(toward));
    viewer.controls.update();
    viewer.draw();
  }

  async drawLoads() {
    if (!this.data?.check.valid) return;
    const own = (this.loadNumber = (this.loadNumber ?? 0) + 1);
    try {
      const load = await Server.get("/api/load", { file: this.file, mass: this.mass.value.trim(), speed: this.speed.value.trim() });
      if (own !== this.loadNumber) return;
      const stage = load.stages[0], rows = [["descent", load.steady_speed_m_s, "m/s"], ["drag coefficient", load.drag_coefficient], ["filling time", stage.filling_time_s, "s"]];
      const methods = stage.methods.map((method) => [method.method, method.load_n, "N", !method.applies]);
      const margins = (load.margins?.members ?? []).map((one) => [`margin of safety, ${one.member}`, one.margin_of_safety]);
      this.loads.replaceChildren(Design.table(rows), element("h2", {}, "Opening load by method"), Design.table(methods),
        element("h2", {}, "Design load and margins"), Design.table([["design load", load.design_load_n, "N"], ["trajectory peak", load.peak_load_n, "N"], ...margins]),
        Design.remarks("Remarks", load.warnings));
      this.loads.dataset.file = this.file;
    } catch (error) {
      if (own === this.loadNumber) this.loads.replaceChildren(element("p", { class: "problem" }, error.message));
    }
  }

  async drawPattern() {
    const own = (this.patternNumber = (this.patternNumber ?? 0) + 1);
    try {
      const pattern = await Server.get("/api/pattern", { file: this.file });
      if (own !== this.patternNumber) return;
      this.packed = 1000 * pattern.result.packed_volume_m3;
      if (this.data.check.valid) this.showFacts(this.data.check);
      this.bill.replaceChildren(Tables.plain({ id: "bill", title: "Bill of materials", note: "Cloth in m², tape and lines in m.",
        columns: ["part", "material", "count", "finished", "cut", "mass [g]"].map((text) => ({ text, unit: "" })),
        rows: pattern.result.bill.map((row) => [row.part, row.material, String(row.count), row.finished.toPrecision(4), row.cut.toPrecision(4), (1000 * row.mass_kg).toPrecision(4)]) }));
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
