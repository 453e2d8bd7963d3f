// The module as a port of the protocol that `meaninfo check` speaks: meaninfo check -- node bindings/web/port.mjs [FILE.wasm]
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";
import { load } from "./page/module.mjs";

const built = join(process.env.CARGO_TARGET_DIR ?? fileURLToPath(new URL("../../target", import.meta.url)), "web/meaninfo.wasm");
const ask = await load(readFileSync(process.argv[2] ?? built), () => {
  throw new Error("a port reads no files");
});
const text = new TextDecoder();

for await (const line of createInterface({ input: process.stdin, crlfDelay: Infinity })) {
  const answer = text.decode(ask({ ask: "port", line }));
  // No answer: the line said stop.
  if (answer === "") break;
  process.stdout.write(answer + "\n");
}
process.exit(0);
