// Prints what the page's JSON of these maps is: node bindings/web/measure.mjs [--submaps] FILE...  With `--rows csv`, its CSV.
// A map stands for itself and the files beside it; the name in the result is without its folder.
import { closeSync, openSync, readFileSync, readSync, readdirSync, statSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { load } from "./page/module.mjs";

const built = join(process.env.CARGO_TARGET_DIR ?? fileURLToPath(new URL("../../target", import.meta.url)), "web/meaninfo.wasm");
let open = [];
const ask = await load(readFileSync(process.env.MEANINFO_WASM ?? built), (file, at, length) => {
  const piece = Buffer.alloc(length);
  return piece.subarray(0, readSync(open[file], piece, 0, length, at));
});

const paths = process.argv.slice(2);
const reading = {};
let format = "json";
while (paths[0]?.startsWith("--")) {
  const option = paths.shift();
  if (option === "--submaps") reading.submaps = true;
  else if (option === "--rows") format = paths.shift();
  else reading[option.slice(2)] = paths.shift();
}
let status = 0;
for (const path of paths) {
  const folder = dirname(path);
  const beside = readdirSync(folder).filter((name) => statSync(join(folder, name)).isFile());
  open = beside.map((name) => openSync(join(folder, name)));
  const files = beside.map((name) => ({ name, length: statSync(join(folder, name)).size }));
  try {
    ask({ ask: "files", files });
    ask({ ask: "measure", name: basename(path), reading });
  } catch (error) {
    process.stderr.write(`meaninfo: ${error.message}\n`);
    status = 2;
  }
  open.forEach(closeSync);
}
process.stdout.write(ask({ ask: "rows", format }));
process.exitCode = status;
