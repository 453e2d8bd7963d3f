// What the page holds packed comes out as it was, by either way of packing.
import assert from "node:assert/strict";
import { createHash, randomBytes } from "node:crypto";
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { inDigits, inGzip, inLzma } from "../packed.mjs";
import { DIGITS, checksum, unzipped } from "../page/unzipped.mjs";
import { idle, made, numbers, skip, source, test } from "./harness.mjs";

const packs = [inLzma, inGzip].filter((pack) => pack(Buffer.alloc(1)) || skip(`${pack.name}: no xz`));

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
    for (const pack of packs) {
      const zipped = pack(bytes);
      const back = Buffer.from(await (await unzipped(inDigits(zipped))).arrayBuffer());
      const sum = (bytes) => createHash("sha256").update(bytes).digest("hex");
      assert.equal(sum(back), sum(bytes), `${bytes.length} bytes by ${pack.name}`);
    }
  }
});

const DAMAGED = "this page is damaged; get it anew";

await test("a digit that is another, a cut text and none are refused", async () => {
  assert.equal(checksum("123456789"), "cbf43926");
  for (const pack of packs) {
    const text = inDigits(pack(Buffer.from("what the page holds, and holds again, and again".repeat(9))));
    for (let at = 0; at < text.length; at++) {
      const other = DIGITS[(DIGITS.indexOf(text[at]) + 1) % DIGITS.length];
      await assert.rejects(unzipped(text.slice(0, at) + other + text.slice(at + 1)).arrayBuffer(), { message: DAMAGED }, `digit ${at}`);
      await assert.rejects(unzipped(text.slice(0, at)).text(), { message: DAMAGED }, `${at} digits`);
    }
  }
});

/** Writes a page of which the text of an element is another. */
const changed = (name, id, change) => () => {
  const parts = source().split(new RegExp(`(?<=id="${id}">)([^<]*)`));
  return { page: pathToFileURL(made(name, parts[0] + change(parts[1]) + parts[2])).href };
};

for (const [name, change] of [
  ["digit", (text) => text.slice(0, 300_000) + (text[300_000] === "A" ? "B" : "A") + text.slice(300_001)],
  ["cut", (text) => text.slice(0, 400_001)],
  ["empty", () => ""],
]) {
  await test(`a page that is damaged says so: ${name}`, async (tab) => {
    await tab.locator("#errors p").first().waitFor();
    assert.deepEqual(await tab.locator("#errors p").allTextContents(), [DAMAGED]);
    await tab.click("#room-tab");
    await tab.locator("#room-error:not(:empty)").waitFor();
    assert.equal(await tab.textContent("#room-error"), DAMAGED);
  }, changed(`${name}.html`, "wasm", change));
}

await test("licences that are damaged say so", async (tab) => {
  await idle(tab);
  await tab.click("#licences summary");
  await tab.locator("#licences-text:not(:empty)").waitFor();
  assert.equal(await tab.textContent("#licences-text"), DAMAGED);
}, changed("licences.html", "third-party", (text) => text.slice(1)));

await test("a page without its end says that it has not started, and one that started does not", async (tab) => {
  await tab.locator("#unstarted").waitFor();
}, () => ({ page: pathToFileURL(made("half.html", source().slice(0, 500_000))).href }));
await test("a page that started", async (tab) => {
  await idle(tab);
  assert.equal(await tab.locator("#unstarted").count(), 0);
});
