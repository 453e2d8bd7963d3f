// Files that take the place of others: what the module holds, the table shows and the files hold is one.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { YAML, drop, idle, made, measured, meaninfo, npy, npyHead, saved, shows, sparse, test, texts, work } from "./harness.mjs";

const pgm = (greys, length = greys.length) => Buffer.concat([Buffer.from(`P5\n${length} 1\n255\n`), Buffer.from(greys)]);
const yaml = (name) => made(`${name}.yaml`, `${YAML(`${name}.pgm`)}mode: scale\n`);
const ofCommand = (names, format) => spawnSync(meaninfo, ["map", ...names, "--format", format], { cwd: work, encoding: "utf8" }).stdout;

/** Asserts that table, JSON and CSV hold these maps in this order. */
async function holds(tab, ...names) {
  await tab.waitForFunction((names) => [...document.querySelectorAll("#rows th")].map((cell) => cell.textContent).join() === names, names.join());
  await tab.locator("#progress").waitFor({ state: "hidden" });
  for (const format of ["json", "csv"]) {
    assert.equal(await tab.locator(`#save-${format}`).isDisabled(), !names.length);
    if (names.length) assert.equal((await saved(tab, `#save-${format}`)).toString(), ofCommand(names, format));
  }
  const shown = await tab.locator("#rows tr td:nth-child(3)").allTextContents();
  assert.deepEqual(shown.map((text) => text.slice(0, 8)), names.map((name) => measured(name).mean_information.toFixed(6)));
}

await test("a map that takes the place of another leaves the others, in table and files", async (tab) => {
  await idle(tab);
  await drop(tab, [npy("a.npy", 1, 2, [0.1, 0.9]), npy("b.npy", 1, 2, [0.2, 0.9]), npy("c.npy", 1, 2, [0.3, 0.9])]);
  await holds(tab, "a.npy", "b.npy", "c.npy");
  await idle(tab);
  await drop(tab, [npy("b.npy", 1, 3, [0.25, 0.9, 0.4])]);
  await shows(tab, "b.npy");
  await holds(tab, "a.npy", "b.npy", "c.npy");
  assert.deepEqual(await texts(tab, "#notices"), ["In the place of another file of the same name, which was chosen earlier: b.npy."]);
  // What takes the place of the map that is looked at is bad: it goes, and another is shown.
  await drop(tab, [made("b.npy", "no array")]);
  await holds(tab, "a.npy", "c.npy");
  await shows(tab, "a.npy");
  await idle(tab);
  assert.deepEqual(await texts(tab, "#errors"), [measured("b.npy")]);
  await tab.focus("#heat-map");
  await tab.keyboard.press("ArrowRight");
  await tab.waitForFunction(() => document.getElementById("cell-told").textContent.startsWith("Column"));
  await tab.click("#rows tr:nth-child(2) button");
  await shows(tab, "c.npy");
  await idle(tab);
  // Mended, it comes last, as it was measured last.
  await drop(tab, [npy("b.npy", 1, 2, [0.45, 0.9])]);
  await holds(tab, "a.npy", "c.npy", "b.npy");
});

await test("an image that is cut, then mended, alone", async (tab) => {
  await idle(tab);
  await drop(tab, [yaml("cut"), made("cut.pgm", pgm([0, 90, 200]))]);
  await shows(tab, "cut.yaml");
  await idle(tab);
  await drop(tab, [made("cut.pgm", pgm([0], 3))]);
  await tab.locator("#errors p").waitFor();
  assert.deepEqual(await texts(tab, "#errors"), [measured("cut.yaml")]);
  assert.equal(await tab.locator("#summary").isVisible(), false);
  assert.equal(await tab.locator("#picture").isVisible(), false);
  for (const format of ["json", "csv"]) assert.ok(await tab.locator(`#save-${format}`).isDisabled());
  await drop(tab, [made("cut.pgm", pgm([0, 100, 200]))]);
  await shows(tab, "cut.yaml");
  await tab.locator("#summary").waitFor();
  await idle(tab);
  assert.deepEqual(await texts(tab, "#errors"), []);
  assert.equal((await saved(tab, "#save-json")).toString(), ofCommand(["cut.yaml"], "json"));
});

await test("what is stopped while it is measured anew is in no table and no file", async (tab) => {
  await idle(tab);
  await drop(tab, [npy("kept.npy", 1, 2, [0.1, 0.9]), npy("anew.npy", 1, 2, [0.2, 0.9])]);
  await holds(tab, "kept.npy", "anew.npy");
  await idle(tab);
  const stopped = tab.evaluate(() => new Promise((resolve) => {
    const look = () => {
      if (!document.getElementById("status").textContent.startsWith("measuring anew.npy")) return setTimeout(look, 1);
      document.getElementById("stop").click();
      resolve();
    };
    look();
  }));
  await tab.setInputFiles("#files", sparse("anew.npy", npyHead(20000, 20000), 128 + 16e8));
  await stopped;
  await tab.locator("#errors p").waitFor();
  assert.deepEqual(await texts(tab, "#errors"), ["stopped"]);
  await idle(tab);
  assert.equal((await saved(tab, "#save-json")).toString(), ofCommand(["kept.npy"], "json"));
});
