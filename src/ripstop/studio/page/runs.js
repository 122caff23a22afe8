// The runs view: start, queue, progress, stop and resume, results and exports.
"use strict";

class Runs {
  constructor(design, report, notice) {
    Object.assign(this, { design, report, notice });
    this.options = {
      steady: [["--speed", "Speed [m/s]", ""], ["--grid", "Cells, for example 40,40,60", ""]],
      inflate: [["--pressure", "Pressure [Pa]", ""], ["--duration", "Duration [s]", ""], ["--cloth-nodes", "Cloth nodes", ""], ["--air", "Load model: uniform or coupled", ""]],
      fly: [["--mass", "Payload mass [kg]", ""], ["--duration", "Duration [s]", ""], ["--height", "Height above the ground [m]", ""], ["--cloth-nodes", "Cloth nodes", ""], ["--cells-across", "Cells across the diameter", ""]],
      size: [["--mass", "Payload mass [kg]", "2.4"], ["--descent-rate", "Descent rate [m/s]", "5"], ["--family", "Family", "flat-circular"], ["--height", "Height above sea level [m]", ""]],
    };
    const texts = { steady: "Steady flow", inflate: "Inflation", fly: "Free flight", size: "Size and verify" };
    this.command = element("select", { "data-control": "command", onchange: () => this.fields() }, Object.entries(texts).map(([value, text]) => element("option", { value }, text)));
    this.name = element("input", { spellcheck: false, "data-control": "name" });
    this.inputs = element("div", { class: "fields" });
    this.problem = element("p", { class: "problem", role: "alert" });
    this.list = element("div", { "data-part": "jobs" });
    this.log = element("pre", { class: "log", tabindex: 0, "aria-label": "Output of the run" });
    this.plot = element("div");
    this.detail = element("div", { class: "panel", hidden: true }, this.title = element("h2"), this.plot, this.log);
    this.others = element("div", { class: "panel", hidden: true });
    this.node = element("div", { class: "view", id: "view-runs" }, element("div", { class: "jobs" },
      element("form", { class: "panel fields", onsubmit: (event) => { event.preventDefault(); this.start(); } }, element("h2", {}, "Start a run"),
        element("label", {}, "Run", this.command), this.inputs, element("label", {}, "Name", this.name), this.problem,
        element("button", { type: "submit", class: "primary", "data-control": "start" }, "Start")),
      element("div", { class: "fields" }, element("div", { class: "panel" }, element("h2", {}, "Queue"), this.list), this.others, this.detail)));
    this.known = "";
    this.fields();
  }

  fields() {
    this.inputs.replaceChildren(...this.options[this.command.value].map(([option, text, value]) => element("label", {}, text, element("input", { "data-option": option, value, spellcheck: false }))));
    this.propose();
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
    for (const input of this.inputs.querySelectorAll("input")) if (input.value.trim()) options[input.dataset.option] = input.value.trim();
    try {
      await Server.post("/api/jobs/start", { name: this.name.value.trim(), command: this.command.value, case: this.design.file ?? "", options });
      this.problem.textContent = "";
      this.selected = this.name.value.trim();
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

  async refresh() {
    this.jobs = await Server.get("/api/jobs");
    const now = JSON.stringify([this.jobs, this.selected]);
    if (now !== this.known) {
      this.known = now;
      const focus = document.activeElement?.dataset?.focus;
      this.list.replaceChildren(...(this.jobs.length ? this.jobs.map((job) => this.job(job)) : [element("p", { class: "muted" }, "No run has been started here.")]));
      if (focus) this.list.querySelector(`[data-focus="${CSS.escape(focus)}"]`)?.focus();
    }
    if (this.selected) await this.showLog();
  }

  job(job) {
    const button = (text, action) => element("button", { type: "button", "data-focus": `${text} ${job.name}`, onclick: action }, text);
    const buttons = [];
    if (job.state === "running" || job.state === "queued") buttons.push(button("Stop", () => this.act("/api/jobs/stop", job.name)));
    if (["stopped", "failed", "not converged"].includes(job.state)) buttons.push(button("Resume", () => this.act("/api/jobs/resume", job.name)));
    if (job.report) buttons.push(button("Report", () => this.report(job.name)));
    if (job.command === "steady" && job.state === "finished") for (const format of ["RocketPy", "OpenRocket"]) buttons.push(button(format, () => this.exported(job.name, format.toLowerCase())));
    buttons.push(button("Output", () => { this.selected = job.name; this.refresh(); }));
    return element("div", { class: "job", "data-job": job.name, "data-state": job.state },
      element("div", {}, element("strong", {}, job.name), ` · ${job.command}${job.case ? ` of ${job.case}` : ""} · `, element("span", { class: job.state === "failed" ? "bad" : job.state === "finished" ? "good" : "" }, job.state)),
      element("div", { class: "row" }, buttons), element("div", { class: "line" }, job.message || job.last_line));
  }

  async showLog() {
    const { lines } = await Server.get("/api/log", { name: this.selected });
    this.detail.hidden = false;
    this.title.textContent = this.selected;
    const text = lines.join("\n");
    if (this.log.textContent === text) return;
    this.log.textContent = text;
    this.log.scrollTop = this.log.scrollHeight;
    const drag = lines.map((line) => /drag (-?[\d.]+) N/.exec(line)?.[1]).filter(Boolean).map(Number);
    this.plot.replaceChildren();
    if (drag.length < 2) return;
    const figure = new Plots.Figure({ id: "progress", title: "Drag in the course of the run", x: { text: "line of progress", unit: "" }, y: { text: "drag", unit: "N" }, series: [{ name: "drag", x: drag.map((_, i) => i + 1), y: drag, line: true }] }, null);
    this.plot.append(figure.node);
    figure.draw();
  }

  async exported(run, format) {
    try {
      const file = await Server.get("/api/export", { run, format });
      const link = element("a", { href: URL.createObjectURL(new Blob([file.text])), download: file.name });
      link.click();
      URL.revokeObjectURL(link.href);
      this.selected = null;
      this.detail.hidden = false;
      this.title.textContent = file.name;
      this.plot.replaceChildren();
      this.log.textContent = file.text;
    } catch (error) { this.notice(error.message); }
  }

  /** Run folders that the command line made. */
  folder(folders) {
    this.folders = folders;
    const own = new Set((this.jobs ?? []).map((job) => job.name)), rest = folders.filter((one) => !own.has(one.name));
    this.others.hidden = !rest.length;
    this.others.replaceChildren(element("h2", {}, "Other run folders"), ...rest.map((one) => element("div", { class: "job" }, element("span", {}, one.name, one.sealed ? " · finished" : ""),
      element("div", { class: "row" }, one.report ? element("button", { type: "button", onclick: () => this.report(one.name) }, "Report") : null))));
  }
}
