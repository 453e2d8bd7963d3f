// The third view: one cell, typed in as decimal or hexadecimal float.
import { element, latest, make } from "./parts.mjs";

/** Where sign and exponent of a float end. */
const PARTS = { f32: [1, 9], f64: [1, 12] };

export class OneCell {
  #client;
  #draw = latest(() => this.#compute());

  constructor(client) {
    this.#client = client;
    element("p").addEventListener("input", () => this.#draw());
    element("one-cell").addEventListener("submit", (event) => event.preventDefault());
  }

  show() {
    this.#draw();
  }

  async #compute() {
    const field = element("p");
    try {
      const cell = await this.#client.json({ ask: "occupancy", p: field.value });
      element("p-error").textContent = "";
      field.removeAttribute("aria-invalid");
      element("one-rows").replaceChildren(...Object.entries(cell).map(([format, row]) => this.#row(format, row)));
    } catch (error) {
      element("p-error").textContent = error.message;
      field.setAttribute("aria-invalid", "true");
      element("one-rows").replaceChildren();
    }
  }

  #row(format, row) {
    const [sign, exponent] = PARTS[format];
    const bits = [row.bits.slice(0, sign), row.bits.slice(sign, exponent), row.bits.slice(exponent)];
    const number = (label, name) => make("td", { "data-label": label },
      make("span", {}, String(row[name])), make("br"), make("code", {}, row[`${name}_hex`]));
    return make("tr", {},
      make("th", { scope: "row" }, format),
      number("p", "p"), number("H (bits)", "entropy"), number("I (bits)", "information"),
      make("td", { "data-label": "sign, exponent, fraction" }, ...bits.map((part) => make("code", { class: "part" }, part))));
  }
}
