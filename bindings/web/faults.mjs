// Plants faults in the module, and sees that the checks of the page find each: node bindings/web/faults.mjs MEANINFO
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = (path) => fileURLToPath(new URL(path, import.meta.url));
const built = join(process.env.CARGO_TARGET_DIR ?? here("../../target"), "web/meaninfo.wasm");
const meaninfo = resolve(process.argv[2]);
const folder = mkdtempSync(join(tmpdir(), "meaninfo-faults-"));
const port = (wasm) => spawnSync(meaninfo, ["check", "--", "node", here("port.mjs"), wasm], { encoding: "utf8" });
const equal = (wasm) =>
  spawnSync("node", [here("equal.mjs"), meaninfo, here("../../maps")], { encoding: "utf8", env: { ...process.env, MEANINFO_WASM: wasm } });

/** The bytes of the 40th number of the table of logarithms, little-endian. */
const logarithm = () => {
  const table = readFileSync(here("../../src/rounded/constants.rs"), "utf8").split("LOG_TABLE")[1];
  const number = BigInt([...table.matchAll(/\((\d+), (\d+)\)/g)][40][2]);
  return Buffer.from(number.toString(16).padStart(32, "0"), "hex").reverse();
};

const FAULTS = [
  ["a bit in the middle of a logarithm", logarithm(), (bytes, at) => (bytes[at + 10] ^= 1), port, /failed/],
  ["a letter of a key of JSON", Buffer.from("information_bits"), (bytes, at) => (bytes[at] ^= 1), equal, /the page:/],
];
for (const [name, what, plant, check, words] of FAULTS) {
  const bytes = readFileSync(built);
  let planted = 0;
  for (let at = bytes.indexOf(what); at >= 0; at = bytes.indexOf(what, at + 1), planted += 1) plant(bytes, at);
  assert.ok(planted > 0, `${name}: not found in ${built}`);
  const wasm = join(folder, "faulty.wasm");
  writeFileSync(wasm, bytes);
  const { status, stdout } = check(wasm);
  assert.ok(status === 1 && words.test(stdout), `${name} was not seen: status ${status}\n${stdout}`);
  console.log(`seen: ${name}`);
}
rmSync(folder, { recursive: true });
