// Puts the page together, one file that needs no other: node bindings/web/page.mjs FILE.wasm FILE.html
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import { gzipSync } from "node:zlib";
import { load } from "./page/module.mjs";

const [wasmPath, out] = process.argv.slice(2);
const text = (path) => readFileSync(new URL(path, import.meta.url), "utf8");
const wasm = readFileSync(wasmPath);

/** The modules in one: they stand in the order of their dependencies, and their names differ. */
const joined = (names) =>
  names
    .map((name) => text(`page/${name}.mjs`))
    .join("\n")
    .replace(/^import .*\n/gm, "")
    .replace(/^export /gm, "");

const main = joined(["parts", "client", "chart", "picture", "heatmap", "maps", "room", "cell", "main"]);
const worker = joined(["module", "worker"]);
const sample = ["room.yaml", "room.pgm"].map((name) => ({
  name,
  base64: readFileSync(new URL(`../../maps/${name}`, import.meta.url)).toString("base64"),
}));

const ask = await load(wasm, () => { throw new Error("no files"); });
const colours = [...ask({ ask: "colours" })];
const colour = (k) => `rgb(${colours.slice(3 * k, 3 * k + 3).join(" ")})`;
const scale = Array.from({ length: 16 }, (_, k) => colour(17 * k)).join(", ");
const style = (text("../../crates/cli/src/output/page.css") + text("page/style.css"))
  .replace("VIRIDIS", scale)
  .replace("UNKNOWN", colour(256));

const hash = createHash("sha256").update(main).digest("base64");
const parts = {
  "SCRIPT-HASH": `sha256-${hash}`,
  STYLE: style,
  SAMPLE: JSON.stringify(sample),
  WORKER: worker,
  WASM: gzipSync(wasm, { level: 9 }).toString("base64"),
  MAIN: main,
};
for (const [name, part] of Object.entries(parts)) {
  if (/<\/script|<!--/i.test(part)) throw new Error(`${name} would end its element`);
}
const page = text("page/index.html").replace(/SCRIPT-HASH|\bSTYLE\b|\bSAMPLE\b|\bWORKER\b|\bWASM\b|\bMAIN\b/g, (name) => parts[name]);
if (page.length >= 1e6) throw new Error(`the page has ${page.length} bytes, more than a million`);
writeFileSync(out, page);
console.log(`${out}: ${page.length} bytes`);
