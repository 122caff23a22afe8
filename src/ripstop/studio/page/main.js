// Puts Studio together: views, case files, new cases, and the watch over the folder.
"use strict";

const Studio = (() => {
  const byId = (id) => document.getElementById(id);
  const views = [["design", "Design"], ["pattern", "Pattern"], ["text", "Text"], ["materials", "Materials"], ["runs", "Runs"], ["report", "Report"]];
  let drawings, design, runs, fitting, frame, shown, folder;

  function notice(text) {
    const node = byId("notice");
    node.hidden = !text;
    node.replaceChildren(element("span", {}, text ?? ""), element("button", { type: "button", "aria-label": "Close the message", onclick: () => { node.hidden = true; } }, "✕"));
  }

  function show(name) {
    shown = name;
    const nodes = { design: design.node, pattern: design.patternNode, text: design.textNode, materials: fitting.node, runs: runs.node, report: frame };
    byId("main").replaceChildren(nodes[name]);
    for (const tab of byId("views").children) {
      tab.setAttribute("aria-selected", String(tab.dataset.view === name));
      tab.tabIndex = tab.dataset.view === name ? 0 : -1;
    }
    sessionStorage.setItem("view", name);
    if (name === "runs") runs.propose();
  }

  function tabs() {
    byId("views").append(...views.map(([name, text]) => element("button", { type: "button", role: "tab", "data-view": name, onclick: () => show(name) }, text)));
    byId("views").addEventListener("keydown", (event) => {
      const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
      if (!step) return;
      const next = (views.findIndex(([name]) => name === shown) + step + views.length) % views.length;
      show(views[next][0]);
      byId("views").children[next].focus();
    });
  }

  async function report(...names) {
    try {
      const { address } = await Server.get("/api/report", names.map((run) => ["run", run]));
      delete frame.dataset.loaded;
      frame.replaceChildren(element("iframe", { src: address, title: `Report of ${names.join(" and ")}` }));
      frame.dataset.names = names.join(" ");
      show("report");
    } catch (error) { notice(error.message); }
  }

  async function choose(file) {
    byId("case").value = file;
    sessionStorage.setItem("case", file);
    await design.open(file);
    runs.propose();
  }

  async function look() {
    folder = await Server.get("/api/folder");
    const names = folder.cases.map((one) => one.file), select = byId("case");
    if (JSON.stringify(names) !== select.dataset.names) {
      select.dataset.names = JSON.stringify(names);
      select.replaceChildren(...names.map((name) => element("option", { value: name }, name)));
      if (design.file) select.value = design.file;
    }
    design.files(names);
    const other = folder.cases.find((one) => one.file === design.against?.file);
    if (other && other.version !== design.against.version) await design.compare(other.file);
    runs.folder(folder.runs);
  }

  /** Changes of the folder by other programs and pages, and the progress of runs. */
  async function watch() {
    try {
      await runs.refresh();
      await look();
      const now = folder.cases.find((one) => one.file === design.file);
      await design.busy;
      if (now && design.data?.file === now.file && now.version !== design.data.version) {
        const again = (await Server.get("/api/folder")).cases.find((one) => one.file === design.file);
        if (again && again.file === design.data.file && again.version !== design.data.version) await design.reread();
      }
      if (design.file && !now) notice(`${design.file} is no longer in the folder.`);
    } catch (error) { notice(error.message); }
    setTimeout(watch, 1000);
  }

  /** A copy of the case, to compare its changes with. */
  async function copy() {
    const names = folder.cases.map((one) => one.file), stem = design.file.replace(/\.toml$/, "").slice(0, 50);
    let file, number = 2;
    do file = `${stem}-${number++}.toml`; while (names.includes(file));
    try {
      await design.busy;
      await Server.post("/api/case/copy", { file, from: design.file });
      await look();
      notice(`${file} is a copy of ${design.file}. Compare the two with "Compare with".`);
    } catch (error) { notice(error.message); }
  }

  function creation() {
    const dialog = byId("create"), from = byId("create-from");
    const mode = () => dialog.querySelectorAll("[data-size]").forEach((node) => { node.hidden = from.value !== "size"; });
    from.addEventListener("change", mode);
    const family = byId("create-family"), draw = () => byId("create-drawing").replaceChildren(Form.drawing(drawings, drawings.families[family.value]));
    family.addEventListener("change", draw);
    byId("new").addEventListener("click", () => {
      byId("create-family").replaceChildren(...folder.families.map((name) => element("option", { value: name, selected: name === "flat-circular" }, name)));
      byId("create-problem").textContent = "";
      draw();
      mode();
      dialog.showModal();
    });
    byId("create-cancel").addEventListener("click", () => dialog.close());
    const go = async () => {
      const file = byId("create-file").value.trim(), family = byId("create-family").value;
      try {
        byId("create-problem").textContent = "";
        if (from.value === "size") {
          const text = (id) => byId(id).value.trim();
          await Server.post("/api/case/size", { file, family, mass: text("create-mass"), rate: text("create-rate"), speed: text("create-speed"), height: text("create-height") }, Words.fields(dialog));
        } else await Server.post("/api/case/create", { file, family });
        dialog.close();
        await look();
        await choose(file);
        if (from.value === "size") {
          design.mass.value = byId("create-mass").value;
          design.speed.value = byId("create-speed").value;
          design.drawLoads();
        }
        show("design");
      } catch (error) { byId("create-problem").textContent = error.message; }
    };
    byId("create-go").addEventListener("click", go);
    dialog.querySelector("form").addEventListener("keydown", (event) => {
      if (event.key === "Enter" && event.target.tagName === "INPUT") { event.preventDefault(); go(); }
    });
  }

  const redraw = () => { for (const view of [design, runs, fitting]) view.redraw(); };

  async function start() {
    drawings = await Server.get("/api/drawings");
    design = new Design(await Server.get("/api/schema"), drawings, notice, (text) => { byId("state").textContent = text; });
    runs = new Runs(design, report, notice);
    fitting = new Fitting(notice);
    frame = element("div", { class: "view frame", id: "view-report" }, element("p", { class: "muted", style: "padding: 1rem" }, "Open a report from the list of runs."));
    tabs();
    themeButton(redraw);
    creation();
    window.addEventListener("message", (event) => {
      if (event.data === "report ready" && event.source === frame.querySelector("iframe")?.contentWindow) frame.dataset.loaded = frame.dataset.names;
    });
    byId("copy").addEventListener("click", () => copy());
    byId("undo").addEventListener("click", () => design.undo());
    byId("redo").addEventListener("click", () => design.redo());
    byId("case").addEventListener("change", (event) => choose(event.target.value).catch((error) => notice(error.message)));
    document.addEventListener("keydown", (event) => {
      const typing = ["INPUT", "TEXTAREA"].includes(event.target.tagName);
      if (!(event.ctrlKey || event.metaKey) || typing || !design.file) return;
      if (event.key.toLowerCase() !== "z" && event.key.toLowerCase() !== "y") return;
      event.preventDefault();
      if (event.shiftKey || event.key.toLowerCase() === "y") design.redo(); else design.undo();
    });
    await runs.refresh();
    await look();
    const last = sessionStorage.getItem("case"), files = folder.cases.map((one) => one.file);
    show(sessionStorage.getItem("view") ?? "design");
    if (files.length) await choose(files.includes(last) ? last : files[0]);
    else { notice("This folder has no case file yet. Create one with \"New case\"."); byId("new").click(); }
    document.documentElement.dataset.ready = "yes";
    setTimeout(watch, 1000);
  }

  return { start, show, design: () => design, runs: () => runs };
})();

Studio.start().catch((error) => {
  document.documentElement.dataset.ready = "failed";
  document.getElementById("main").append(element("p", { class: "callout" }, error.message));
});
