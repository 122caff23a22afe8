// The materials view: tensile records are dropped, their columns and the fit are shown, the material is saved.
"use strict";

class Fitting {
  constructor(notice) {
    this.notice = notice;
    this.records = [];  // {name, base64, orientation, length, width}
    const field = (name, text, value = "", more = {}) => element("label", {}, text, this[name] = element("input", { value, spellcheck: false, "data-control": `fit-${name}`, ...more }));
    this.kind = element("select", { "data-control": "fit-kind", onchange: () => this.fields() }, [["fabric", "cloth"], ["line", "line"], ["tape", "tape"]].map(([value, text]) => element("option", { value }, text)));
    this.file = element("input", { type: "file", multiple: true, "data-control": "fit-file", "aria-label": "Tensile records", onchange: () => this.take(this.file.files) });
    this.drop = element("div", { class: "drop", "data-part": "drop" }, element("p", {}, "Drop tensile records here (text tables of a testing machine), or choose them:"), this.file);
    this.drop.addEventListener("dragover", (event) => { event.preventDefault(); this.drop.classList.add("over"); });
    this.drop.addEventListener("dragleave", () => this.drop.classList.remove("over"));
    this.drop.addEventListener("drop", (event) => { event.preventDefault(); this.drop.classList.remove("over"); this.take(event.dataTransfer.files); });
    this.list = element("div", { "data-part": "records" });
    this.problem = element("p", { class: "problem", role: "alert", "data-part": "fit-problem" });
    this.coupons = element("input", { type: "checkbox", "data-control": "fit-coupons" });
    this.single = element("input", { type: "checkbox", "data-control": "fit-single" });
    this.result = element("div", { class: "panel", hidden: true, "data-part": "fit-result" });
    this.save = element("button", { type: "button", "data-control": "fit-save", disabled: true, onclick: () => this.fit(true) }, "Save the material");
    this.node = element("div", { class: "view", id: "view-materials" }, element("div", { class: "jobs" },
      element("form", { class: "panel fields", onsubmit: (event) => { event.preventDefault(); this.fit(false); } }, element("h2", {}, "Material from tests"),
        element("label", {}, "Material of", this.kind), field("name", "Name", "my-cloth"), field("source", "Source: who tested, when"),
        this.density = field("areal", "Mass per area [kg/m²]"), this.perLength = field("linear", "Mass per length [kg/m]"), this.thickness = field("thick", "Thickness [m]"), this.tape = field("width", "Width [m]"),
        this.air = field("cfm", "Air permeability [CFM/ft²]"), field("columns", "Columns, if not recognised", "", { "data-option": "--columns" }),
        element("label", {}, "One record a direction is enough (no scatter)", this.single), element("label", {}, "Fit shear and bending with virtual coupons", this.coupons),
        this.problem, element("p", { class: "row" }, element("button", { type: "submit", class: "primary", "data-control": "fit-go" }, "Fit"), this.save)),
      element("div", { class: "column" }, element("div", { class: "panel" }, element("h2", {}, "Records"), this.drop, this.list), this.result)));
    this.fields();
    this.listRecords();
  }

  fields() {
    const kind = this.kind.value;
    this.density.hidden = this.air.hidden = kind !== "fabric";
    this.perLength.hidden = kind === "fabric";
    this.thickness.hidden = kind === "line";
    this.tape.hidden = kind !== "tape";
  }

  async take(files) {
    for (const file of files) {
      const bytes = new Uint8Array(await file.arrayBuffer());
      if (bytes.length > 4 << 20) { this.problem.textContent = `${file.name} is larger than 4 MiB`; continue; }
      let text = "";
      for (let i = 0; i < bytes.length; i += 8192) text += String.fromCharCode(...bytes.subarray(i, i + 8192));
      const name = file.name.replace(/[^A-Za-z0-9._-]/g, "-").replace(/^[^A-Za-z0-9]+/, "").slice(0, 60) || "record.csv";
      this.records = this.records.filter((record) => record.name !== name);
      this.records.push({ name, base64: btoa(text), orientation: "", length: "", width: "" });
    }
    this.file.value = "";
    this.listRecords();
  }

  listRecords() {
    if (!this.records.length) {
      this.list.replaceChildren(element("p", { class: "muted" }, "No record yet. Orientation, length and width of a specimen are read from the comments of its file; fill in the fields only where the file has none."));
      return;
    }
    const input = (record, key, text) => element("input", { value: record[key], inputmode: "decimal", "aria-label": `${text} of ${record.name}`, onchange: (event) => { record[key] = event.target.value.trim(); } });
    this.list.replaceChildren(element("table", { class: "records" }, element("thead", {}, element("tr", {}, ["record", "orientation [°]", "length [m]", "width [m]", ""].map((text) => element("th", { scope: "col" }, text)))),
      element("tbody", {}, this.records.map((record) => element("tr", { "data-record": record.name }, element("td", {}, record.name), element("td", {}, input(record, "orientation", "Orientation")),
        element("td", {}, input(record, "length", "Length")), element("td", {}, input(record, "width", "Width")),
        element("td", {}, element("button", { type: "button", "aria-label": `Remove ${record.name}`, onclick: () => { this.records = this.records.filter((one) => one !== record); this.listRecords(); } }, "✕")))))));
  }

  /** Names of the fields by option, and by key of the campaign that the server writes. */
  names() {
    const of = (label) => Words.name(label.firstChild.textContent);
    return { ...Words.fields(this.node), areal_density_kg_m2: of(this.density), linear_density_kg_m: of(this.perLength), thickness_m: of(this.thickness), width_m: "Width",
      cfm: of(this.air), orientation_deg: "orientation", length_m: "length" };
  }

  /** A message about the campaign: records have their names, and the page has no file of the campaign. */
  inWords(message) {
    return message.replace(/\S*bench\.toml(:\d+)*:? ?/g, "").replace(/coupon\[(\d+)\]\.?/g, (all, i) => `${this.records[i]?.name}: `);
  }

  request(save) {
    const number = (text, name) => {
      if (!Numbers.isNumber(text)) throw new Error(`${name}: "${text}" is not a number`);
      return Number(text);
    };
    const bench = { kind: this.kind.value, name: this.name.value.trim(), source: this.source.value.trim() };
    const optional = [["areal_density_kg_m2", this.areal, this.density], ["linear_density_kg_m", this.linear, this.perLength], ["thickness_m", this.thick, this.thickness], ["width_m", this.width, this.tape]];
    for (const [key, input, label] of optional) if (!label.hidden && input.value.trim()) bench[key] = number(input.value.trim(), label.firstChild.textContent);
    if (this.columns.value.trim()) bench.columns = this.columns.value.trim();
    if (this.single.checked) bench.single_samples = true;
    const records = this.records.map(({ name, base64, orientation, length, width }) => ({ name, base64,
      ...(orientation ? { orientation_deg: number(orientation, "orientation") } : {}), ...(length ? { length_m: number(length, "length") } : {}), ...(width ? { width_m: number(width, "width") } : {}) }));
    const cfm = !this.air.hidden && this.cfm.value.trim() ? { cfm: number(this.cfm.value.trim(), "air permeability") } : {};
    return { bench, records, ...cfm, coupons: this.coupons.checked, save };
  }

  async fit(save) {
    this.problem.textContent = "";
    this.save.disabled = true;
    try {
      const request = this.request(save);
      this.result.hidden = false;
      this.result.dataset.state = "busy";
      this.result.replaceChildren(element("p", { class: "muted" }, "fitting"));
      const answer = await Server.post("/api/material", request, this.names());
      this.show(answer);
      this.save.disabled = Boolean(answer.saved);
    } catch (error) {
      this.result.hidden = true;
      this.problem.textContent = this.inWords(error.message);
    }
  }

  show({ result, curves, material, saved }) {
    const unit = result.kind === "fabric" ? "N/m" : "N", percent = (strain) => strain.map((value) => 100 * value);
    const figures = result.directions.map((direction) => {
      const curve = curves[direction.name], strain = percent(curve.strain), dashed = { line: true, dashed: true };
      const shifted = (sign) => curve.mean.map((mean, i) => (Number.isFinite(curve.spread[i]) ? mean + sign * curve.spread[i] : null));
      return new Plots.Figure({ id: `fit-${direction.name}`, title: `${direction.name}: ${direction.samples.length} samples, degree ${direction.degree}, R² ${Numbers.shown(direction.r2, 5)}`,
        x: { text: "strain", unit: "%" }, y: { text: result.kind === "fabric" ? "load per width" : "tension", unit }, series: [
          { name: "mean of the samples", x: strain, y: curve.mean, line: false }, { name: "fit", x: strain, y: curve.fit, line: true },
          { name: "band of the fit, low", x: strain, y: curve.band_low, ...dashed }, { name: "band of the fit, high", x: strain, y: curve.band_high, ...dashed },
          { name: "mean − scatter", x: strain, y: shifted(-1), ...dashed }, { name: "mean + scatter", x: strain, y: shifted(1), ...dashed }] }, null);
    });
    const rows = result.directions.flatMap((direction) => direction.samples.map((sample) => [direction.name, sample.file, (100 * sample.failure_strain).toPrecision(4), sample.failure_load.toPrecision(5), sample.trimmed.join("; ")]));
    this.result.replaceChildren(element("h2", {}, result.name),
      saved ? element("p", { class: "good", "data-part": "saved" }, `Saved as ${saved}. Name it in a case: parachute.canopy_material = "${result.name}".`) : "",
      element("h3", {}, "How the records were understood"), element("ul", { "data-part": "understood" }, result.understood.map((text) => element("li", {}, text))),
      element("div", { class: "plots" }, figures.map((figure) => figure.node)),
      element("div", { class: "tables" }, Tables.plain({ id: "samples", title: "Samples", note: "", columns: [{ text: "direction" }, { text: "record" }, { text: "failure strain", unit: "%" }, { text: "failure load", unit }, { text: "cleaning" }], rows })),
      Design.remarks("Warnings", result.warnings), Design.remarks("Notes", result.notes),
      element("details", {}, element("summary", {}, "Material file"), element("pre", {}, material)));
    this.result.dataset.state = saved ? "saved" : "done";
    for (const figure of figures) figure.draw();
    this.figures = figures;
  }

  redraw() { for (const figure of this.figures ?? []) figure.draw(); }
}
