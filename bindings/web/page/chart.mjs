// Curves in a frame with ticks, as SVG in the colours of the page.
import { short, svg } from "./parts.mjs";

const [WIDTH, HEIGHT] = [640, 320];
const FRAME = { left: 76, right: 34, top: 18, bottom: 56 };

/** Returns round numbers within a range, at most about `most`. */
function ticks(from, to, most) {
  const raw = (to - from) / most;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw * (1 - 1e-9));
  const first = Math.ceil(from / step - 1e-9);
  const count = Math.floor((to / step - first) + 1e-9);
  return Array.from({ length: count + 1 }, (_, k) => (first + k) * step);
}

/**
 * Draws `curves` (`{ name, points: [[x, y]], kind }`) over an x axis that is linear or doubles from tick to tick. `lines` are
 * dashed levels, `{ name, y, kind }`.
 */
export function chart({ title, xLabel, yLabel, curves, lines = [], y: [low, high], doubles = false, marks = false }) {
  const xs = curves.flatMap(({ points }) => points.map(([x]) => x));
  const scaled = doubles ? Math.log2 : (x) => x;
  let [first, last] = [Math.min(...xs.map(scaled)), Math.max(...xs.map(scaled))];
  if (first === last) [first, last] = [first - 1, last + 1];
  const across = (x) => FRAME.left + ((scaled(x) - first) / (last - first)) * (WIDTH - FRAME.left - FRAME.right);
  const up = (y) => HEIGHT - FRAME.bottom - ((y - low) / (high - low)) * (HEIGHT - FRAME.top - FRAME.bottom);
  const drawn = svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", "aria-label": title, class: "chart" });
  const text = (x, y, content, attributes = {}) => drawn.append(svg("text", { x, y, ...attributes }, content));
  const line = (x1, y1, x2, y2, kind) => drawn.append(svg("line", { x1, y1, x2, y2, class: kind }));

  for (const y of ticks(low, high, 5)) {
    line(FRAME.left, up(y), WIDTH - FRAME.right, up(y), "grid");
    text(FRAME.left - 8, up(y) + 4, short(y), { "text-anchor": "end" });
  }
  const every = Math.max(1, Math.ceil(new Set(xs).size / 8));
  const marked = doubles ? [...new Set(xs)].filter((_, k) => k % every === 0) : ticks(first, last, 8);
  for (const x of marked) {
    line(across(x), HEIGHT - FRAME.bottom, across(x), HEIGHT - FRAME.bottom + 5, "axis");
    text(across(x), HEIGHT - FRAME.bottom + 22, short(x), { "text-anchor": "middle" });
  }
  line(FRAME.left, HEIGHT - FRAME.bottom, WIDTH - FRAME.right, HEIGHT - FRAME.bottom, "axis");
  text((FRAME.left + WIDTH - FRAME.right) / 2, HEIGHT - 10, xLabel, { "text-anchor": "middle" });
  const middle = (FRAME.top + HEIGHT - FRAME.bottom) / 2;
  text(18, middle, yLabel, { "text-anchor": "middle", transform: `rotate(-90 18 ${middle})` });
  for (const { y, kind } of lines) {
    line(FRAME.left, up(y), WIDTH - FRAME.right, up(y), `level ${kind}`);
  }
  for (const { points, kind } of curves) {
    const path = points.map(([x, y]) => `${across(x).toFixed(2)},${up(y).toFixed(2)}`);
    drawn.append(svg("polyline", { points: path.join(" "), class: `curve ${kind}` }));
    if (marks) drawn.append(...points.map(([x, y]) => svg("circle", { cx: across(x), cy: up(y), r: 4, class: `mark ${kind}` })));
  }
  return drawn;
}

/** Returns the key to curves and levels, as a list. */
export function key(entries) {
  const list = document.createElement("ul");
  list.className = "key";
  for (const { name, kind, dashed } of entries) {
    const item = document.createElement("li");
    const sample = svg("svg", { viewBox: "0 0 28 10", "aria-hidden": "true", width: 28, height: 10 },
      svg("line", { x1: 1, y1: 5, x2: 27, y2: 5, class: `${dashed ? "level" : "curve"} ${kind}` }));
    item.append(sample, ` ${name}`);
    list.append(item);
  }
  return list;
}
