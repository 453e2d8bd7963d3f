// The first view: maps that are dropped or chosen, their numbers, and one of them looked at.
import { Client } from "./client.mjs";
import { chart } from "./chart.mjs";
import { HeatMap, inWords } from "./heatmap.mjs";
import { Images, isImage } from "./images.mjs";
import { counted, element, fixed, grouped, held, make, rounded, save } from "./parts.mjs";
import { drawnPicture } from "./picture.mjs";
import { showSummary, sizeOf } from "./summary.mjs";
import { BAG, ofBag, onPage, refusalOnPage } from "./words.mjs";
import { Worst } from "./worst.mjs";

const MAP = /\.(ya?ml|np[yz]|gridmap(\.gz)?|ot|bt|pbstream)$/i;

export class Maps {
  #client;
  #files = new Map();
  #images;
  /** The rows of each map by its file's name, in the order in which they were measured. */
  #rows = new Map();
  #chosen = null;
  #opened = null;
  #heatMap;
  #worst;
  /** What was dropped or changed waits for what came before. */
  #queue = Promise.resolve();
  #turn = 0;

  /** @param {Client} client */
  constructor(client) {
    this.#client = client;
    this.#images = new Images(client);
    this.#heatMap = new HeatMap(element("heat-map"), client, "map", (cell, column, row) => this.#tellCell(cell, column, row),
      { w: () => this.#worst.toNext(), r: () => this.#worst.toRegion() });
    this.#worst = new Worst(client, this.#heatMap, (cells) => this.#place(cells), (cells) => this.#middle(cells));
    this.#listen();
    const inside = held("maps");
    this.add(inside.length ? inside : held("sample"), !inside.length);
  }

  /** Adds files, and measures the maps among them. A sample goes when something else comes; folders are refused. */
  add(files, isSample = false, folders = []) {
    return this.#then(() => files.length + folders.length && this.#add(files, isSample, folders));
  }

  /** Does something when all before is done. */
  #then(work) {
    this.#queue = this.#queue.then(work).catch((error) => this.#refuse(error.message));
    return this.#queue;
  }

  #isSample = false;

  async #add(files, isSample, folders) {
    if (files.length) {
      if (this.#isSample) await this.#forget();
      this.#isSample = isSample;
    }
    for (const id of ["errors", "notices"]) element(id).replaceChildren();
    const given = files.map(({ name }) => name);
    const others = files.filter((file) => this.#isAnother(file)).map(({ name }) => name);
    for (const file of files) this.#files.set(file.name, file);
    await this.#list();
    await this.#images.learn(this.#files);
    const twice = given.find((name, k) => given.indexOf(name) !== k);
    if (twice) this.#refuse(`${twice}: two files have this name, and the last is taken; give one of them another name`);
    // What waits for an image may have it now; and a file whose name was there takes its place, in what is measured, too.
    const maps = [...new Set([...given.filter((name) => !isImage(name)), ...this.#missing.keys(), ...this.#images.describing(given)])];
    if (maps.includes(this.#chosen)) this.#hide();
    for (const name of maps) {
      this.#earlier.delete(name);
      const image = this.#images.of(name);
      if (given.includes(name) && this.#files.has(image) && !given.includes(image)) this.#earlier.add(name);
      await this.#measure(name);
    }
    if (given.some(isImage)) this.#busy("reading images");
    const offered = await this.#images.offer(this.#files, given, this.#rows, (why) => this.#refuse(why));
    this.#idle();
    for (const name of folders) this.#refuse(`${name}: is a directory; allowed are files`);
    const measured = maps.filter((name) => this.#rows.has(name));
    await this.#show(measured.includes(this.#chosen) ? this.#chosen : measured[0]);
    if (maps.length > 1) this.#tell(`${measured.length === maps.length ? "" : `${measured.length} of `}${counted(maps.length, "map")} measured`);
    else if (measured.length && !isSample) this.#tell(`measured: ${this.#title(measured[0])}`);
    for (const name of measured.filter((name) => this.#earlier.has(name))) {
      this.#notice(`${name} came alone: its image is the file ${this.#images.of(name)} that was chosen earlier. Choose both if that is another one.`);
    }
    if (others.length) this.#notice(`In the place of another file of the same name, which was chosen earlier: ${others.join(", ")}.`);
    if (!measured.length && this.#rows.has(this.#chosen)) {
      const shown = this.#isSample ? "the sample" : `${this.#title(this.#chosen)}, chosen earlier`;
      const next = offered.some((name) => given.includes(name)) ? " An image is measured when it is described above." : "";
      this.#notice(`What is shown below is still ${shown}.${next}`);
    }
    this.#table();
  }

  /** Tells whether a file is another than the one of its name that was chosen earlier. */
  #isAnother({ name, size, lastModified }) {
    const before = this.#files.get(name);
    return before && !this.#images.made(name) && (before.size !== size || before.lastModified !== lastModified);
  }

  /** Returns what the map of a file is called; what the form describes has no file of its own. */
  #title(name, row = this.#rows.get(name)[0]) {
    const made = this.#images.made(name);
    if (made) return `${made.image}, described here`;
    return this.#isSample ? `A sample, not yours: ${row.map}` : row.map;
  }

  /** Shows a map that was measured now; without one, that which was shown before, or the first. */
  async #show(name) {
    const next = name ?? (this.#rows.has(this.#chosen) ? this.#chosen : [...this.#rows.keys()][0]);
    if (next && (name || next !== this.#chosen)) await this.#choose(next);
  }

  /** The descriptions that came without their images, which were here before. */
  #earlier = new Set();

  #notice(text) {
    element("notices").append(make("p", {}, text));
  }

  #list() {
    return this.#client.ask({ ask: "files", files: [...this.#files.values()] });
  }

  async #forget() {
    this.#files.clear();
    this.#rows.clear();
    this.#missing.clear();
    this.#images.forget();
    this.#earlier.clear();
    element("notices").replaceChildren();
    this.#chosen = null;
    this.#hide();
    await this.#client.ask({ ask: "forget" });
    this.#table();
  }

  #reading(name) {
    const form = new FormData(element("reading"));
    const text = (name) => form.get(name)?.toString().trim() ?? "";
    return {
      semantics: text("semantics"), mode: text("mode"), unknown: text("unknown"), encoding: text("encoding"),
      resolution: text("resolution"), submaps: form.get("submaps") === "on",
      ...this.#images.made(name),
    };
  }

  /** The images that descriptions name and that are not here, by the description's name. */
  #missing = new Map();

  async #measure(name) {
    this.#missing.delete(name);
    try {
      if (BAG.test(name)) throw new Error(ofBag(name));
      this.#busy(`measuring ${name}`);
      const text = await this.#client.text({ ask: "measure", name, reading: this.#reading(name) });
      this.#rows.set(name, JSON.parse(text));
    } catch (error) {
      // As in the module, nothing is left of what was measured under this name before.
      this.#rows.delete(name);
      if (name === this.#chosen) {
        this.#chosen = null;
        this.#hide();
      }
      if (error.missingImage) this.#missing.set(name, error.missingImage);
      this.#refuse(error.message, error.missingImage);
    } finally {
      this.#table();
      this.#idle();
    }
  }

  /** Measures everything again, as the choices say now. */
  #again() {
    this.#then(async () => {
      const [names, chosen] = [[...this.#rows.keys()], this.#chosen];
      await this.#client.ask({ ask: "forget" });
      this.#rows.clear();
      this.#hide();
      for (const id of ["errors", "notices"]) element(id).replaceChildren();
      for (const name of [...names, ...this.#refused].filter((name, k, all) => all.indexOf(name) === k)) await this.#measure(name);
      const next = this.#rows.has(chosen) ? chosen : [...this.#rows.keys()][0];
      if (next) await this.#choose(next);
    });
  }

  get #refused() {
    return [...this.#files.keys()].filter((name) => MAP.test(name) && !this.#rows.has(name));
  }

  #refuse(message, missingImage = null) {
    const hint = missingImage ? `. Drop ${missingImage.split(/[\\/]/).pop()} here, too.` : "";
    element("errors").append(make("p", {}, refusalOnPage(message), hint));
  }

  #busy(text) {
    this.#tell(text);
    element("progress").removeAttribute("value");
    element("progress").hidden = false;
    element("stop").hidden = false;
    this.#client.progress = (part) => { element("progress").value = part; };
  }

  #idle() {
    this.#tell("");
    element("progress").hidden = true;
    element("stop").hidden = true;
  }

  #tell(text) {
    element("status").textContent = text;
  }

  #table() {
    const rows = [...this.#rows].flatMap(([name, rows]) => rows.map((row) => this.#row(name, row)));
    element("rows").replaceChildren(...rows);
    element("several").hidden = rows.length < 2;
    element("exports").hidden = !this.#files.size;
    for (const id of ["save-json", "save-csv"]) element(id).disabled = !rows.length;
  }

  #row(name, row) {
    const cell = (label, ...content) => make("td", { class: "number", "data-label": label }, ...content);
    const choose = make("button", { type: "button", "aria-pressed": String(name === this.#chosen), onclick: () => this.#queueChoice(name) }, this.#title(name, row));
    return make("tr", {},
      make("th", { scope: "row" }, choose),
      cell("cells", sizeOf(row)),
      cell("mean information", fixed(row.mean_information, 6), row.meaningful ? "" : " (not meaningful)"),
      cell("information (bits)", fixed(row.information_bits, 3)),
      cell("entropy (bits)", fixed(row.entropy_bits, 3)),
      cell("observed", grouped(row.observed)),
      cell("free / occupied", `${grouped(row.free)} / ${grouped(row.occupied)}`),
      cell("unknown", row.unknown === null ? "–" : grouped(row.unknown)));
  }

  #queueChoice(name) {
    this.#then(() => this.#choose(name));
  }

  async #choose(name) {
    if (!this.#rows.has(name)) return;
    this.#chosen = name;
    this.#hide();
    this.#table();
    this.#summary(name);
    const turn = ++this.#turn;
    try {
      this.#busy(`looking at the cells of ${name}`);
      this.#opened = await this.#client.json({ ask: "open", name, reading: this.#reading(name) });
      if (turn !== this.#turn) return;
      if (this.#opened.cells && this.#opened.width && this.#opened.height) {
        const { width, height } = this.#opened;
        element("picture").hidden = false;
        element("save-png").hidden = false;
        element("heat-map").style.setProperty("--ratio", Math.min(3, Math.max(0.6, width / height)));
        this.#heatMap.show(width, height);
        element("percent").hidden = !(this.#opened.percent && /\.ya?ml$/i.test(name));
        this.#tell(`finding the worst cells of ${name}`);
        await this.#worst.find();
      }
      this.#tell(`averaging the cells of ${name}`);
      this.#sweep(await this.#client.json({ ask: "sweep" }));
    } catch (error) {
      // The module may hold no cells any more.
      this.#hidePicture();
      element("no-picture").textContent = `No picture: ${refusalOnPage(error.message)}.`;
    } finally {
      this.#idle();
    }
  }

  #hidePicture() {
    this.#opened = null;
    this.#heatMap.hide();
    this.#worst.hide();
    for (const id of ["picture", "save-png", "sweep"]) element(id).hidden = true;
  }

  #hide() {
    this.#hidePicture();
    element("summary").hidden = true;
    element("no-picture").textContent = "";
    element("cell-told").textContent = "Point at a cell, or move over the map with the arrow keys.";
  }

  #summary(name) {
    const row = this.#rows.get(name)[0];
    const image = this.#files.get(this.#images.of(name));
    const told = image && `${image.name}, ${counted(image.size, "byte")}${this.#earlier.has(name) ? ", chosen earlier" : ""}`;
    showSummary(row, this.#title(name), told);
  }

  #sweep({ rows }) {
    const inMetres = rows.every((row) => row.resolution_m !== null);
    const points = rows.filter((row) => row.mean_information !== null)
      .map((row) => [inMetres ? row.resolution_m : row.k, row.mean_information]);
    if (!points.length) return;
    element("sweep").hidden = false;
    element("sweep-chart").replaceChildren(chart({
      title: `Mean information against cell size, from ${points[0][1].toFixed(4)} to ${points.at(-1)[1].toFixed(4)} bits`,
      xLabel: inMetres ? "cell size (m)" : "cell size (cells of the map)", yLabel: "bits per observed cell",
      curves: [{ points, kind: "first" }], y: [0, 1], doubles: true, marks: true,
    }));
    const cells = (row) => [
      inMetres ? `${rounded(row.resolution_m)} m` : `${row.k} × ${row.k}`, fixed(row.mean_information, 6), grouped(row.observed),
    ];
    element("sweep-rows").replaceChildren(...rows.map((row) => make("tr", {}, ...cells(row).map((text) => make("td", { class: "number" }, text)))));
  }

  #tellCell(cell, column, row) {
    element("cell-told").textContent = `Column ${column}, row ${row}, at ${this.#place([column, row, 1, 1])}: ${inWords(cell)}${this.#worst.rank(column, row)}`;
  }

  /** Returns where the middle of a rectangle of cells is, in metres where the size of a cell is known. */
  #place(cells) {
    const [x, y] = this.#middle(cells).map((at) => at.toFixed(3));
    return this.#opened?.resolution_m ? `x ${x}, y ${y} m` : `${this.#middle(cells).join(", ")} cells`;
  }

  #middle([column, row, width, height]) {
    const { resolution_m: side, x, y, yaw } = this.#opened ?? {};
    const middle = [column + width / 2, row + height / 2];
    if (!side) return middle;
    const [right, up] = middle.map((at) => at * side);
    // Turned about the corner of the map, as its description says.
    const [cos, sin] = [Math.cos(yaw), Math.sin(yaw)];
    return [x + cos * right - sin * up, y + sin * right + cos * up];
  }

  async #export(format) {
    const text = await this.#client.text({ ask: "rows", format });
    save(`mean-information.${format}`, new Blob([text], { type: format === "csv" ? "text/csv" : "application/json" }));
  }

  async #exportPicture() {
    const row = this.#rows.get(this.#chosen)[0];
    const titles = [this.#title(this.#chosen), `mean information: ${fixed(row.mean_information, 6)} bits per observed cell${row.meaningful ? "" : " (not meaningful)"}`];
    save(`${row.map}.png`, await drawnPicture(this.#heatMap.picture(), titles, await this.#client.ask({ ask: "colours" })));
  }

  #listen() {
    const zone = element("drop");
    const over = (is) => (event) => {
      event.preventDefault();
      zone.classList.toggle("over", is);
    };
    for (const target of [document.body]) {
      target.addEventListener("dragover", over(true));
      target.addEventListener("dragleave", over(false));
      target.addEventListener("drop", (event) => {
        over(false)(event);
        this.#dropped(event.dataTransfer);
      });
    }
    element("files").addEventListener("change", ({ target }) => {
      this.add([...target.files]);
      target.value = "";
    });
    element("reading").addEventListener("change", () => this.#again());
    element("reading").addEventListener("submit", (event) => event.preventDefault());
    element("describe").addEventListener("submit", (event) => {
      event.preventDefault();
      const made = this.#images.describe();
      this.add([this.#files.get(this.#images.made(made.name).image), made]);
    });
    element("stop").addEventListener("click", () => this.#client.stop());
    element("clear").addEventListener("click", () => {
      this.#then(() => this.#forget()).then(() => element("errors").replaceChildren());
    });
    element("zoom-in").addEventListener("click", () => this.#heatMap.zoomIn(2));
    element("zoom-out").addEventListener("click", () => this.#heatMap.zoomIn(0.5));
    element("fit").addEventListener("click", () => this.#heatMap.fit());
    element("worst-side").addEventListener("change", () => this.#then(() => this.#opened?.cells && this.#worst.find()));
    element("save-json").addEventListener("click", () => this.#export("json"));
    element("save-csv").addEventListener("click", () => this.#export("csv"));
    element("save-worst").addEventListener("click", () => save(`${this.#rows.get(this.#chosen)[0].map}.worst.csv`, new Blob([this.#worst.csv(this.#opened.resolution_m ? "m" : "cells")], { type: "text/csv" })));
    element("save-png").addEventListener("click", () => this.#exportPicture());
  }

  #dropped({ items, files }) {
    const folders = [...items].map((item) => item.webkitGetAsEntry?.()).filter((entry) => entry?.isDirectory);
    const names = new Set(folders.map(({ name }) => name));
    this.add([...files].filter(({ name }) => !names.has(name)), false, [...names]);
  }
}
