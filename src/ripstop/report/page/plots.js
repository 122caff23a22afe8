// Plots by uPlot, in the theme's colours, with the time of the shape where they run over time.
"use strict";

const Plots = (() => {
  const height = 250, padding = 34;
  const paper = { column: 306, page: 640, height: 200 };  // [px] of an A4 sheet within its margins

  function columns(plot) {
    const usable = (value) => (plot.logarithmic && !(value > 0) ? null : value);
    const tables = plot.series.map((series) => {
      // uPlot wants rising x; equal ones are told apart by nothing, so the last stands.
      const order = series.x.map((_, i) => i).filter((i) => series.x[i] !== null).sort((a, b) => series.x[a] - series.x[b]);
      return [order.map((i) => series.x[i]), order.map((i) => usable(series.y[i]))];
    });
    return uPlot.join(tables);
  }

  function axis(words, extra) {
    return {
      label: withUnit(words), stroke: Colours.variable("--ink"), labelSize: 24, labelFont: "12px system-ui, sans-serif",
      font: "12px system-ui, sans-serif", grid: { stroke: Colours.variable("--soft"), width: 1 },
      ticks: { stroke: Colours.variable("--rule"), width: 1 }, ...extra,
    };
  }

  function series(one, index, plot) {
    const colour = Colours.series(index);
    // Points without a line lie on each other: the first full, each next a wider ring about it.
    const ring = one.line ? 0 : plot.series.slice(0, index).filter((other) => !other.line).length;
    return {
      label: one.name, stroke: colour, width: 2, spanGaps: true, dash: one.dashed ? [7, 5] : undefined,
      paths: one.line ? undefined : () => null,
      points: { show: !one.line || (one.x.length <= 40 && !one.dashed), size: one.line ? 5 : 8 + 5 * ring, fill: ring ? "transparent" : colour, stroke: colour, width: 2 },
      value: (_, value) => (value === null || value === undefined ? "–" : `${Numbers.shown(value, 4)}${plot.y.unit ? " " + plot.y.unit : ""}`),
    };
  }

  const counts = (plot) => !plot.x.unit && plot.series.every((one) => one.x.every(Number.isInteger));

  function options(plot, size) {
    return {
      ...size,
      scales: { x: { time: false }, y: { distr: plot.logarithmic ? 3 : 1 } },
      axes: [axis(plot.x, { size: 34, ...(counts(plot) ? { incrs: [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000] } : {}) }), axis(plot.y, { size: 62, values: (_, values) => values.map((v) => (v === null ? "" : Numbers.shown(v, 4))) })],
      series: [{ label: plot.x.text, value: (_, v) => (v === null ? "–" : `${Numbers.shown(v, 4)}${plot.x.unit ? " " + plot.x.unit : ""}`) },
               ...plot.series.map((one, i) => series(one, i, plot))],
      legend: { live: true }, cursor: { drag: { x: true, y: false } },
    };
  }

  /** A figure that is drawn when it is first shown; `clock` moves a line over plots of time, and is set by a click. */
  class Figure {
    constructor(plot, clock) {
      this.plot = plot;
      this.clock = plot.overTime ? clock : null;
      this.body = element("div");
      this.node = element("figure", { class: "plot panel", "data-plot": plot.id, tabindex: 0, title: "Arrow keys move along the values",
        onkeydown: (event) => this.step(event) }, element("figcaption", {}, plot.title), this.body);
      if (this.clock) this.clock.listen((time) => this.mark(time));
    }
    size() {
      if ("printing" in document.documentElement.dataset)
        return { width: this.node.classList.contains("wide-plot") ? paper.page : paper.column, height: paper.height };
      return { width: Math.max(240, this.node.clientWidth - padding), height };
    }
    draw() {
      if (this.drawn) this.drawn.destroy();
      this.body.replaceChildren();
      this.drawn = new uPlot(options(this.plot, this.size()), columns(this.plot), this.body);
      this.drawn.root.querySelector("canvas").setAttribute("role", "img");
      this.drawn.root.querySelector("canvas").setAttribute("aria-label",
        `${this.plot.title}: ${withUnit(this.plot.y)} over ${withUnit(this.plot.x)}`);
      if (!this.clock) return;
      this.now = element("div", { class: "now" });
      this.drawn.over.append(this.now);
      this.drawn.over.addEventListener("click", () => this.clock.set(this.drawn.posToVal(this.drawn.cursor.left, "x")));
      this.mark(this.clock.time);
    }
    /** To the value before or behind the cursor's. */
    step(event) {
      const way = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
      if (!way || !this.drawn) return;
      event.preventDefault();
      const along = this.drawn.data[0];
      const next = Math.min(along.length - 1, Math.max(0, (this.drawn.cursor.idx ?? (way > 0 ? -1 : along.length)) + way));
      this.drawn.setCursor({ left: this.drawn.valToPos(along[next], "x"), top: 20 });
      if (this.clock) this.clock.set(along[next]);
    }
    mark(time) {
      if (this.now) this.now.style.left = `${this.drawn.valToPos(time, "x")}px`;
    }
    resize() {
      if (this.drawn) this.drawn.setSize(this.size());
      if (this.clock && this.drawn) this.mark(this.clock.time);
    }
  }

  return { Figure };
})();
