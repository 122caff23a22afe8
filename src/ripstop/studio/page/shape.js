// The live shape of one case: the relaxation's shape of the moment until the equilibrium is there.
"use strict";

class ShapePane {
  /** `view` names this pane to the server, which computes one shape for each. */
  constructor(view) {
    this.view = view;
    this.number = 0;
    this.timing = element("span", { class: "muted", role: "status", "data-part": "timing" });
    this.stage = element("div");
    this.node = element("div", { class: "pane" }, this.stage);
    this.section = this.controls = null;
  }

  /** `pressure` in Pa as text; empty: the dynamic pressure of the case. */
  async draw(file, pressure) {
    const begin = performance.now(), own = ++this.number;
    const request = { view: this.view, file, nodes: 3000, ...(pressure ? { pressure } : {}) };
    this.timing.textContent = "computing the shape";
    try {
      let answer = await Server.get("/api/shape", request);
      for (let first = true; ; first = false) {
        if (own !== this.number) return;
        if (answer.superseded) {  // by more pages than the server has shapes for
          await new Promise((resolve) => { setTimeout(resolve, 500); });
          if (own === this.number) this.draw(file, pressure);
          return;
        }
        if (answer.refining) this.timing.textContent = `${this.told} · computing with ${answer.refining} nodes`;
        else {
          await this.show(answer);
          if (own !== this.number) return;
          this.tell(answer, begin, own, file);
          if (first) this.first = performance.now() - begin;
        }
        if (answer.done) return;
        answer = await Server.get("/api/shape/later", { view: this.view, number: answer.number });
      }
    } catch (error) {
      if (own === this.number) this.timing.textContent = error.message;
    }
  }

  /** Of a case with problems: the last shape. */
  keep() {
    ++this.number;
    this.timing.textContent = this.section ? "The case has problems. This is the shape of the last valid case." : "The case has problems, so that it has no shape.";
    this.timing.dataset.state = "kept";
  }

  tell(answer, begin, own, file) {
    const r = answer.result, passing = !answer.done && !r.converged;
    const state = passing ? ` · not in equilibrium yet (residual ${Numbers.shown(100 * r.residual, 2)} %)` : r.converged ? "" : " · not in equilibrium";
    const tension = r.max_line_tension_n === undefined ? "" : ` · highest line tension ${Numbers.shown(r.max_line_tension_n, 3)} N`;
    this.result = r;
    this.told = `${r.nodes} nodes under ${Numbers.shown(r.pressure_pa, 4)} Pa in ${((performance.now() - begin) / 1000).toFixed(2)} s · projected diameter ${Numbers.shown(r.projected_diameter_m, 4)} m${tension}`;
    this.timing.textContent = this.told + state;
    Object.assign(this.timing.dataset, { file, shape: own, state: answer.done ? "final" : passing ? "passing" : "equilibrium" });
  }

  async show(answer) {
    Colours.setCloth(answer.shape.colours);
    await Data.unpackAll(answer.shape);
    try {
      this.section ??= new ShapeSection();
    } catch {
      this.stage.replaceChildren(element("p", { class: "callout" }, "The 3D view needs WebGL, which this browser does not support."));
      return;
    }
    if (!this.section.node.isConnected) this.stage.replaceChildren(this.section.node);
    const viewer = this.section.viewer, before = this.controls;
    const look = before && { offset: viewer.camera.position.clone().sub(viewer.controls.target) };
    if (look) look.share = look.offset.length() / viewer.fitting(look.offset.clone().normalize());
    this.controls = new Controls({ shape: answer.shape }, viewer, new Clock(0));
    if (before?.key && this.controls.quantities.some((one) => one.key === before.key)) this.controls.key = before.key;
    this.section.show(this.controls);
    if (look) {  // seen as before, in proportion to the new size
      const toward = look.offset.normalize();
      viewer.camera.position.copy(viewer.middle).addScaledVector(toward, look.share * viewer.fitting(toward));
      viewer.controls.update();
      viewer.draw();
    }
    this.onshown?.();
  }

  redraw() { this.section?.viewer.draw(); }

  /** Seen from where `other` is seen, and in the same scale. */
  follow(other) {
    const from = other.section?.viewer, to = this.section?.viewer;
    if (!from?.canopy || !to?.canopy) return;
    to.controls.target.copy(to.middle);
    to.camera.position.copy(to.middle).add(from.camera.position.clone().sub(from.controls.target));
    to.controls.update();
    to.draw();
  }
}
