// The runs view: start, queue, progress with plots and shape, stop and resume, results, comparison and exports.
"use strict";

class Runs {
  constructor(design, report, notice) {
    Object.assign(this, { design, report, notice });
    const run = (text) => [text, "", "run"], yes = (text) => [text, "", "yes"];
    this.options = {
      steady: [["--speed", "Speed [m/s]", ""], ["--grid", "Cells, for example 40,40,60", ""], ["--unsteady", ...yes("Average an unsteady wake over time")]],
      inflate: [["--pressure", "Pressure [Pa]", ""], ["--duration", "Duration [s]", ""], ["--cloth-nodes", "Cloth nodes", ""], ["--air", "Load model: uniform or coupled", ""]],
      fly: [["--mass", "Payload mass [kg]", ""], ["--duration", "Duration [s]", ""], ["--height", "Height above the ground [m]", ""], ["--cloth-nodes", "Cloth nodes", ""], ["--cells-across", "Cells across the diameter", ""]],
      sweep: [["--speeds", "Speeds, for example 10,15,20 [m/s]", ""], ["--vary", "Key and values, KEY=V1,V2", ""], ["--grid", "Cells, for example 40,40,60", ""], ["--jobs", "Simultaneous runs", ""]],
      load: [["--mass", "Payload mass [kg]", "2.4"], ["--speed", "Airspeed at line stretch [m/s]", "20"], ["--height", "Height above sea level [m]", ""], ["--reef", "Reefed stage SHARE:SECONDS", ""], ["--steady", ...run("Drag area of a steady run")], ["--opening", ...run("Drag area over distance of an inflation")]],
      stability: [["--angles", "Angles FROM:TO:STEP [°]", "0:40:10"], ["--cells-across", "Cells across the diameter", ""], ["--speed", "Speed [m/s]", ""], ["--steady", ...run("Shape of a steady run")]],
      recovery: [["--mass", "Mass without parachutes [kg]", ""], ["--apogee", "Apogee above the ground [m]", "500"], ["--drogue", "Drogue, which opens at apogee", "", "case"], ["--main-height", "Height at which the main opens [m]", ""], ["--speed", "Horizontal airspeed at apogee [m/s]", ""], ["--delay", "Time from apogee to the first opening [s]", ""], ["--ground", "Ground above sea level [m]", ""], ["--wind", "Wind [m/s]", ""], ["--bay-diameter", "Diameter of the parachute bay [m]", ""], ["--steady", ...run("Drag area of the main")], ["--drogue-steady", ...run("Drag area of the drogue")]],
      size: [["--mass", "Payload mass [kg]", "2.4"], ["--descent-rate", "Descent rate [m/s]", "5"], ["--family", "Family", "flat-circular"], ["--height", "Height above sea level [m]", ""]],
    };
    const texts = { steady: "Steady flow", inflate: "Inflation", fly: "Free flight", sweep: "Sweep", load: "Opening load", stability: "Stability", recovery: "Recovery", size: "Size and verify" };
    this.command = element("select", { "data-control": "command", onchange: () => this.fields() }, Object.entries(texts).map(([value, text]) => element("option", { value }, text)));
    this.name = element("input", { spellcheck: false, "data-control": "name" });
    this.inputs = element("div", { class: "fields" });
    this.problem = element("p", { class: "problem", role: "alert" });
    this.list = element("div", { "data-part": "jobs" });
    this.log = element("pre", { class: "log", tabindex: 0, "aria-label": "Output of the run" });
    this.plots = element("div", { class: "plots" });
    this.stage = element("div");
    this.detail = element("div", { class: "panel", hidden: true, "data-part": "detail" }, this.title = element("h2"), this.log, this.plots, this.stage);
    this.others = element("div", { class: "panel", hidden: true });
    this.chosen = new Set();  // runs to compare
    this.comparison = element("button", { type: "button", "data-control": "compare-runs", disabled: true, onclick: () => this.report(...this.chosen) }, "Compare the marked runs");
    this.node = element("div", { class: "view", id: "view-runs" }, element("div", { class: "jobs" },
      element("form", { class: "panel fields", onsubmit: (event) => { event.preventDefault(); this.start(); } }, element("h2", {}, "Start a run"),
        element("label", {}, "Run", this.command), this.inputs, element("label", {}, "Name", this.name), this.problem,
        element("button", { type: "submit", class: "primary", "data-control": "start" }, "Start")),
      element("div", { class: "column" }, element("div", { class: "panel" }, element("h2", {}, "Queue"), this.list, element("p", {}, this.comparison)), this.others, this.detail)));
    this.known = "";
    this.fields();
  }

  /** Names of run folders that may provide the drag or the shape of another run. */
  finishedRuns() {
    return (this.folders ?? []).filter((one) => one.sealed).map((one) => one.name);
  }

  fields() {
    this.inputs.replaceChildren(...this.options[this.command.value].map(([option, text, value, kind]) => {
      if (kind === "yes") return element("label", {}, text, element("input", { type: "checkbox", "data-option": option }));
      if (kind === "case") return element("label", {}, text, element("select", { "data-option": option }, element("option", { value: "" }, "none"), (this.design.folderFiles ?? []).map((name) => element("option", { value: name }, name))));
      if (kind === "run") return element("label", {}, text, element("select", { "data-option": option }, element("option", { value: "" }, "none"), this.finishedRuns().map((name) => element("option", { value: name }, name))));
      return element("label", {}, text, element("input", { "data-option": option, value, spellcheck: false, placeholder: "default" }));
    }));
    this.propose();
  }

  /** Names of the fields of a run, by their option. */
  names(command) {
    return { "--out": "Name", ...Object.fromEntries((this.options[command] ?? []).map(([option, text]) => [option, Words.name(text)])) };
  }

  /** A name that no run has. */
  propose() {
    const stem = (this.design.file ?? "case").replace(/\.toml$/, ""), base = this.command.value === "size" ? "sized" : `${stem}-${this.command.value}`.slice(0, 60);
    const taken = new Set([...(this.jobs ?? []), ...(this.folders ?? [])].map((one) => one.name));
    let name = base;
    for (let i = 2; taken.has(name); ++i) name = `${base}-${i}`;
    this.name.value = name;
  }

  async start() {
    const options = {};
    for (const input of this.inputs.querySelectorAll("[data-option]")) {
      if (input.type === "checkbox") { if (input.checked) options[input.dataset.option] = true; }
      else if (input.value.trim()) options[input.dataset.option] = input.value.trim();
    }
    try {
      await Server.post("/api/jobs/start", { name: this.name.value.trim(), command: this.command.value, case: this.design.file ?? "", options }, this.names(this.command.value));
      this.problem.textContent = "";
      this.select(this.name.value.trim());
      await this.refresh();
      this.propose();
    } catch (error) { this.problem.textContent = error.message; }
  }

  async act(path, name) {
    try {
      await Server.post(path, { name });
      await this.refresh();
    } catch (error) { this.notice(error.message); }
  }

  select(name) {
    this.selected = name;
    this.shapeName = "";
    this.drawn = "";
    this.plots.replaceChildren();
    this.stage.replaceChildren();
  }

  async refresh() {
    this.jobs = await Server.get("/api/jobs");
    const now = JSON.stringify([this.jobs, this.selected, [...this.chosen], this.folders]);
    if (now !== this.known) {
      this.known = now;
      const focus = document.activeElement?.dataset?.focus;
      this.list.replaceChildren(...(this.jobs.length ? this.jobs.map((job) => this.job(job)) : [element("p", { class: "muted" }, "No run has been started here.")]));
      if (focus) this.list.querySelector(`[data-focus="${CSS.escape(focus)}"]`)?.focus();
    }
    if (this.selected && this.node.isConnected) await this.showProgress(this.selected);
  }

  /** A run that `ripstop report` can compare with others. */
  mark(name) {
    return element("input", { type: "checkbox", checked: this.chosen.has(name), "data-focus": `mark ${name}`, "data-mark": name, "aria-label": `Compare ${name}`, title: "Mark for the comparison", onchange: (event) => {
      if (event.target.checked) this.chosen.add(name); else this.chosen.delete(name);
      this.comparison.disabled = this.chosen.size < 2;
    } });
  }

  job(job) {
    const button = (text, action) => element("button", { type: "button", "data-focus": `${text} ${job.name}`, onclick: action }, text);
    const buttons = [];
    if (job.state === "running" || job.state === "queued") buttons.push(button("Stop", () => this.act("/api/jobs/stop", job.name)));
    if (["stopped", "failed", "not converged"].includes(job.state)) buttons.push(button("Resume", () => this.act("/api/jobs/resume", job.name)));
    if (job.report) buttons.push(button("Report", () => this.report(job.name)), button("Save report", () => this.exported(job.name, "report")));
    if (job.command === "steady" && job.state === "finished")
      for (const format of ["RocketPy", "OpenRocket", "JSON", "TOML"]) buttons.push(button(format, () => this.exported(job.name, format.toLowerCase())));
    buttons.push(button("Output", () => { this.select(job.name); this.refresh(); }));
    const compared = job.report && ["steady", "inflate", "sweep", "fly"].includes(job.command);
    return element("div", { class: "job", "data-job": job.name, "data-state": job.state },
      element("div", {}, compared ? [this.mark(job.name), " "] : null, element("strong", {}, job.name), ` · ${job.command}${job.case ? ` of ${job.case}` : ""} · `, element("span", { class: job.state === "failed" ? "bad" : job.state === "finished" ? "good" : "" }, job.state)),
      element("div", { class: "row" }, buttons), element("div", { class: "line" }, Words.shown(job.message || job.last_line, this.names(job.command))));
  }

  /** Output, plots of the tables and last shape of a run, while it is on and afterwards. */
  async showProgress(name) {
    const { lines } = await Server.get("/api/log", { name });
    const progress = await Server.get("/api/progress", { name, known: this.shapeName ?? "" });
    if (name !== this.selected) return;
    this.detail.hidden = false;
    this.detail.dataset.run = name;
    this.title.textContent = name;
    const names = this.names(this.jobs.find((job) => job.name === name)?.command);
    const text = lines.map((line) => (/^(ripstop|warning): /.test(line) ? Words.shown(line, names) : line)).join("\n");
    if (this.log.textContent !== text) {
      this.log.textContent = text;
      this.log.scrollTop = this.log.scrollHeight;
    }
    this.drawPlots(progress.plots);
    if (progress.shape) await this.drawShape(progress);
  }

  drawPlots(plots) {
    const wanted = plots.filter((plot) => ["forces", "changes", "history", "load", "size", "angle", "speed", "height", "place"].includes(plot.id)), now = JSON.stringify(wanted);
    if (now === this.drawn) return;
    this.drawn = now;
    const figures = wanted.map((plot) => new Plots.Figure(plot, null));
    this.plots.replaceChildren(...figures.map((figure) => figure.node));
    for (const figure of figures) figure.draw();
  }

  async drawShape(progress) {
    this.shapeName = progress.shapeName;
    Colours.setCloth(progress.shape.colours);
    await Data.unpackAll(progress.shape);
    try {
      this.section ??= new ShapeSection();
    } catch { return; }  // without WebGL
    this.stage.replaceChildren(this.section.node);
    this.section.show(new Controls({ shape: progress.shape }, this.section.viewer, new Clock(0)));
    this.stage.dataset.shape = progress.shapeName;
  }

  redraw() {
    this.drawn = "";
    this.section?.viewer.draw();
  }

  async exported(run, format) {
    try {
      const file = await Server.get("/api/export", { run, format });
      const link = element("a", { href: URL.createObjectURL(new Blob([file.text])), download: file.name });
      link.click();
      URL.revokeObjectURL(link.href);
      this.select(null);
      this.detail.hidden = false;
      this.title.textContent = `${file.name} is saved where the browser saves downloads`;
      this.log.textContent = format === "report" ? "" : file.text;
    } catch (error) { this.notice(error.message); }
  }

  /** Run folders that the command line made. */
  folder(folders) {
    this.folders = folders;
    const own = new Set((this.jobs ?? []).map((job) => job.name)), rest = folders.filter((one) => !own.has(one.name)), now = JSON.stringify(rest);
    this.others.hidden = !rest.length;
    if (now === this.others.dataset.runs) return;
    this.others.dataset.runs = now;
    this.others.replaceChildren(element("h2", {}, "Other run folders"), ...rest.map((one) => element("div", { class: "job" },
      element("span", {}, one.report ? [this.mark(one.name), " "] : null, one.name, one.sealed ? " · finished" : ""),
      element("div", { class: "row" }, one.report ? element("button", { type: "button", onclick: () => this.report(one.name) }, "Report") : null))));
  }
}
