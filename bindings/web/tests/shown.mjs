// What is shown: numbers without digits that say nothing, nothing stale, nothing cut off, nothing out of sight.
import assert from "node:assert/strict";
import { accessible, drop, idle, npy, saved, test } from "./harness.mjs";

await test("the room says what its numbers are of, while others are computed and after bad input", async (tab) => {
  await tab.click("#room-tab");
  await tab.waitForFunction(() => document.getElementById("room-shown").textContent === "For z 2 m, σ 0.2 m, cells of 0.05 m.");
  const state = () => tab.evaluate(() => [document.getElementById("room-result").getAttribute("aria-busy"), document.getElementById("room-shown").textContent]);
  assert.equal((await state())[0], "false");
  const changed = (value) => tab.evaluate((value) => {
    const field = document.getElementById("range-number");
    field.value = value;
    field.dispatchEvent(new Event("input", { bubbles: true }));
    return [document.getElementById("room-result").getAttribute("aria-busy"), document.getElementById("room-shown").textContent];
  }, value);
  assert.deepEqual(await changed("3"), ["true", "Computing; below is still z 2 m, σ 0.2 m, cells of 0.05 m."]);
  await tab.waitForFunction(() => document.getElementById("room-shown").textContent.startsWith("For z 3 m"));
  const slider = await tab.inputValue("#range-slider");
  await changed("abc");
  await tab.locator("#room-error:not(:empty)").waitFor();
  assert.equal(await tab.textContent("#room-error"), 'range: "abc" is not a number');
  assert.equal(await tab.inputValue("#range-slider"), slider);
  assert.equal(await tab.getAttribute("#range-number", "aria-invalid"), "true");
  assert.deepEqual(await state(), ["true", "Below is still z 3 m, σ 0.2 m, cells of 0.05 m."]);
  await accessible(tab);
  await changed("2");
  await tab.waitForFunction(() => document.getElementById("room-shown").textContent.startsWith("For z 2 m"));
  assert.equal(await tab.getAttribute("#range-number", "aria-invalid"), null);
});

await test("an area has no more digits than it means", async (tab) => {
  await idle(tab);
  await tab.click("summary");
  await tab.fill("#reading input[name=resolution]", "0.05");
  await tab.press("#reading input[name=resolution]", "Tab");
  await drop(tab, [npy("area.npy", 3, 397, new Array(1191).fill(0.125))]);
  await tab.waitForFunction(() => document.getElementById("chosen").textContent === "area.npy");
  assert.match(await tab.textContent("#facts"), /cells, 2\.9775 m²/);
});

await test("the saved picture holds its scale whole", async (tab) => {
  await idle(tab);
  // A title that is shorter than the map is wide.
  await drop(tab, [npy("a.npy", 30, 60, new Array(1800).fill(0.125))]);
  await tab.waitForFunction(() => document.getElementById("chosen").textContent === "a.npy");
  await idle(tab);
  const png = await saved(tab, "#save-png");
  const dark = await tab.evaluate(async (bytes) => {
    const image = await createImageBitmap(new Blob([new Uint8Array(bytes)], { type: "image/png" }));
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [image.width, image.height];
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const { data, width } = context.getImageData(image.width - 100, 70, 100, 220);
    return Array.from({ length: width }, (_, x) => data.filter((byte, at) => at % 4 === 0 && (at / 4) % width === x && byte < 128).length);
  }, [...png]);
  assert.ok(dark.some((pixels) => pixels > 0), "no letters of the scale");
  assert.deepEqual(dark.slice(-12), new Array(12).fill(0));
});

for (const viewport of [{ width: 390, height: 844 }, { width: 1200, height: 700 }]) {
  await test(`what a cell holds is in sight where the map has the focus, at ${viewport.width} px`, async (tab) => {
    await idle(tab);
    await tab.focus("#zoom-in");
    for (let k = 0; k < 9 && (await tab.evaluate(() => document.activeElement.id)) !== "heat-map"; k++) await tab.keyboard.press("Tab");
    assert.equal(await tab.evaluate(() => document.activeElement.id), "heat-map");
    await tab.keyboard.press("ArrowRight");
    await tab.waitForFunction(() => document.getElementById("cell-told").textContent.startsWith("Column"));
    const box = await tab.locator("#cell-told").boundingBox();
    assert.ok(box.y >= 0 && box.y + box.height <= viewport.height, JSON.stringify(box));
  }, { viewport });
}

await test("the page says what it reads and what the command reads, and where p is rounded", async (tab) => {
  await idle(tab);
  const zone = await tab.textContent("#drop");
  for (const words of ["an image alone", "Not read here: bags", "meaninfo bag", "meaninfo trajectory"]) assert.ok(zone.includes(words), words);
  assert.ok(await tab.locator("#percent").isVisible());
  await drop(tab, [npy("floats.npy", 1, 1, [0.3])]);
  await tab.waitForFunction(() => document.getElementById("chosen").textContent === "floats.npy");
  await idle(tab);
  assert.equal(await tab.locator("#percent").isVisible(), false);
});
