// The worst cells and the worst region: found, listed, marked and gone to, against a search through all cells here.
import assert from "node:assert/strict";
import { accessible, drop, idle, npy, numbers, pointedAt, saved, test } from "./harness.mjs";

const [WIDTH, HEIGHT, SIDE] = [200, 120, 16];
const entropy = (p) => (p === 0.5 || p === 0 || p === 1 ? 0 : -p * Math.log2(p) - (1 - p) * Math.log2(1 - p));

/** A map of which one part, away from all corners, is in doubt, and its worst as this file finds it. */
function doubtful() {
  const random = numbers(7);
  const inPart = (column, row) => Math.abs(column - 151) < 8 && Math.abs(row - 31) < 8;
  const p = new Float32Array(WIDTH * HEIGHT).map((_, k) => {
    const x = random.next().value;
    if (inPart(k % WIDTH, Math.floor(k / WIDTH))) return x < 0.05 ? 0.5 : 0.5 + (x - 0.5) / 4;
    return x < 0.3 ? 0.5 : x < 0.9 ? 0.02 * x : 0.97;
  });
  const cells = [...p.keys()].filter((k) => p[k] !== 0.5).sort((a, b) => Math.abs(p[a] - 0.5) - Math.abs(p[b] - 0.5)).slice(0, 10);
  let square = { sum: 0 };
  for (let row = 0; row + SIDE <= HEIGHT; row++) {
    for (let column = 0; column + SIDE <= WIDTH; column++) {
      let sum = 0;
      for (let k = 0; k < SIDE * SIDE; k++) sum += entropy(p[(row + Math.floor(k / SIDE)) * WIDTH + column + (k % SIDE)]);
      if (sum > square.sum) square = { sum, column, row };
    }
  }
  return { p, cells: cells.map((k) => ({ column: k % WIDTH, row: Math.floor(k / WIDTH), p: p[k] })), square };
}

const told = (tab, words) => tab.waitForFunction((words) => document.getElementById("cell-told").textContent.startsWith(words), words);

await test("the worst cells and the worst region are found and gone to", async (tab) => {
  await idle(tab);
  const { p, cells, square } = doubtful();
  await tab.click("summary");
  await tab.fill("#reading input[name=resolution]", "0.05");
  await tab.press("#reading input[name=resolution]", "Tab");
  await drop(tab, [npy("doubt.npy", HEIGHT, WIDTH, p)]);
  await tab.waitForFunction(() => document.getElementById("chosen").textContent === "doubt.npy");
  await idle(tab);
  const listed = await tab.locator("#worst-rows tr").evaluateAll((rows) => rows.map((row) => [...row.cells].map((cell) => cell.textContent)));
  const six = (x) => String(Number(x.toPrecision(6)));
  const at = (cells) => `x ${((cells.column + 0.5) * 0.05).toFixed(3)}, y ${((cells.row + 0.5) * 0.05).toFixed(3)} m`;
  assert.deepEqual(listed.map(([place, p]) => [place, p]), cells.map((cell) => [at(cell), six(cell.p)]));
  for (const [k, cell] of cells.entries()) assert.ok(Math.abs(Number(listed[k][2]) - entropy(cell.p)) < 1e-6, listed[k]);
  const words = await tab.textContent("#worst-square");
  assert.match(words, /^Worst region: 16 × 16 cells about x /);
  assert.ok(Math.abs(Number(/sum of H ([\d.]+)/.exec(words)[1]) - square.sum) < 1e-3, `${words}: ${square.sum}`);

  // By the button: the cell comes to the middle, marked and told.
  const column = ({ column, row }) => `Column ${column}, row ${row}, `;
  await tab.click("#worst-cell");
  await told(tab, column(cells[0]));
  await tab.click("#worst-cell");
  await told(tab, column(cells[1]));
  assert.deepEqual(await pointedAt(tab, "#heat-map", "#cell-told", [0.5, 0.5]), [cells[1].column, cells[1].row]);
  // By the keys, and from the list.
  await tab.focus("#heat-map");
  await tab.keyboard.press("w");
  await told(tab, column(cells[2]));
  await tab.keyboard.press("r");
  await told(tab, "Worst region: 16 × 16 cells");
  const [left, right] = [await pointedAt(tab, "#heat-map", "#cell-told", [0.01, 0.5]), await pointedAt(tab, "#heat-map", "#cell-told", [0.99, 0.5])];
  const middle = (left[0] + right[0]) / 2;
  assert.ok(right[0] - left[0] < 0.75 * WIDTH && Math.abs(middle - square.column - SIDE / 2) < SIDE, `${left} to ${right}`);
  await tab.click("#worst-rows tr:nth-child(4) button");
  await told(tab, column(cells[3]));
  await accessible(tab);

  // The file holds them with all digits.
  const [head, region, ...rows] = (await saved(tab, "#save-worst")).toString().trim().split("\n").map((line) => line.split(","));
  assert.equal(head.length, rows[0].length);
  assert.deepEqual(head.slice(5, 7), ["x_m", "y_m"]);
  assert.deepEqual(rows.map(([what, column, row, , , , , p]) => [what, Number(column), Number(row), Math.fround(p)]),
    cells.map(({ column, row, p }) => ["cell", column, row, p]));
  assert.deepEqual(region.slice(0, 5), ["region", square.column, square.row, SIDE, SIDE].map(String));
  assert.ok(Math.abs(region[5] - (square.column + SIDE / 2) * 0.05) < 1e-9 && Math.abs(region[8] - square.sum) < 1e-3, region.join());

  // Another size of regions.
  await tab.selectOption("#worst-side", "4");
  await tab.waitForFunction(() => document.getElementById("worst-square").textContent.startsWith("Worst region: 4 × 4 cells"));
});

await test("a map that is certain has no worst cells", async (tab) => {
  await idle(tab);
  await drop(tab, [npy("certain.npy", 2, 2, [0, 1, 0.5, 0])]);
  await tab.waitForFunction(() => document.getElementById("chosen").textContent === "certain.npy");
  await idle(tab);
  assert.ok(await tab.locator("#worst-none").isVisible());
  assert.equal(await tab.locator("#worst-table").isVisible(), false);
  for (const id of ["#worst-cell", "#worst-region", "#save-worst"]) assert.ok(await tab.locator(id).isDisabled());
});

await test("the buttons zoom about the marked cell", async (tab) => {
  await idle(tab);
  await tab.locator("#heat-map").scrollIntoViewIfNeeded();
  const cell = await pointedAt(tab, "#heat-map", "#cell-told", [0.3, 0.3]);
  const { x, y, width, height } = await tab.locator("#heat-map").boundingBox();
  await tab.mouse.click(x + 0.3 * width, y + 0.3 * height);
  // On its way to the button the pointer passes over other cells.
  await tab.mouse.move(x + 0.5 * width, y + 0.1 * height, { steps: 4 });
  for (let k = 0; k < 3; k++) await tab.click("#zoom-in");
  await told(tab, `Column ${cell[0]}, row ${cell[1]}, `);
  assert.deepEqual(await pointedAt(tab, "#heat-map", "#cell-told", [0.3, 0.3]), cell);
});

await test("of more equal cells than are listed it is said how many there are", async (tab) => {
  await idle(tab);
  await drop(tab, [npy("ties.npy", 4, 7, new Array(28).fill(0.25))]);
  await tab.waitForFunction(() => document.getElementById("chosen").textContent === "ties.npy");
  await idle(tab);
  assert.equal(await tab.textContent("#worst-caption"), "The first 10 of 28 cells with the largest entropy, numbers to six digits.");
  await tab.focus("#heat-map");
  for (let k = 0; k < 2; k++) await tab.keyboard.press("w");
  await tab.waitForFunction(() => document.getElementById("cell-told").textContent.endsWith("worst cell 2 of 10 listed, of 28 that are equal"));
  // The two questions are told apart.
  assert.match(await tab.textContent("#worst"), /Two questions/);
});

await test("the wheel scrolls the page, and zooms where the map has the focus or with Ctrl", async (tab) => {
  await idle(tab);
  const canvas = tab.locator("#heat-map");
  await canvas.scrollIntoViewIfNeeded();
  const { x, y, width, height } = await canvas.boundingBox();
  await tab.mouse.move(x + width / 2, y + height / 2);
  const wheel = (deltaY, ctrlKey = false) => canvas.evaluate((canvas, [deltaY, ctrlKey]) => {
    const { left, top, width, height } = canvas.getBoundingClientRect();
    const [clientX, clientY] = [left + width / 2, top + height / 2];
    // False where the page does not scroll.
    return canvas.dispatchEvent(new WheelEvent("wheel", { deltaY, ctrlKey, clientX, clientY, cancelable: true, bubbles: true }));
  }, [deltaY, ctrlKey]);
  const scrolls = [await wheel(-100), await wheel(100)];
  await canvas.focus();
  // Focused: at all nothing is left to zoom out; in and out again zoom.
  scrolls.push(await wheel(100), await wheel(-100), await wheel(100), await wheel(100));
  await tab.focus("#zoom-in");
  scrolls.push(await wheel(-100, true), await wheel(100, true), await wheel(100, true));
  assert.deepEqual(scrolls, [true, true, true, false, false, true, false, false, false]);
  assert.match(await tab.textContent("#keys"), /wheel.*focus.*Ctrl/s);
  // As a wheel does it.
  const at = await tab.evaluate(() => scrollY);
  await tab.mouse.wheel(0, -60);
  await tab.waitForFunction((at) => scrollY < at, at);
});

await test("where two fingers part no cell is marked", async (tab) => {
  await idle(tab);
  const touch = (steps) => tab.locator("#heat-map").evaluate((canvas, steps) => {
    canvas.setPointerCapture = () => {};
    const { left, top, width, height } = canvas.getBoundingClientRect();
    for (const [type, pointerId, right, down] of steps) {
      canvas.dispatchEvent(new PointerEvent(type, { pointerId, clientX: left + right * width, clientY: top + down * height, bubbles: true }));
    }
  }, steps);
  const before = await tab.textContent("#cell-told");
  await touch([["pointerdown", 1, 0.4, 0.5], ["pointerdown", 2, 0.6, 0.5], ["pointerup", 2, 0.6, 0.5], ["pointerup", 1, 0.4, 0.5]]);
  await tab.waitForTimeout(300);
  assert.equal(await tab.textContent("#cell-told"), before);
  // One finger marks.
  await touch([["pointerdown", 3, 0.4, 0.5], ["pointerup", 3, 0.4, 0.5]]);
  await told(tab, "Column");
});

await test("a finger scrolls the page where all of a map is shown, and moves the map where it is enlarged", async (tab) => {
  await idle(tab);
  const action = () => tab.locator("#heat-map").evaluate((canvas) => getComputedStyle(canvas).touchAction);
  assert.equal(await action(), "pan-x pan-y");
  await tab.click("#zoom-in");
  assert.equal(await action(), "none");
  await tab.click("#fit");
  assert.equal(await action(), "pan-x pan-y");
});
