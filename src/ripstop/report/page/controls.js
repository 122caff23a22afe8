// The panel of one run's shape: what is coloured, how, from where it is seen, when, and the probe.
"use strict";

/** Milliseconds of an opening, seconds of a flight, which lasts `end` seconds. */
const timeText = (time, end) => (end > 5 ? `${Numbers.shown(Number(time.toFixed(3)), 4)} s` : `${Numbers.shown(Number((1000 * time).toFixed(2)), 5)} ms`);

/** The time of an opening or a flight, which shape and plots share. */
class Clock {
  constructor(end) { this.time = end; this.end = end; this.listeners = []; }
  listen(listener) { this.listeners.push(listener); }
  set(time) {
    this.time = Math.min(this.end, Math.max(0, time));
    for (const listener of this.listeners) listener(this.time);
  }
}

function colourBar(scale, name) {
  const low = element("span"), high = element("span"), about = element("span", { class: "about" });
  const ramp = element("div", { class: "ramp" });
  ramp.style.background = Colours.css(scale);
  const node = element("div", { class: "bar", "data-bar": name, role: "img" }, about, ramp, element("div", { class: "ends" }, low, element("span"), high));
  const set = (words, range) => {
    about.textContent = withUnit(words);
    const snapped = (value) => (Math.abs(value) < 2e-3 * (range[1] - range[0]) ? 0 : value);
    low.textContent = Numbers.shown(snapped(range[0]), 3);
    node.querySelector(".ends span:nth-child(2)").textContent = Numbers.shown((range[0] + range[1]) / 2, 3);
    high.textContent = Numbers.shown(range[1], 3);
    node.setAttribute("aria-label", `Colours: ${withUnit(words)} from ${low.textContent} to ${high.textContent}`);
  };
  return { node, set };
}

class Controls {
  constructor(run, viewer, clock) {
    Object.assign(this, { run, viewer, clock });
    this.canopy = new Canopy(run.shape);
    this.air = run.flow ? new Air(run.flow) : null;
    this.quantities = this.canopy.quantities();
    const liked = ["von_mises_n_per_m"].find((key) => this.quantities.some((one) => one.key === key));
    this.key = liked ?? this.quantities[0]?.key;
    this.fullRange = false;
    this.slice = { axis: 0, place: 0, quantity: "speed" };
    this.side = element("div", { class: "side" });
    this.build();
  }

  build() {
    const box = (text, checked, change, name) => element("label", {}, element("input", { type: "checkbox", checked, "data-control": name, onchange: (event) => change(event.target.checked) }), text);
    this.choice = element("select", { "aria-label": "Colour the cloth by", "data-control": "quantity", onchange: () => this.colourBy(this.choice.value) },
      this.quantities.map((one) => element("option", { value: one.key, selected: one.key === this.key }, withUnit(one))));
    this.clothBar = colourBar(Colours.clothScale(), "cloth");
    this.peak = element("button", { type: "button", onclick: () => this.probeHighest() }, "Show the maximum");
    this.side.append(element("fieldset", { hidden: !this.quantities.length }, element("legend", {}, "Cloth"), this.choice, this.clothBar.node,
      box("full range with isolated peaks", false, (on) => { this.fullRange = on; this.recolour(); }, "range"), element("div", { class: "row" }, this.peak)));
    if (this.run.shape.frames.some((frame) => frame.tension)) {
      this.lineBar = colourBar(Colours.clothScale(), "lines");
      this.side.append(element("fieldset", {}, element("legend", {}, "Lines and tape"),
        box("shown", true, (on) => { this.canopy.lines.mesh.visible = on; this.viewer.draw(); }, "lines"), this.lineBar.node));
    }
    if (this.canopy.trail) this.side.append(element("fieldset", {}, element("legend", {}, "Path of the payload"),
      box("shown", true, (on) => { this.canopy.trail.mesh.visible = on; this.viewer.draw(); }, "path")));
    if (this.air) this.side.append(this.airControls(box));
    const views = [["oblique", "Oblique"], ["side", "Side"], ["below", "Mouth"], ["above", "Vent"]];
    this.side.append(element("fieldset", {}, element("legend", {}, "View"), element("div", { class: "row" },
      views.map(([view, text]) => element("button", { type: "button", "data-view": view, onclick: () => this.viewer.look(view) }, text)))));
    this.side.append(element("p", { class: "keys" }, "Mouse: move with the button pressed to turn, wheel to zoom, click to keep the probe. Keys: ", element("kbd", {}, "← ↑ → ↓"), " turn, ",
      element("kbd", {}, "+ −"), " zoom, ", element("kbd", {}, "1–4"), " views, ", element("kbd", {}, "H"), " maximum value",
      this.moving() ? [", ", element("kbd", {}, "space"), " plays"] : ""));
  }

  airControls(box) {
    this.airBar = colourBar(Colours.airScale(), "air");
    const place = element("input", { type: "range", "aria-label": "Position of the slice", "data-control": "slice-place", oninput: () => this.setSlice({ place: Number(place.value) }) });
    const axis = element("select", { "aria-label": "Slice across", "data-control": "slice-axis", onchange: () => { this.slice.axis = Number(axis.value); ends(); } },
      [["0", "slice across x"], ["1", "slice across y"], ["2", "slice across z (the stream)"]].map(([value, text]) => element("option", { value }, text)));
    const quantity = element("select", { "aria-label": "Colour the slice by", "data-control": "slice-quantity", onchange: () => this.setSlice({ quantity: quantity.value }) },
      element("option", { value: "speed" }, "speed [m/s]"), element("option", { value: "pressure" }, "pressure [Pa]"));
    const ends = () => {
      const [low, high] = this.air.extent(this.slice.axis);
      Object.assign(place, { min: low, max: high, step: (high - low) / 400, value: this.slice.axis === 2 ? (low + high) / 2 : 0.5 * (low + high) });
      this.setSlice({ place: Number(place.value) });
    };
    this.placeText = element("output", { class: "muted" });
    this.sliceParts = [axis, quantity, place, this.placeText];
    this.initSlice = ends;
    return element("fieldset", {}, element("legend", {}, "Air"),
      box("slice", false, (on) => { this.air.plane.visible = on; this.showSliceParts(on); this.setSlice({}); }, "slice"),
      this.sliceParts, box("streamlines, by speed", false, (on) => { this.air.streamlines.mesh.visible = on; this.setSlice({}); }, "streamlines"), this.airBar.node);
  }

  showSliceParts(on) { for (const part of this.sliceParts) part.hidden = !on; }

  setSlice(change) {
    Object.assign(this.slice, change);
    this.air.cut(this.slice.axis, this.slice.place, this.slice.quantity);
    this.placeText.textContent = `${"xyz"[this.slice.axis]} = ${Numbers.shown(this.slice.place, 3)} m`;
    const pressure = this.air.plane.visible && this.slice.quantity === "pressure";
    this.airBar.node.hidden = !this.air.plane.visible && !this.air.streamlines.mesh.visible;
    this.airBar.set(pressure ? { text: "pressure of the air", unit: "Pa" } : { text: "speed of the air", unit: "m/s" }, pressure ? this.air.range("pressure") : this.air.speedRange);
    if (!pressure && this.air.plane.visible) this.airBar.set({ text: "speed of the air", unit: "m/s" }, this.air.range("speed"));
    this.viewer.draw();
  }

  moving() { return this.run.shape.frames.length > 1; }
  words() { return this.quantities.find((one) => one.key === this.key) ?? { text: "no values", unit: "" }; }

  /** Takes the stage. */
  activate() {
    this.viewer.show(this.canopy, this.air);
    if (this.air) { this.showSliceParts(this.air.plane.visible); this.initSlice(); }
    this.colourBy(this.key);
  }

  colourBy(key) {
    this.key = key;
    this.choice.value = key;
    this.recolour();
    this.setTime(this.clock.time);
  }

  recolour() {
    const range = this.canopy.range(this.key, this.fullRange ? 0 : 0.01);
    this.canopy.material.uniforms.low.value = range[0];
    this.canopy.material.uniforms.high.value = range[1];
    this.clothBar.set(this.words(), range);
    if (this.lineBar) {
      const tension = this.canopy.tensionRange(), uniforms = this.canopy.lines.material.uniforms;
      uniforms.low.value = tension[0];
      uniforms.high.value = tension[1];
      this.lineBar.set({ text: "tension", unit: "N" }, tension);
    }
    this.viewer.draw();
  }

  setTime(time) {
    this.canopy.set(time, this.key);
    this.viewer.draw();
  }

  /** What is said of a cell. */
  cellText(cell) {
    const value = this.canopy.values[cell], words = this.words();
    const place = this.canopy.centre(cell).map((x) => Numbers.shown(Number(x.toFixed(4)), 4)).join(", ");
    return [`${words.text}: ${Number.isNaN(value) ? "–" : Numbers.shown(value, 4)} ${words.unit}`.trim(), `at (${place}) m`];
  }
  segmentText(segment) {
    const tension = this.canopy.tension ? Numbers.shown(this.canopy.tension[segment], 4) : "–";
    const part = this.run.shape.partNames[this.run.shape.parts[segment]];
    return [`tension: ${tension} N`, part ?? "line or tape"];
  }

  highestCell() {
    let best = 0;
    for (let cell = 1; cell < this.canopy.cells; ++cell)
      if (!(this.canopy.values[cell] <= this.canopy.values[best])) best = Number.isNaN(this.canopy.values[cell]) ? best : cell;
    return best;
  }
  probeHighest() { this.onprobe?.({ cell: this.highestCell() }); }
}

/** Stage, panel and timeline of the shown run. */
class ShapeSection {
  constructor() {
    this.stage = element("div", { class: "stage" });
    this.probe = element("div", { class: "probe", hidden: true, role: "status", "aria-live": "polite" });
    this.marker = element("div", { class: "marker", hidden: true });
    this.sideSlot = element("div");
    this.play = element("button", { type: "button", "data-control": "play", onclick: () => this.toggle() }, "▶ Play");
    this.slider = element("input", { type: "range", min: 0, max: 1, step: "any", "aria-label": "Time", "data-control": "time", oninput: () => { this.stop(); this.controls.clock.set(Number(this.slider.value)); } });
    this.when = element("output");
    this.timeline = element("div", { class: "timeline", hidden: true }, this.play, this.slider, this.when);
    this.node = element("div", { class: "viewer panel no-print" }, this.stage, this.sideSlot, this.timeline);
    this.viewer = new Viewer(this.stage);
    this.stage.append(this.marker, this.probe);
    this.listen();
  }

  show(controls) {
    this.stop();
    this.controls = controls;
    this.kept = null;
    this.sideSlot.replaceWith(controls.side);
    this.sideSlot = controls.side;
    this.timeline.hidden = !controls.moving();
    this.slider.max = controls.clock.end;
    this.slider.step = controls.clock.end / 2000 || 1;
    controls.onprobe = (what) => { this.kept = what; this.place(); };
    controls.activate();
    this.tick(controls.clock.time);
    if (!controls.listening) controls.clock.listen((time) => { if (this.controls === controls) { controls.setTime(time); this.tick(time); } });
    controls.listening = true;
    this.place();
  }

  tick(time) {
    this.slider.value = time;
    this.when.textContent = timeText(time, this.controls.clock.end);
    this.slider.setAttribute("aria-valuetext", this.when.textContent);
  }

  listen() {
    const canvas = this.viewer.canvas;
    canvas.addEventListener("pointermove", (event) => { if (!event.buttons) this.hover(event); });
    canvas.addEventListener("pointerdown", (event) => { this.pressed = [event.clientX, event.clientY]; });
    canvas.addEventListener("pointerup", (event) => {
      if (!this.pressed || Math.hypot(event.clientX - this.pressed[0], event.clientY - this.pressed[1]) > 3) return;
      this.kept = this.under(event);
      this.place();
    });
    canvas.addEventListener("pointerleave", () => { this.over = null; this.place(); });
    canvas.addEventListener("keydown", (event) => this.key(event));
    this.stage.addEventListener("drawn", () => this.place());
  }

  under(event) {
    const frame = this.stage.getBoundingClientRect(), x = event.clientX - frame.left, y = event.clientY - frame.top;
    const hit = this.viewer.cellAt(x, y);
    const segment = this.controls.canopy.lines.mesh.visible && !hit ? this.viewer.segmentAt(x, y) : null;
    return hit ? { cell: hit.cell } : segment !== null ? { segment } : null;
  }

  hover(event) {
    if (this.busy) return;
    this.busy = true;
    requestAnimationFrame(() => { this.busy = false; this.over = this.under(event); this.place(); });
  }

  /** Probe and marker where the cell or segment now is. */
  place() {
    const what = this.over ?? this.kept;
    this.probe.hidden = this.marker.hidden = !what || !this.controls;
    if (this.probe.hidden) return;
    const { canopy } = this.controls, { segments } = canopy.shape;
    const text = what.cell !== undefined ? this.controls.cellText(what.cell) : this.controls.segmentText(what.segment);
    const point = what.cell !== undefined ? canopy.centre(what.cell)
      : [0, 1, 2].map((c) => (canopy.points[3 * segments[2 * what.segment] + c] + canopy.points[3 * segments[2 * what.segment + 1] + c]) / 2);
    const [x, y] = this.viewer.project(point);
    this.probe.replaceChildren(element("b", {}, text[0]), text[1]);
    this.marker.style.left = `${x}px`;
    this.marker.style.top = `${y}px`;
    const left = x + 14 + this.probe.offsetWidth < this.stage.clientWidth ? x + 14 : x - 14 - this.probe.offsetWidth;
    this.probe.style.left = `${Math.max(4, left)}px`;
    this.probe.style.top = `${Math.min(Math.max(4, y - 10), this.stage.clientHeight - this.probe.offsetHeight - 4)}px`;
  }

  key(event) {
    const step = Math.PI / 36, views = { 1: "oblique", 2: "side", 3: "below", 4: "above" };
    const actions = {
      ArrowLeft: () => this.viewer.turn(-step, 0), ArrowRight: () => this.viewer.turn(step, 0),
      ArrowUp: () => this.viewer.turn(0, step), ArrowDown: () => this.viewer.turn(0, -step),
      "+": () => this.viewer.turn(0, 0, 0.9), "=": () => this.viewer.turn(0, 0, 0.9), "-": () => this.viewer.turn(0, 0, 1 / 0.9),
      h: () => this.controls.probeHighest(), H: () => this.controls.probeHighest(),
      Escape: () => { this.kept = this.over = null; this.place(); },
      " ": () => { if (this.controls.moving()) this.toggle(); },
    };
    const action = actions[event.key] ?? (views[event.key] && (() => this.viewer.look(views[event.key])));
    if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    action();
  }

  toggle() { if (this.playing) this.stop(); else this.start(); }
  stop() {
    this.playing = false;
    this.play.textContent = "▶ Play";
  }
  start() {
    // From frame to frame: those of an inflation are closer in time than those of the flight that follows it.
    const { clock, run } = this.controls, times = run.shape.frames.map((frame) => frame.time), last = times.length - 1;
    const seconds = run.kind === "flight" ? Math.min(30, Math.max(8, clock.end)) : 8;
    const frameAt = (time) => { const { low, weight } = between(run.shape.frames, time); return low + weight; };
    const timeAt = (frame) => { const low = Math.min(last - 1, Math.floor(frame)); return times[low] + (frame - low) * (times[low + 1] - times[low]); };
    this.playing = true;
    this.play.textContent = "❚❚ Pause";
    if (clock.time >= clock.end) clock.set(times[0]);
    let before = performance.now();
    const step = (now) => {
      if (!this.playing) return;
      clock.set(timeAt(Math.min(last, frameAt(clock.time) + ((now - before) / 1000) * (last / seconds))));
      before = now;
      if (clock.time >= clock.end) this.stop(); else requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }
}
