// Puts the page together, one file that needs no other: node bindings/web/page.mjs FILE.wasm FILE.html
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import { gzipSync } from "node:zlib";
import { load } from "./page/module.mjs";
import { DIGITS } from "./page/unzipped.mjs";

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

/** Packs bytes for `unzipped`. */
const packed = (bytes) => {
  const zipped = gzipSync(bytes, { level: 9 });
  const left = -zipped.length & 3;
  const words = Buffer.concat([zipped, Buffer.alloc(left)]);
  let text = String(left);
  for (let at = 0; at < words.length; at += 4) {
    let word = words.readUInt32BE(at);
    const digits = Array.from({ length: 5 }, () => {
      const digit = DIGITS[word % 85];
      word = Math.floor(word / 85);
      return digit;
    });
    text += digits.reverse().join("");
  }
  return text;
};

const main = joined(["parts", "unzipped", "client", "chart", "picture", "heatmap", "maps", "room", "cell", "main"]);
const worker = joined(["module", "unzipped", "worker"]);
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
