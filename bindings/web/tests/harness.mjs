// What the tests of the page share: the browser, the command, files to drop, and what is expected of every test.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, rmSync, truncateSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const TOOLS = ["playwright-core@1.65.1", "axe-core@4.14.1"];
const root = resolve(dirname(fileURLToPath(import.meta.url)), "../../..");
const target = join(resolve(process.env.CARGO_TARGET_DIR ?? join(root, "target")), "web");
export const meaninfo = resolve(process.argv[2]);
const built = resolve(process.argv[3] ?? join(target, "meaninfo.html"));
export const source = () => readFileSync(built, "utf8");
const page = pathToFileURL(built).href;

if (!TOOLS.every((tool) => existsSync(join(target, "node_modules", tool.split("@")[0])))) {
  execFileSync("npm", ["install", "--silent", "--no-save", "--no-audit", "--no-fund", "--prefix", target, ...TOOLS]);
}
const require = createRequire(join(target, "node_modules/"));
const { chromium } = require("playwright-core");
const axe = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");

/** What the command says of these arguments, in the folder of the sample. */
export const maps = join(root, "maps");
export const said = (...args) => spawnSync(meaninfo, args, { cwd: maps, encoding: "utf8" });
export const json = (...args) => said(...args, "--format", "json").stdout;

export const work = join(tmpdir(), `meaninfo-page-${process.pid}`);
export const pictures = join(target, "pictures");
for (const folder of [work, pictures]) mkdirSync(folder, { recursive: true });
export const made = (name, bytes) => {
  writeFileSync(join(work, name), bytes);
  return join(work, name);
};
export const YAML = (image) => `image: ${image}\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n`;

/** Begins a browser. */
export const launch = (...args) => chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync", ...args],
});
export const browser = await launch();
let [passed, skipped] = [0, 0];
const troubles = [];

/** Tells what was not tested, and why. */
export function skip(what) {
  skipped += 1;
  console.log(`skipped: ${what}`);
}

/** Opens the page anew, and runs a test on it; nothing may be asked of a network. `given` may be a function of what is given. */
export async function test(name, run, given = {}) {
  if (!name.includes(process.env.ONLY ?? "")) return;
  const faults = [];
  let tab = null;
  try {
    const options = typeof given === "function" ? given() : given;
    const context = await (options.browser ?? browser).newContext({ acceptDownloads: true, ...options });
    await context.setOffline(true);
    tab = await context.newPage();
    tab.setDefaultTimeout(60_000);
    tab.on("pageerror", (error) => faults.push(String(error)));
    tab.on("console", (message) => message.type() === "error" && faults.push(message.text()));
    tab.on("request", (request) => /^(file|blob|data):/.test(request.url()) || faults.push(request.url()));
    await tab.goto(options.page ?? page);
    await run(tab);
    assert.deepEqual(faults.filter((fault) => !options.expected?.test(fault)), []);
    passed += 1;
    console.log(`ok: ${name}`);
  } catch (error) {
    troubles.push(name);
    console.log(`NOT OK: ${name}\n${error.stack}`);
    await tab?.screenshot({ path: join(pictures, "trouble.png"), fullPage: true }).catch(() => {});
  }
  await tab?.context().close();
}

export const idle = async (tab) => {
  await tab.locator("#sweep:not([hidden]), #no-picture:not(:empty)").first().waitFor();
  await tab.locator("#progress").waitFor({ state: "hidden" });
};
export const shows = (tab, name) => tab.waitForFunction((name) => document.getElementById("chosen").textContent === name, name);
export const texts = (tab, id) => tab.locator(`${id} p`).allTextContents();
export const saved = async (tab, button) => {
  const [download] = await Promise.all([tab.waitForEvent("download"), tab.click(button)]);
  return readFileSync(await download.path());
};
/** Drops files on the page as a file manager does. */
export const drop = async (tab, paths) => {
  const files = paths.map((path) => [path.split("/").pop(), readFileSync(path).toString("base64")]);
  const data = await tab.evaluateHandle((files) => {
    const transfer = new DataTransfer();
    for (const [name, base64] of files) {
      transfer.items.add(new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], name));
    }
    return transfer;
  }, files);
  await tab.dispatchEvent("#drop", "drop", { dataTransfer: data });
};
/** Drags paths of the disk over the page and drops them, folders, too. */
export const drag = async (tab, paths) => {
  const session = await tab.context().newCDPSession(tab);
  const { x, y } = await tab.locator("#drop").boundingBox();
  const data = { items: [], files: paths, dragOperationsMask: 1 };
  for (const type of ["dragEnter", "dragOver", "drop"]) {
    await session.send("Input.dispatchDragEvent", { type, x: x + 9, y: y + 9, data });
  }
};
/** What the command says of a map in the folder of the tests' own files: its row, or a refusal without the command's name. */
export const measured = (name, ...options) => {
  const { status, stdout, stderr } = spawnSync(meaninfo, ["map", name, ...options, "--format", "json"], { cwd: work, encoding: "utf8" });
  return status === 0 ? JSON.parse(stdout)[0] : stderr.trim().replace(/^meaninfo: /, "");
};
/** A file of so many bytes that takes no room on the disk: zeros behind its beginning. */
export const sparse = (name, beginning, length) => {
  const path = made(name, Buffer.from(beginning, "latin1"));
  truncateSync(path, length);
  return path;
};
/** The head of an array of float32, which a file of NumPy begins with. */
export const npyHead = (...shape) => {
  const head = `{'descr': '<f4', 'fortran_order': False, 'shape': (${shape.join(", ")}), }`.padEnd(117) + "\n";
  return `\x93NUMPY\x01\x00${String.fromCharCode(head.length & 255, head.length >> 8)}${head}`;
};
export const goesOn = async (tab) => {
  await drop(tab, ["room.yaml", "room.pgm"].map((name) => join(maps, name)));
  await tab.waitForFunction(() => document.getElementById("rows").textContent.includes("room.yaml"));
  // What came last is looked at.
  await tab.waitForFunction(() => document.getElementById("chosen").textContent === "room.yaml");
  await idle(tab);
  assert.equal(await tab.textContent("#number"), String(JSON.parse(json("map", "room.yaml"))[0].mean_information));
};
export const accessible = async (tab) => {
  await tab.evaluate(axe);
  const { violations } = await tab.evaluate(() => window.axe.run());
  assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html).join(" ")}`), []);
};

/** Numbers from 0 to 1, always the same. */
export function* numbers(seed) {
  for (let state = seed; ; ) {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    yield state / 2 ** 32;
  }
}
/** Writes an array of float32, whose first row is the lowest of the map. */
export const npy = (name, height, width, values) =>
  made(name, Buffer.concat([Buffer.from(npyHead(height, width), "latin1"), Buffer.from(new Float32Array(values).buffer)]));
/** What the page says of the cell under a place of a canvas, in parts of its sides from the upper left. */
export const pointedAt = async (tab, canvas, told, [right, down]) => {
  const { x, y, width, height } = await tab.locator(canvas).boundingBox();
  await tab.mouse.move(x + right * width - 1, y + down * height);
  await tab.mouse.move(x + right * width, y + down * height);
  await tab.waitForTimeout(150);
  const [, column, row] = /^Column (\d+), row (\d+)/.exec(await tab.textContent(told));
  return [Number(column), Number(row)];
};

/** Closes the browser, and tells how many tests passed. */
export async function finish() {
  await browser.close();
  rmSync(work, { recursive: true });
  console.log(`\npictures: ${pictures}\n${passed} passed, ${troubles.length} failed, ${skipped} skipped${troubles.map((name) => `\n  ${name}`).join("")}`);
  process.exitCode = troubles.length ? 1 : 0;
}
