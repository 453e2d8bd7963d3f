// Images that no file describes, and what is said of files that are no maps.
import assert from "node:assert/strict";
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { accessible, YAML, drag, drop, idle, made, measured, npy, saved, shows, test, texts, work } from "./harness.mjs";

const pgm = (name, greys, length = greys.length) => made(name, Buffer.concat([Buffer.from(`P5\n${length} 1\n255\n`), Buffer.from(greys)]));

await test("an image that is described in the form is neither accused nor called a yaml file", async (tab) => {
  await idle(tab);
  await drop(tab, [pgm("floor.pgm", [0, 254, 254])]);
  await tab.locator("#describe").waitFor();
  assert.deepEqual(await texts(tab, "#errors"), []);
  await tab.click("#describe button");
  await shows(tab, "floor.pgm, described here");
  await idle(tab);
  assert.deepEqual(await texts(tab, "#notices"), []);
  assert.doesNotMatch(await tab.textContent("#facts"), /earlier/);
  assert.equal(JSON.parse(await saved(tab, "#save-json"))[0].map, "floor.pgm");
  // A number of 1 is one bit, and its reason stands beside it.
  assert.equal(await tab.textContent("#unit"), "bit per observed cell");
  assert.match(await tab.textContent("#meaningless"), /^Not meaningful: thresholded: every observed cell has p = 0 or 1/);
  const size = (id) => tab.evaluate((id) => parseFloat(getComputedStyle(document.querySelector(id)).fontSize), id);
  assert.equal(await size("#meaningless"), await size("#number"));
  await accessible(tab);
  // A yaml file of the image's name is another map.
  await drop(tab, [made("floor.yaml", YAML("other.pgm")), pgm("other.pgm", [0, 254])]);
  await tab.waitForFunction(() => document.querySelectorAll("#rows tr").length === 2);
  assert.deepEqual(await tab.locator("#rows th").allTextContents(), ["floor.pgm, described here", "floor.yaml"]);
});

await test("a description that is refused can be mended in the form", async (tab) => {
  await idle(tab);
  await drop(tab, [pgm("mended.pgm", [0, 100, 254])]);
  await tab.locator("#describe").waitFor();
  await tab.selectOption("#describe [name=mode]", "scale");
  await tab.fill("#describe [name=resolution]", "0,05");
  await tab.click("#describe button");
  await tab.locator("#errors p").waitFor();
  await tab.waitForTimeout(300);
  assert.ok(await tab.locator("#describe").isVisible());
  await tab.fill("#describe [name=resolution]", "0.05");
  await tab.click("#describe button");
  await shows(tab, "mended.pgm, described here");
  await idle(tab);
  assert.deepEqual(await texts(tab, "#errors"), []);
  assert.equal(await tab.locator("#describe").isVisible(), false);
});

await test("a map that is meaningful gives no reason", async (tab) => {
  await idle(tab);
  assert.equal(await tab.locator("#meaningless").isVisible(), false);
  assert.equal(await tab.textContent("#unit"), "bits per observed cell");
});

await test("the form takes the grey that means unknown where the mode has one", async (tab) => {
  await idle(tab);
  await drop(tab, [pgm("greys.pgm", [10, 128, 200, 128])]);
  await tab.locator("#describe").waitFor();
  assert.equal(await tab.locator("#describe-unknown").isVisible(), false);
  await tab.selectOption("#describe [name=mode]", "probability");
  await tab.fill("#describe [name=unknown]", "128");
  await tab.click("#describe button");
  await shows(tab, "greys.pgm, described here");
  await idle(tab);
  made("greys.yaml", YAML("greys.pgm"));
  const row = measured("greys.yaml", "--mode", "probability", "--unknown", "128");
  assert.equal(row.unknown, 2);
  assert.equal(await tab.textContent("#number"), String(row.mean_information));
});

await test("a picture that cannot be read is refused, and opens no form", async (tab) => {
  await idle(tab);
  await drop(tab, [npy("good.npy", 1, 2, [0.25, 0.75])]);
  await shows(tab, "good.npy");
  await idle(tab);
  await drop(tab, [pgm("bad.pgm", [0], 3)]);
  await tab.locator("#errors p").waitFor();
  made("bad.yaml", YAML("bad.pgm"));
  assert.deepEqual(await texts(tab, "#errors"), [measured("bad.yaml").replace(" (the image that bad.yaml names)", "")]);
  assert.equal(await tab.locator("#describe").isVisible(), false);
  await tab.locator("#notices p").waitFor();
  assert.deepEqual(await texts(tab, "#notices"), ["What is shown below is still good.npy, chosen earlier."]);
  // A good one opens it; it is also said what is shown.
  await drop(tab, [pgm("fine.pgm", [0, 254])]);
  await tab.locator("#describe").waitFor();
  assert.deepEqual(await tab.locator("#described option").allTextContents(), ["fine.pgm"]);
  await tab.waitForFunction(() => document.getElementById("notices").textContent ===
    "What is shown below is still good.npy, chosen earlier. An image is measured when it is described above.");
  assert.equal((await saved(tab, "#save-json")).toString().match(/"map"/g).length, 1);
  // A folder.
  mkdirSync(join(work, "folder"), { recursive: true });
  await tab.evaluate(() => scrollTo(0, 0));
  await drag(tab, [join(work, "folder")]);
  await tab.locator("#errors p").waitFor();
  assert.deepEqual(await texts(tab, "#errors"), ["folder: is a directory; allowed are files"]);
  await tab.waitForFunction(() => document.getElementById("notices").textContent === "What is shown below is still good.npy, chosen earlier.");
});

await test("a bag names its commands, another file what is read here; names of files stay", async (tab) => {
  await idle(tab);
  await drop(tab, [made("drive.bag", "#ROSBAG V2.0\n")]);
  await tab.locator("#errors p").waitFor();
  const [bag] = await texts(tab, "#errors");
  for (const command of ["meaninfo map drive.bag", "meaninfo bag drive.bag"]) assert.ok(bag.includes(command), bag);
  await drop(tab, [made("notes.txt", "hello")]);
  await tab.waitForFunction(() => document.getElementById("errors").textContent.startsWith("notes.txt"));
  const [text] = await texts(tab, "#errors");
  assert.match(measured("notes.txt"), /; allowed are \.yaml, .*\.pbstream$/);
  assert.doesNotMatch(text, /\.bag|\.mcap|\.db3/);
  for (const ending of [".yaml", ".npz", ".pbstream", "images"]) assert.ok(text.includes(ending), text);
  await drop(tab, [made("site--mode.npy", "no array"), made("plan --mode raw.npy", "no array")]);
  await tab.waitForFunction(() => document.querySelectorAll("#errors p").length === 2);
  assert.deepEqual(await texts(tab, "#errors"), [measured("site--mode.npy"), measured("plan --mode raw.npy")]);
});
