// Files that are chosen one after the other: which image is taken, which result is shown, and in which words.
import assert from "node:assert/strict";
import { YAML, drop, idle, made, measured, npy, shows, sparse, test, texts } from "./harness.mjs";

const pgm = (name, ...greys) => made(name, Buffer.concat([Buffer.from(`P5\n${greys.length} 1\n255\n`), Buffer.from(greys)]));

await test("an image that was here before is told of where a description comes alone", async (tab) => {
  await idle(tab);
  const [first, second] = ["one.yaml", "two.yaml"].map((name) => made(name, YAML("shared.pgm")));
  await drop(tab, [first, pgm("shared.pgm", 0, 254)]);
  await shows(tab, "one.yaml");
  await idle(tab);
  assert.deepEqual(await texts(tab, "#notices"), []);
  await drop(tab, [second]);
  await shows(tab, "two.yaml");
  await idle(tab);
  await tab.locator("#notices p").waitFor();
  assert.match((await texts(tab, "#notices")).join(), /^two\.yaml came alone: its image is the file shared\.pgm that was chosen earlier/);
  assert.match(await tab.textContent("#facts"), /shared\.pgm, 13 bytes, chosen earlier/);
  // Both together, and those that they replace are told of.
  await drop(tab, [second, pgm("shared.pgm", 0, 254)]);
  await tab.waitForFunction(() => !document.getElementById("facts").textContent.includes("earlier"));
  await idle(tab);
  assert.deepEqual(await texts(tab, "#notices"), ["In the place of another file of the same name, which was chosen earlier: two.yaml, shared.pgm."]);
});

await test("a map that is added is shown, and after a bad one it is said what is shown", async (tab) => {
  await idle(tab);
  await drop(tab, [npy("early.npy", 1, 2, [0.25, 0.75])]);
  await shows(tab, "early.npy");
  await idle(tab);
  await drop(tab, [npy("late.npy", 1, 2, [0.125, 0.75])]);
  await shows(tab, "late.npy");
  await idle(tab);
  assert.equal(await tab.textContent("#number"), String(measured("late.npy").mean_information));
  await drop(tab, [made("bad.npy", "no array")]);
  await tab.locator("#notices p").waitFor();
  assert.deepEqual(await texts(tab, "#errors"), [measured("bad.npy")]);
  assert.deepEqual(await texts(tab, "#notices"), ["What is shown below is still late.npy, chosen earlier."]);
  // The next good one takes both words away.
  await drop(tab, [npy("later.npy", 1, 2, [0.5, 0.75])]);
  await tab.locator("#notices p").waitFor({ state: "detached" });
  assert.deepEqual(await texts(tab, "#errors"), []);
  // Of two of which one is bad, one is measured.
  await idle(tab);
  await drop(tab, [npy("good.npy", 1, 1, [0.25]), made("worse.npy", "")]);
  await tab.waitForFunction(() => document.getElementById("status").textContent === "1 of 2 maps measured");
  await shows(tab, "good.npy");
});

await test("a refusal for want of an image ends its sentence", async (tab) => {
  await idle(tab);
  await drop(tab, [made("alone.yaml", YAML("absent.pgm"))]);
  await tab.locator("#errors p").waitFor();
  assert.equal(await tab.textContent("#errors p"), `${measured("alone.yaml")}. Drop absent.pgm here, too.`);
});

await test("the page names its controls where the command names its options", async (tab) => {
  await idle(tab);
  const greys = Array.from({ length: 60 }, (_, k) => 4 * k);
  await drop(tab, [made("greys.yaml", YAML("greys.pgm")), pgm("greys.pgm", ...greys)]);
  await shows(tab, "greys.yaml");
  await idle(tab);
  const options = /--(mode|unknown|encoding|semantics|resolution|submaps)/;
  assert.match(measured("greys.yaml").warnings.join(), options);
  const warnings = (await tab.locator("#warnings li").allTextContents()).join();
  assert.match(warnings, /“mode of ROS maps”: scale/);
  assert.doesNotMatch(warnings, options);
  const labels = await tab.textContent("#reading");
  for (const [, label] of warnings.matchAll(/“([^”]+)”/g)) assert.ok(`${labels}How files are read`.includes(label), label);
});

await test("a map of too many cells for a picture has its number, and the option for more is said to be the command's", async (tab) => {
  await idle(tab);
  const head = "P5\n16385 16384\n255\n";
  await tab.setInputFiles("#files", [made("vast.yaml", YAML("vast.pgm")), sparse("vast.pgm", head, head.length + 16385 * 16384)]);
  await tab.locator("#no-picture:not(:empty)").waitFor();
  assert.match(await tab.textContent("#no-picture"), /--max-cells.*options of the command meaninfo, which this page has not/);
  assert.equal(await tab.textContent("#number"), "1");
});
