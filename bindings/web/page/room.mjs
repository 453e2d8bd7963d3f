// The second view: the circular room, with sliders for what the report's Figs. 3 to 5 show.
import { chart, key } from "./chart.mjs";
import { HeatMap, inWords } from "./heatmap.mjs";
import { element, grouped, latest, make } from "./parts.mjs";

const SLIDERS = ["range", "sigma", "side"];

export class Room {
  #client;
  #heatMap;
  #draw = latest(() => this.#compute());
  /** What the numbers that are shown are of, once there are some. */
  #shown = "";
  #isComputing = false;

  constructor(client) {
    this.#client = client;
    this.#heatMap = new HeatMap(element("disc"), client, "room", (cell, column, row) => {
      element("disc-told").textContent = `Column ${column}, row ${row}: ${inWords(cell)}`;
    });
    for (const name of SLIDERS) {
      const [slider, number] = [element(`${name}-slider`), element(`${name}-number`)];
      slider.addEventListener("input", () => {
        number.value = slider.value;
        this.#changed();
      });
      number.addEventListener("input", () => {
        // A slider takes what is no number for its middle.
        if (Number(number.value) > 0) slider.value = number.value;
        this.#changed();
      });
    }
    for (const [id, by] of [["disc-in", 2], ["disc-out", 0.5]]) {
      element(id).addEventListener("click", () => this.#heatMap.zoomIn(by));
    }
    element("disc-fit").addEventListener("click", () => this.#heatMap.fit());
  }

  /** Draws the room; to be called when the view is shown. */
  show() {
    this.#changed();
  }

  /** Computes anew; until then what is shown is that of other values. */
  #changed() {
    this.#isComputing = true;
    this.#say();
    this.#draw();
  }

  /** Says what is shown, and whether it is of what the fields say. */
  #say() {
    const refused = element("room-error").textContent !== "";
    const isStale = this.#isComputing || refused;
    const result = element("room-result");
    result.setAttribute("aria-busy", String(this.#isComputing));
    result.toggleAttribute("data-stale", isStale);
    const computing = this.#isComputing ? "Computing" : "";
    const shown = this.#shown && (isStale ? `${computing ? "b" : "B"}elow is still ${this.#shown}` : `For ${this.#shown}`);
    const words = [computing, shown].filter((part) => part).join("; ");
    element("room-shown").textContent = words && `${words}.`;
  }

  async #compute() {
    const fields = SLIDERS.map((name) => element(`${name}-number`));
    const asked = fields.map(({ value }) => value);
    const [range, sigma, resolution] = asked;
    const isNewest = () => fields.every(({ value }, k) => value === asked[k]);
    let refused = null;
    try {
      const room = await this.#client.json({ ask: "room", range, sigma, resolution });
      this.#tell(room);
      this.#shown = `z ${room.range_m} m, σ ${room.sigma_m} m, cells of ${Number(resolution) || resolution} m`;
    } catch (error) {
      refused = error;
    }
    // What the numbers below are of is said in any case.
    if (isNewest()) {
      this.#isComputing = false;
      element("room-error").textContent = refused?.message ?? "";
      for (const [k, field] of fields.entries()) {
        if (refused?.field === SLIDERS[k]) field.setAttribute("aria-invalid", "true");
        else field.removeAttribute("aria-invalid");
      }
    }
    this.#say();
  }

  #tell(room) {
    const rows = [
      ["polar: rings of equal width (Eq. 7)", room.limit_polar, room.polar, room.polar_observed],
      ["Cartesian: squares", room.limit_cartesian, room.cartesian, room.cartesian_observed],
    ];
    element("limits").replaceChildren(...rows.map(([name, limit, grid, observed]) => make("tr", {},
      make("th", { scope: "row" }, name),
      make("td", { class: "number", "data-label": "limit" }, String(limit)),
      make("td", { class: "number", "data-label": "this grid" }, String(grid)),
      make("td", { class: "number", "data-label": "observed cells" }, grouped(observed)))));
    const curve = (values) => room.distances_m.map((rho, k) => [rho, values[k]]);
    element("sensor").replaceChildren(chart({
      title: `The sensor model: occupancy and information against distance, for a reading of ${room.range_m} m`,
      xLabel: "distance ρ from the sensor (m)", yLabel: "p, and bits", y: [0, 1],
      curves: [
        { points: curve(room.occupancy), kind: "first" },
        { points: curve(room.information), kind: "second" },
      ],
    }), key([{ name: "occupancy p(ρ)", kind: "first" }, { name: "information I(p(ρ)), bits", kind: "second" }]));
    this.#heatMap.show(room.width, room.height);
  }
}
