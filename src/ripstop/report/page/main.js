// Puts the page together: comparison, and a section a run.
"use strict";

const Page = (() => {
  const main = document.getElementById("main");
  let shapes = null;  // the one ShapeSection, moved to the run that is shown
  const sections = [];
  const figures = [];
  const kinds = { opening: "Opening", flight: "Flight", steady: "Steady run", fabric: "Cloth under uniform pressure", size: "Sizing", stability: "Stability",
    recovery: "Recovery", "flight-log": "Flight log" };

  function headline(run) {
    const cards = run.headline.map((key) => run.values.find((value) => value.key === key)).filter((value) => value && value.value !== null);
    const state = run.kind === "steady" ? element("div", { class: "card" }, element("dt", {}, "coupling"),
      element("dd", { class: run.converged ? "good" : "" }, run.converged ? "converged" : "not converged")) : null;
    return element("dl", { class: "cards" }, cards.map((value) => element("div", { class: "card", "data-card": value.key }, element("dt", {}, value.text),
      element("dd", { title: String(value.value) }, Numbers.shown(value.value, 4), " ", element("small", {}, value.unit)))), state);
  }

  function warnings(run) {
    if (!run.warnings.length) return null;
    return element("div", { class: "callout", role: "note", "data-part": "warnings" }, element("strong", {}, "Warnings about these values"),
      element("ul", {}, run.warnings.map((text) => element("li", { class: /exceeds its allowable load|must not be used/.test(text) ? "bad" : "" }, text))));
  }

  function plotGrid(plots, clock) {
    const made = plots.map((plot) => new Plots.Figure(plot, clock));
    figures.push(...made);
    return { node: element("div", { class: "plots" }, made.map((figure) => figure.node)), figures: made };
  }

  function section(run, index) {
    const times = run.shape ? run.shape.frames.map((frame) => frame.time) : [0];
    const clock = new Clock(times[times.length - 1]);
    const stageSlot = element("div");
    const paper = element("div", { class: "paper" });
    const plots = plotGrid(run.plots, clock);
    // Next to the shape that they belong to.
    const beside = run.shape ? plots.figures.filter((figure) => ["load", ...(run.kind === "flight" ? ["angle"] : [])].includes(figure.plot.id)) : [];
    for (const figure of beside) figure.node.classList.add("wide-plot");
    const heading = { opening: "Shape and force", flight: "Shape, path and force", fabric: "Shape" }[run.kind] ?? "Shape and air";
    const about = ["bill", "sources"];
    const own = run.tables.filter((table) => !about.includes(table.id)), rest = run.tables.filter((table) => about.includes(table.id));
    const node = element("section", { class: "run", id: `run-${index}`, role: "tabpanel", "aria-label": run.name },
      element("p", { class: "muted" }, `${kinds[run.kind]} · ${run.name}`, run.title && index > 0 ? ` · ${run.title}` : ""),
      headline(run), warnings(run),
      run.shape ? element("h2", {}, heading) : null, stageSlot, paper, beside.map((figure) => figure.node),
      run.plots.length ? element("h2", {}, "Plots") : null, plots.node,
      element("h2", {}, "Results"), element("div", { class: "tables" }, Tables.results(run.values), own.map(Tables.plain)),
      element("h2", {}, "Bill of materials"), element("div", { class: "tables" }, rest.filter((table) => table.id === "bill").map(Tables.plain)),
      element("h2", {}, "Case and provenance"), element("div", { class: "tables" },
        rest.filter((table) => table.id === "sources").map(Tables.plain), Tables.pairs("provenance", "Provenance", run.provenance)),
      element("details", { class: "panel" }, element("summary", {}, "Resolved case (case.toml)"), element("pre", { "data-part": "case" }, run.caseFile)));
    return { run, node, clock, stageSlot, paper, plots: plots.figures, controls: null };
  }

  function stage(shown) {
    if (!shown.run.shape) return;
    try {
      if (!shapes) shapes = new ShapeSection();
    } catch (error) {
      shown.stageSlot.replaceChildren(element("p", { class: "callout" }, "The 3D view needs WebGL, which this browser does not support; all values are below."));
      return;
    }
    shown.stageSlot.replaceChildren(shapes.node);
    shown.controls ??= new Controls(shown.run, shapes.viewer, shown.clock);
    shapes.show(shown.controls);
  }

  function select(index) {
    sections.forEach((one, i) => { one.node.hidden = i !== index; });
    document.querySelectorAll("#tabs button").forEach((tab, i) => {
      tab.setAttribute("aria-selected", String(i === index));
      tab.tabIndex = i === index ? 0 : -1;
    });
    stage(sections[index]);
    for (const figure of sections[index].plots) if (!figure.drawn) figure.draw();
    Page.selected = index;
  }

  function tabs(runs) {
    const bar = element("nav", { id: "tabs", class: "tabs no-print", role: "tablist", "aria-label": "Runs", hidden: runs.length < 2 });
    bar.append(...runs.map((run, i) => element("button", { type: "button", role: "tab", "aria-controls": `run-${i}`, onclick: () => select(i) }, run.name)));
    bar.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
      if (!step) return;
      const next = (Page.selected + step + runs.length) % runs.length;
      select(next);
      bar.children[next].focus();
    });
    return bar;
  }

  /** Still pictures and all plots, for paper. */
  function preparePaper() {
    document.documentElement.dataset.printing = "";
    for (const figure of figures) figure.draw();
    for (const one of sections) {
      one.node.hidden = false;
      one.node.querySelectorAll("details").forEach((details) => { details.open = true; });
      stage(one);
      if (!shapes || !one.controls) continue;
      const end = one.clock.end, shots = one.run.shape.frames.length > 1 ? [0, 0.2, 0.4, 0.6, 0.8, 1].map((share) => share * end) : [end];
      const [width, height] = shots.length > 1 ? [700, 560] : [1300, 800];
      const pictures = shots.map((time) => {
        one.controls.setTime(time);
        return element("figure", {}, element("img", { src: shapes.viewer.picture(width, height), alt: `Shape at ${timeText(time, end)}` }),
          shots.length > 1 ? element("figcaption", {}, timeText(time, end)) : null);
      });
      const words = one.controls.words(), range = one.controls.canopy.range(one.controls.key, 0.01);
      pictures.push(element("p", {}, `Coloured by ${withUnit(words)}, from ${Numbers.shown(range[0], 3)} (dark) to ${Numbers.shown(range[1], 3)} (light).`));
      one.paper.className = `paper ${shots.length > 1 ? "" : "single"}`;
      one.paper.replaceChildren(...pictures);
    }
  }
  function backToScreen() {
    delete document.documentElement.dataset.printing;
    for (const one of sections) one.paper.replaceChildren();
    for (const figure of figures) if (figure.drawn) figure.draw();
    select(Page.selected);
  }

  async function start() {
    const report = Data.read();
    document.getElementById("title").textContent = report.title;
    document.getElementById("version").textContent = report.version;
    Colours.setCloth(report.colours);
    for (const run of report.runs) await Promise.all([Data.unpackAll(run.shape ?? null), Data.unpackAll(run.flow ?? null)]);
    if (report.comparison.rows.length || report.plots.length) {
      const over = plotGrid(report.plots, null);
      main.append(element("section", { class: "run", id: "comparison" }, element("h2", {}, "Comparison"), over.node, element("div", { class: "tables" }, Tables.comparison(report.comparison))));
      over.figures.forEach((figure) => figure.draw());
    }
    report.runs.forEach((run, i) => sections.push(section(run, i)));
    main.append(tabs(report.runs), ...sections.map((one) => one.node));
    themeButton(() => { for (const figure of figures) if (figure.drawn) figure.draw(); shapes?.viewer.draw(); });
    select(0);
    window.addEventListener("beforeprint", preparePaper);
    window.addEventListener("afterprint", backToScreen);
    window.addEventListener("resize", () => figures.forEach((figure) => figure.resize()));
    document.getElementById("print").addEventListener("click", () => window.print());
    document.documentElement.dataset.ready = "yes";
    if (window.parent !== window) window.parent.postMessage("report ready", "*");  // to Studio
  }

  return { start, selected: 0, sections, shown: () => sections[Page.selected], shapes: () => shapes };
})();

Page.start().catch((error) => {
  document.documentElement.dataset.ready = "failed";
  document.getElementById("main").append(element("p", { class: "callout" }, `The report cannot be shown: ${error.message}`));
  throw error;
});
