// What is shown: numbers without digits that say nothing, nothing stale, nothing cut off, nothing out of sight.
import assert from "node:assert/strict";
import { join } from "node:path";
import { accessible, drop, idle, made, maps, npy, npyHead, saved, test } from "./harness.mjs";

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
  // Nothing computes, and what is shown is of other values.
  assert.deepEqual(await state(), ["false", "Below is still z 3 m, σ 0.2 m, cells of 0.05 m."]);
  assert.equal(await tab.getAttribute("#room-result", "data-stale"), "");
  await accessible(tab);
  await changed("2");
  await tab.waitForFunction(() => document.getElementById("room-shown").textContent.startsWith("For z 2 m"));
  assert.equal(await tab.getAttribute("#range-number", "aria-invalid"), null);
});

await test("the room's words are of the numbers below, also while a long computation follows a short one", async (tab) => {
  await tab.click("#room-tab");
  await tab.waitForFunction(() => document.getElementById("room-shown").textContent.startsWith("For z 2 m"));
  const seen = await tab.evaluate(async () => {
    const [field, limits, shown] = ["range-number", "limits", "room-shown"].map((id) => document.getElementById(id));
    const set = (value) => {
      field.value = value;
      field.dispatchEvent(new Event("input", { bubbles: true }));
    };
    const before = limits.textContent;
    set("10");
    set("30");
    while (limits.textContent === before) await new Promise((next) => setTimeout(next, 1));
    const first = shown.textContent;
    while (!shown.textContent.startsWith("For ")) await new Promise((next) => setTimeout(next, 5));
    return [first, shown.textContent];
  });
  assert.deepEqual(seen, ["Computing; below is still z 10 m, σ 0.2 m, cells of 0.05 m.", "For z 30 m, σ 0.2 m, cells of 0.05 m."]);
});

await test("the field that a refusal of the room names is marked, and no other", async (tab) => {
  await tab.click("#room-tab");
  await tab.waitForFunction(() => document.getElementById("room-shown").textContent.startsWith("For z 2 m"));
  const marked = () => tab.locator('#room-view [aria-invalid="true"]').evaluateAll((fields) => fields.map(({ id }) => id));
  for (const [id, value, good, words] of [
    ["range-number", "100", "2", /cells/], ["sigma-number", "-1", "0.2", /sigma/], ["side-number", "0,3", "0.05", /its mark is the point: 0\.3/],
  ]) {
    if (id === "range-number") await tab.fill("#side-number", "0.04");
    await tab.fill(`#${id}`, value);
    await tab.waitForFunction((source) => new RegExp(source).test(document.getElementById("room-error").textContent), words.source);
    // Too many cells are a matter of their size.
    assert.deepEqual(await marked(), [id === "range-number" ? "side-number" : id]);
    await tab.fill(`#${id}`, good);
    await tab.locator("#room-error:empty").waitFor({ state: "attached" });
    assert.deepEqual(await marked(), []);
  }
});

await test("one cell hints at the point", async (tab) => {
  await tab.click("#cell-tab");
  await tab.fill("#p", "0,3");
  await tab.locator("#p-error:not(:empty)").waitFor();
  assert.equal(await tab.textContent("#p-error"), '"0,3" is not a number; its mark is the point: 0.3');
});

await test("the sample is called one, and what is measured is named", async (tab) => {
  await idle(tab);
  assert.equal(await tab.textContent("#chosen"), "A sample, not yours: room.yaml");
  assert.equal(await tab.textContent("#status"), "");
  await drop(tab, ["room.yaml", "room.pgm"].map((name) => join(maps, name)));
  await tab.waitForFunction(() => document.getElementById("status").textContent === "measured: room.yaml");
  assert.equal(await tab.textContent("#chosen"), "room.yaml");
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
  // Percentages of an array are rounded by no reader of ROS maps.
  const head = npyHead(1, 3).replace("<f4", "|i1");
  await drop(tab, [made("percent.npy", Buffer.concat([Buffer.from(head, "latin1"), Buffer.from([10, 40, 255])]))]);
  await tab.waitForFunction(() => document.getElementById("chosen").textContent === "percent.npy");
  await idle(tab);
  assert.equal(await tab.locator("#percent").isVisible(), false);
});
