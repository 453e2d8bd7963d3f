// What the page holds packed comes out as it was, by either way of packing.
import assert from "node:assert/strict";
import { createHash, randomBytes } from "node:crypto";
import { readFileSync } from "node:fs";
import { inDigits, inGzip, inLzma } from "../packed.mjs";
import { unzipped } from "../page/unzipped.mjs";
import { numbers, test } from "./harness.mjs";

/** Runs, repeats near and far, and what cannot be packed. */
function mixed() {
  const random = numbers(3);
  const below = (n) => Math.floor(random.next().value * n);
  const bytes = [];
  while (bytes.length < 300_000) {
    const [from, length] = [below(bytes.length), below(1 << below(11))];
    const kind = below(4);
    for (let k = 0; k < length; k++) bytes.push([below(256), 7, bytes[from + k] ?? 0, (bytes.at(-4) ?? 1) + 1][kind] & 255);
  }
  return Buffer.from(bytes);
}

await test("what the page holds packed comes out as it was", async () => {
  const here = (path) => readFileSync(new URL(path, import.meta.url));
  for (const bytes of [Buffer.alloc(0), Buffer.from("a"), Buffer.alloc(70_000, 5), randomBytes(9999), mixed(), here("../THIRD_PARTY.txt")]) {
    for (const pack of [inLzma, inGzip]) {
      const zipped = pack(bytes);
      if (!zipped) {
        console.log("skipped: LZMA: no xz");
        continue;
      }
      const back = Buffer.from(await (await unzipped(inDigits(zipped))).arrayBuffer());
      const sum = (bytes) => createHash("sha256").update(bytes).digest("hex");
      assert.equal(sum(back), sum(bytes), `${bytes.length} bytes by ${pack.name}`);
    }
  }
});
