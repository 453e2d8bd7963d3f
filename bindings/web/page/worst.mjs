// The worst of a map: the observed cells with the largest entropy, and the square that has the most, listed, marked and gone to.
import { counted, element, grouped, make, rounded } from "./parts.mjs";

export class Worst {
  #client;
  #heatMap;
  #place;
  #middle;
  #square = null;
  #cells = [];
  /** How many cells have the largest entropy, of which some may not be listed. */
  #equal = 0;
  /** The place in the list of the cell that was gone to last. */
  #last = -1;

  /** `place([column, row, width, height])` tells where cells lie, in words, `middle` in two numbers. */
  constructor(client, heatMap, place, middle) {
    [this.#client, this.#heatMap, this.#place, this.#middle] = [client, heatMap, place, middle];
    element("worst-region").addEventListener("click", () => this.toRegion());
    element("worst-cell").addEventListener("click", () => this.toNext());
  }

  get side() {
    return Number(element("worst-side").value);
  }

  hide() {
    [this.#square, this.#cells, this.#last] = [null, [], -1];
    element("worst").hidden = true;
    for (const id of ["worst-region", "worst-cell"]) element(id).disabled = true;
  }

  /** Finds the worst of the open map. */
  async find() {
    const { cells, equal, square } = await this.#client.json({ ask: "worst", side: this.side });
    this.hide();
    [this.#cells, this.#square, this.#equal] = [cells, square ?? null, equal];
    element("worst").hidden = false;
    element("worst-region").disabled = !square;
    element("worst-cell").disabled = !cells.length;
    element("save-worst").disabled = !cells.length;
    element("worst-none").hidden = cells.length > 0;
    element("worst-table").hidden = !cells.length;
    const listed = equal > cells.length ? `The first ${cells.length} of ${counted(equal, "cell")} with the largest entropy` : counted(cells.length, "worst cell");
    element("worst-caption").textContent = `${listed}, numbers to six digits.`;
    const rows = cells.map((cell, k) => make("tr", {},
      make("th", { scope: "row" }, make("button", { type: "button", onclick: () => this.#toCell(k) }, this.#place(this.#of(cell)))),
      ...["p", "entropy", "information"].map((name, at) =>
        make("td", { class: "number", "data-label": ["p", "H (bits)", "I (bits)"][at] }, rounded(cell[name])))));
    element("worst-square").hidden = !square;
    element("worst-square").textContent = square ? `Worst region: ${this.#regionInWords()}.` : "";
    element("worst-rows").replaceChildren(...rows);
    this.#heatMap.note(cells.map(({ column, row }) => [column, row]), square && this.#of(square));
  }

  #of({ column, row, width = 1, height = 1 }) {
    return [column, row, width, height];
  }

  #regionInWords() {
    const { width, height, observed, entropy, mean_information: mean } = this.#square;
    return `${width} × ${height} cells about ${this.#place(this.#of(this.#square))}: ${counted(observed, "observed cell")}, ` +
      `sum of H ${rounded(entropy)} bits, mean information ${rounded(mean)} bits per observed cell`;
  }

  /** Returns the place of a cell in the list, in words behind others; nothing where it is not listed. */
  rank(column, row) {
    const at = this.#cells.findIndex((cell) => cell.column === column && cell.row === row) + 1;
    const more = this.#equal > this.#cells.length ? ` listed, of ${grouped(this.#equal)} that are equal` : "";
    return at ? `; worst cell ${at} of ${this.#cells.length}${more}` : "";
  }

  /** Returns the region and the listed cells as CSV, with the digits of their floats; their middles are in this unit. */
  csv(unit) {
    const lines = [...(this.#square ? [["region", this.#square]] : []), ...this.#cells.map((cell) => ["cell", cell])].map(([what, of]) => {
      const [column, row, width, height] = this.#of(of);
      const isCell = what === "cell";
      const numbers = isCell ? [of.p, of.entropy, of.information, 1] : ["", of.entropy, of.mean_information, of.observed];
      return [what, column, row, width, height, ...this.#middle([column, row, width, height]), ...numbers].join(",");
    });
    return [`what,column,row,width,height,x_${unit},y_${unit},p,entropy_bits,information_per_cell,observed`, ...lines, ""].join("\n");
  }

  /** Goes to the worst region. */
  toRegion() {
    if (!this.#square) return;
    this.#heatMap.goTo(this.#of(this.#square));
    element("cell-told").textContent = `Worst region: ${this.#regionInWords()}.`;
    this.#seen();
  }

  /** Goes to the next cell of the list, after the last to the first. */
  toNext() {
    if (this.#cells.length) this.#toCell((this.#last + 1) % this.#cells.length);
  }

  #toCell(k) {
    this.#last = k;
    this.#heatMap.goTo(this.#of(this.#cells[k]));
    this.#seen();
  }

  /** Brings the map to where it is seen; the focus stays, for the next. */
  #seen() {
    element("cell-told").scrollIntoView({ block: "nearest" });
    element("heat-map").scrollIntoView({ block: "nearest" });
  }
}
