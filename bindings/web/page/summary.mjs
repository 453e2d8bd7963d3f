// What was measured of one map, in numbers and words.
import { element, grouped, make, rounded } from "./parts.mjs";
import { onPage } from "./words.mjs";

/** Shows the row of a map under a title; `image` tells of the file that its description names, if there is one. */
export function showSummary(row, title, image) {
  element("summary").hidden = false;
  element("chosen").textContent = title;
  element("number").textContent = row.mean_information === null ? "none" : String(row.mean_information);
  element("unit").hidden = row.mean_information === null;
  element("unit").textContent = `${row.mean_information === 1 ? "bit" : "bits"} per observed cell`;
  // The reason is the last of the warnings.
  element("meaningless").textContent = row.meaningful ? "" : `Not meaningful: ${onPage(row.warnings.at(-1) ?? "see the warnings")}.`;
  element("read").textContent = reading(row);
  const facts = [
    ["cells", sizeOf(row)],
    ["resolution", row.resolution_m === null ? "not given" : `${row.resolution_m} m`],
    ["observed", `${grouped(row.observed)} cells${row.observed_area_m2 === null ? "" : `, ${rounded(row.observed_area_m2)} m²`}`],
    ["free, occupied", `${grouped(row.free)}, ${grouped(row.occupied)}`],
    ["unknown", row.unknown === null ? "all around the leaves" : grouped(row.unknown)],
    ["information", `${row.information_bits} bits`],
    ["entropy", `${row.entropy_bits} bits, unknown cells at 1 each`],
    ["exact value", row.mean_information_hex ?? "none"],
    ...(image ? [["image", image]] : []),
  ];
  element("facts").replaceChildren(...facts.map(([name, value]) => make("div", {}, make("dt", {}, name), make("dd", {}, value))));
  element("warnings").replaceChildren(...row.warnings.map((warning) => make("li", {}, onPage(warning))));
  element("warned").hidden = !row.warnings.length;
}

/** Returns a map's size in words. */
export function sizeOf(row) {
  if (row.leaves !== undefined && row.leaves !== null) return `${grouped(row.leaves)} leaves`;
  return row.width === null ? "submaps" : `${row.width} × ${row.height}`;
}

/** Returns how to read a mean information. */
function reading(row) {
  if (row.mean_information === null) return "Nothing is observed, so there is no mean information.";
  return "From 0, which says nothing of the cells that were seen, to 1, which leaves no doubt. Unknown cells do not count.";
}
