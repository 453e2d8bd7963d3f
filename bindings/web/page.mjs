// Puts the page together, one file that needs no other: node bindings/web/page.mjs FILE.wasm FILE.html
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import { packed } from "./packed.mjs";
import { load } from "./page/module.mjs";

const [wasmPath, out] = process.argv.slice(2);
const text = (path) => readFileSync(new URL(path, import.meta.url), "utf8");
const wasm = readFileSync(wasmPath);

/**
 * The modules in one: they stand in the order of their dependencies, and their names differ. Comments and what stands before a
 * line are left out, as no text of theirs has several lines.
 */
const joined = (names) => {
  const lines = names.map((name) => text(`page/${name}.mjs`)).join("\n").split("\n");
  const open = lines.find((line) => line.split("`").length % 2 === 0 && !/^\s*(\/\/|\/?\*)/.test(line));
  if (open) throw new Error(`a text goes on in the next line: ${open}`);
  return lines
    .map((line) => line.trim().replace(/^export /, ""))
    .filter((line) => line && !/^(import .* from |\/\/|\/\*\*|\*)/.test(line))
    .join("\n");
};

const main = joined(["parts", "lzma", "unzipped", "client", "chart", "picture", "heatmap", "images", "words", "summary", "worst", "maps", "room", "cell", "main"]);
const worker = joined(["module", "lzma", "unzipped", "worker"]);
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
  WASM: packed(wasm),
  "THIRD-PARTY": packed(text("THIRD_PARTY.txt")),
  MAIN: main,
};
for (const [name, part] of Object.entries(parts)) {
  if (/<\/script|<!--/i.test(part)) throw new Error(`${name} would end its element`);
}
const page = text("page/index.html").replace(/SCRIPT-HASH|\bSTYLE\b|\bSAMPLE\b|\bWORKER\b|\bWASM\b|\bTHIRD-PARTY\b|\bMAIN\b/g, (name) => parts[name]);
if (page.length >= 1e6) throw new Error(`the page has ${page.length} bytes, more than a million`);
writeFileSync(out, page);
console.log(`${out}: ${page.length} bytes`);
