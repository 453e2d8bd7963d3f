// A grid of cells on a canvas: squares of colour from the worker, moved and enlarged by mouse, touch and keys.
import { latest, make } from "./parts.mjs";

/** A cell never gets more pixels than this. */
const LARGEST = 64;
/** The cells across the canvas around one that is gone to. */
const AROUND = 31;

export class HeatMap {
  #canvas;
  #client;
  #of;
  #told;
  #keys;
  #size = [0, 0];
  /** The cell at the middle of the canvas, from the lower left, and pixels of the page per cell. */
  #view = { x: 0, y: 0, zoom: 1 };
  /** True while all of the grid is shown, and is to be shown when the canvas changes. */
  #isFitted = true;
  #picture = null;
  /** The cell that was clicked or moved to, and the one under the pointer. */
  #mark = null;
  #hover = null;
  /** What is pointed out: cells, and a rectangle of cells. */
  #noted = { cells: [], square: null };
  #draw = latest(() => this.#fetch());
  #look = latest((column, row) => this.#tell(column, row));

  /** Draws the grid `of` ("map" or "room") on a canvas; `told(cell, column, row)` hears of the cell that is pointed at or marked.
   * `keys` are functions of more keys. */
  constructor(canvas, client, of, told, keys = {}) {
    [this.#canvas, this.#client, this.#of, this.#told, this.#keys] = [canvas, client, of, told, keys];
    this.#listen();
    new ResizeObserver(() => this.#size[0] && this.#resized()).observe(canvas);
  }

  /** Shows another grid, all of it. */
  show(width, height) {
    this.#size = [width, height];
    [this.#mark, this.#hover, this.#picture] = [null, null, null];
    this.#noted = { cells: [], square: null };
    this.#resized();
    this.fit();
  }

  hide() {
    this.#size = [0, 0];
    this.#picture = null;
  }

  fit() {
    const [width, height] = this.#size;
    this.#view = { x: width / 2, y: height / 2, zoom: this.#fitting() };
    this.#isFitted = true;
    this.#paint();
    this.#draw();
  }

  /** Points out cells `[column, row]`, and a rectangle `[column, row, width, height]` or none. */
  note(cells, square) {
    this.#noted = { cells, square };
    this.#paint();
  }

  /** Moves to a rectangle of cells, so that it fills a third of the canvas, and marks it where it is one cell. */
  goTo([column, row, width, height]) {
    const { clientWidth, clientHeight } = this.#canvas;
    const isCell = width === 1 && height === 1;
    const across = isCell ? AROUND : 3 * width;
    const up = isCell ? AROUND : 3 * height;
    const zoom = Math.min(LARGEST, Math.max(this.#fitting(), Math.min(clientWidth / across, clientHeight / up)));
    this.#view = { x: column + width / 2, y: row + height / 2, zoom };
    this.#isFitted = zoom === this.#fitting();
    [this.#mark, this.#hover] = [isCell ? [column, row] : null, null];
    this.#moved();
    if (isCell) this.#look(column, row);
  }

  /** Zooms about the marked cell, which comes into the middle where it is not seen; about the middle where none is marked. */
  zoomIn(by) {
    if (this.#mark && !this.#sees(this.#mark)) [this.#view.x, this.#view.y] = this.#mark.map((at) => at + 0.5);
    this.zoom(by, this.#mark?.map((at) => at + 0.5));
  }

  #sees(place) {
    const { x, y, zoom } = this.#view;
    const { clientWidth, clientHeight } = this.#canvas;
    return Math.abs(place[0] + 0.5 - x) <= clientWidth / zoom / 2 && Math.abs(place[1] + 0.5 - y) <= clientHeight / zoom / 2;
  }

  zoom(by, at = null) {
    const { x, y, zoom } = this.#view;
    const fitting = this.#fitting();
    // In and out again is all of it, whatever was rounded.
    const next = zoom * by < fitting * (1 + 1e-9) ? fitting : Math.min(LARGEST, zoom * by);
    const anchor = at ?? [x, y];
    const kept = 1 - zoom / next;
    this.#isFitted = next === fitting;
    this.#view = { x: x + (anchor[0] - x) * kept, y: y + (anchor[1] - y) * kept, zoom: next };
    this.#moved();
  }

  /** Draws the picture as it is seen, and what is fetched later over it. */
  #moved() {
    const [width, height] = this.#size;
    const { clientWidth, clientHeight } = this.#canvas;
    const clamped = (x, cells, pixels) => {
      const half = Math.min(cells, pixels / this.#view.zoom) / 2;
      return Math.min(cells - half, Math.max(half, x));
    };
    this.#view.x = clamped(this.#view.x, width, clientWidth);
    this.#view.y = clamped(this.#view.y, height, clientHeight);
    this.#paint();
    this.#draw();
  }

  #fitting() {
    const [width, height] = this.#size;
    const { clientWidth, clientHeight } = this.#canvas;
    return Math.min(LARGEST, clientWidth / Math.max(1, width), clientHeight / Math.max(1, height));
  }

  #resized() {
    const { clientWidth, clientHeight } = this.#canvas;
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [clientWidth, clientHeight].map((side) => Math.round(side * ratio));
    if (this.#canvas.width === width && this.#canvas.height === height) return;
    [this.#canvas.width, this.#canvas.height] = [width, height];
    if (this.#isFitted) this.fit();
    else this.zoom(1);
  }

  /** Asks for the squares that are seen. */
  async #fetch() {
    const [width, height] = this.#size;
    if (!width || !height || !this.#canvas.clientWidth) return;
    const { x, y, zoom } = this.#view;
    const ratio = window.devicePixelRatio || 1;
    const block = Math.max(1, Math.ceil(1 / (zoom * ratio) - 1e-9));
    const part = (at, pixels, cells) => {
      const half = pixels / zoom / 2;
      const from = Math.max(0, Math.floor((at - half) / block) * block);
      return [from, Math.min(cells, Math.ceil((at + half) / block) * block)];
    };
    const columns = part(x, this.#canvas.clientWidth, width);
    const rows = part(y, this.#canvas.clientHeight, height);
    const bytes = await this.#client.ask({ ask: "squares", of: this.#of, columns, rows, block });
    const across = Math.ceil((columns[1] - columns[0]) / block);
    const down = Math.ceil((rows[1] - rows[0]) / block);
    // Another grid may be shown by now.
    if (bytes.length !== 4 * across * down || this.#size[0] !== width) return;
    const picture = make("canvas", { width: across, height: down });
    picture.getContext("2d").putImageData(new ImageData(new Uint8ClampedArray(bytes.buffer), across, down), 0, 0);
    this.#picture = { picture, left: columns[0], bottom: rows[0], block, across, down };
    this.#paint();
  }

  /** Returns the pixel of the canvas of a place in cells. */
  #at(x, y) {
    const { width, height, clientWidth } = this.#canvas;
    const scale = this.#view.zoom * (width / clientWidth);
    return [width / 2 + (x - this.#view.x) * scale, height / 2 - (y - this.#view.y) * scale, scale];
  }

  #paint() {
    // Where all is shown there is nothing to move: a finger scrolls the page.
    this.#canvas.classList.toggle("whole", this.#isFitted);
    const context = this.#canvas.getContext("2d");
    context.clearRect(0, 0, this.#canvas.width, this.#canvas.height);
    if (this.#picture) {
      const { picture, left, bottom, block, across, down } = this.#picture;
      const [x, y, scale] = this.#at(left, bottom + down * block);
      context.imageSmoothingEnabled = false;
      context.drawImage(picture, x, y, across * block * scale, down * block * scale);
    }
    for (const [column, row] of this.#noted.cells) this.#ring(context, column + 0.5, row + 0.5);
    if (this.#noted.square) this.#frame(context, this.#noted.square, 3);
    for (const place of [this.#mark, this.#hover]) if (place) this.#frame(context, [...place, 1, 1], 1.5);
  }

  /** Draws black within white, which is seen on every colour: a frame around a rectangle of cells. */
  #frame(context, [column, row, width, height], line) {
    const [x, y, scale] = this.#at(column, row + height);
    const [across, up] = [width, height].map((cells) => Math.max(cells * scale, 6));
    context.lineWidth = line;
    for (const [colour, out] of [["#000", 2 * line], ["#fff", line]]) {
      context.strokeStyle = colour;
      context.strokeRect(x - out, y - out, across + 2 * out, up + 2 * out);
    }
  }

  #ring(context, x, y) {
    const [left, up, scale] = this.#at(x, y);
    for (const [colour, line] of [["#000", 4], ["#fff", 2]]) {
      [context.strokeStyle, context.lineWidth] = [colour, line];
      context.beginPath();
      context.arc(left, up, scale / 2 + 6, 0, 2 * Math.PI);
      context.stroke();
    }
  }

  /** Returns the picture as it is seen. */
  picture() {
    return this.#canvas;
  }

  async #tell(column, row) {
    const cell = await this.#client.json({ ask: "cell", of: this.#of, column, row });
    this.#told(cell, column, row);
  }

  /** Returns the place in cells under an event of the pointer. */
  #place({ clientX, clientY }) {
    const { left, top, width, height } = this.#canvas.getBoundingClientRect();
    const { x, y, zoom } = this.#view;
    return [x + (clientX - left - width / 2) / zoom, y - (clientY - top - height / 2) / zoom];
  }

  /** Returns the cell under an event of the pointer; `null` beside the grid. */
  #under(event) {
    const [column, row] = this.#place(event).map(Math.floor);
    const [width, height] = this.#size;
    return column < 0 || row < 0 || column >= width || row >= height ? null : [column, row];
  }

  /** Looks at the cell under the pointer, or at the marked one where the pointer is elsewhere. */
  #point(cell) {
    this.#hover = cell;
    this.#paint();
    const seen = cell ?? this.#mark;
    if (seen) this.#look(...seen);
  }

  #choose(cell) {
    this.#mark = cell;
    this.#point(null);
  }

  #listen() {
    const canvas = this.#canvas;
    const held = new Map();
    const where = ({ clientX, clientY }) => `${clientX} ${clientY}`;
    let [pressed, last] = [null, null];
    window.addEventListener("pointermove", (event) => (last = where(event)));
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      held.set(event.pointerId, event);
      // Two fingers zoom: where they part no cell is chosen.
      pressed = held.size === 1 ? event : null;
    });
    canvas.addEventListener("pointermove", (event) => {
      if (!this.#size[0]) return;
      // Where the page scrolls under a pointer that rests, the cell that was gone to stays looked at.
      if (where(event) === last) return;
      const before = held.get(event.pointerId);
      if (!before) return this.#point(this.#under(event));
      if (held.size === 2) {
        const other = [...held.values()].find(({ pointerId }) => pointerId !== event.pointerId);
        const apart = (a, b) => Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
        this.zoom(apart(event, other) / Math.max(1, apart(before, other)), this.#place(event));
      } else {
        this.#view.x -= (event.clientX - before.clientX) / this.#view.zoom;
        this.#view.y += (event.clientY - before.clientY) / this.#view.zoom;
        this.#moved();
      }
      held.set(event.pointerId, event);
    });
    for (const end of ["pointerup", "pointercancel"]) {
      canvas.addEventListener(end, (event) => {
        held.delete(event.pointerId);
        const moved = Math.hypot(event.clientX - pressed?.clientX, event.clientY - pressed?.clientY);
        const cell = this.#under(event);
        if (end === "pointerup" && this.#size[0] && moved < 5 && cell) this.#choose(cell);
        if (!held.size) pressed = null;
      });
    }
    canvas.addEventListener("pointerleave", () => this.#size[0] && this.#point(null));
    canvas.addEventListener("wheel", (event) => {
      if (!this.#size[0] || !(event.ctrlKey || document.activeElement === canvas)) return;
      const before = this.#view.zoom;
      this.zoom(2 ** (-event.deltaY / 240), this.#place(event));
      // Where there is nothing more to zoom the page scrolls; with Ctrl it would itself be enlarged.
      if (event.ctrlKey || this.#view.zoom !== before) event.preventDefault();
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => this.#key(event));
  }

  #key(event) {
    const [width, height] = this.#size;
    if (!width) return;
    const step = event.shiftKey ? 10 : 1;
    const moves = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] };
    const zooms = { "+": 2, "=": 2, "-": 0.5, _: 0.5 };
    if (event.key in moves) {
      const [column, row] = this.#mark ?? [this.#view.x, this.#view.y].map(Math.floor);
      const within = (at, cells) => Math.min(cells - 1, Math.max(0, at));
      const [across, up] = moves[event.key];
      const place = [within(column + across, width), within(row + up, height)];
      this.#follow(place);
      this.#choose(place);
    } else if (event.key in zooms) {
      this.zoomIn(zooms[event.key]);
    } else if (event.key in this.#keys && !event.ctrlKey && !event.metaKey && !event.altKey) {
      this.#keys[event.key]();
    } else if (event.key === "0") {
      this.fit();
    } else {
      return;
    }
    event.preventDefault();
  }

  /** Moves the view so that a cell is in it. */
  #follow([column, row]) {
    const half = [this.#canvas.clientWidth, this.#canvas.clientHeight].map((side) => side / this.#view.zoom / 2);
    const into = (at, middle, reach) => Math.min(at + reach - 1, Math.max(at - reach + 2, middle));
    this.#view.x = into(column, this.#view.x, half[0]);
    this.#view.y = into(row, this.#view.y, half[1]);
    this.#moved();
  }
}

/** Returns what a cell holds, in a line. */
export const inWords = ({ p, entropy, information, unknown }) =>
  `p ${p}, H ${entropy}, I ${information} bits${unknown ? " (unknown)" : ""}`;
