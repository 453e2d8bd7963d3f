// The page in headless Chromium against the command: node bindings/web/test.mjs MEANINFO [PAGE.html]
//
// playwright-core and axe-core come from the npm registry to target/web; pictures of every view, width and colour scheme are
// left in target/web/pictures. ONLY=WORDS runs the tests whose names hold these words.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import {
  YAML, accessible, drag, drop, finish, goesOn, idle, json, launch, made, maps, measured, meaninfo, npy, npyHead, pictures, said, saved,
  sparse, test, work,
} from "./tests/harness.mjs";

await test("the sample is there, and is the command's number", async (tab) => {
  await idle(tab);
  const [row] = JSON.parse(json("map", "room.yaml"));
  assert.equal(await tab.textContent("#number"), String(row.mean_information));
  assert.equal((await saved(tab, "#save-json")).toString(), json("map", "room.yaml"));
  assert.equal((await saved(tab, "#save-csv")).toString(), said("map", "room.yaml", "--format", "csv").stdout);
  const png = await saved(tab, "#save-png");
  assert.equal(png.subarray(1, 4).toString(), "PNG");
  const steps = JSON.parse(json("sweep", "room.yaml")).rows;
  const shown = await tab.locator("#sweep-rows tr").evaluateAll((rows) => rows.map((row) => row.cells[1].textContent));
  assert.deepEqual(shown, steps.map((step) => step.mean_information.toFixed(6)));
});

await test("the page has no way to a network", async (tab) => {
  const violated = await tab.evaluate(() => new Promise((resolve) => {
    addEventListener("securitypolicyviolation", ({ effectiveDirective }) => resolve(effectiveDirective));
    fetch("https://example.org/").then(() => resolve("reached"), () => {});
  }));
  assert.equal(violated, "connect-src");
}, { expected: /Content Security Policy/ });

await test("the sample dropped; a cell by the keys", async (tab) => {
  await idle(tab);
  await drop(tab, ["room.yaml", "room.pgm"].map((name) => join(maps, name)));
  await tab.waitForFunction(() => document.getElementById("chosen").textContent === "room.yaml");
  await idle(tab);
  assert.equal((await saved(tab, "#save-json")).toString(), json("map", "room.yaml"));
  await tab.focus("#heat-map");
  await tab.keyboard.press("+");
  await tab.keyboard.press("ArrowRight");
  await tab.waitForFunction(() => document.getElementById("cell-told").textContent.includes("H "));
  assert.match(await tab.textContent("#cell-told"), /Column \d+, row \d+, at x [\d.-]+, y [\d.-]+ m: p [\d.e-]+, H [\d.e-]+, I [\d.e-]+ bits/);
});

await test("a broken map is refused by the command's line, and the page goes on", async (tab) => {
  await idle(tab);
  const broken = made("broken.yaml", YAML("broken.pgm").replace("0.05", "-0.05"));
  await drop(tab, [broken, made("broken.pgm", "P5 1 1 255 x")]);
  await tab.locator("#errors p").waitFor();
  assert.equal(await tab.textContent("#errors p"), measured("broken.yaml"));
  await goesOn(tab);
});

await test("a yaml file without its image asks for it", async (tab) => {
  await idle(tab);
  await drop(tab, [join(maps, "room.yaml")]);
  await tab.locator("#errors p").waitFor();
  assert.match(await tab.textContent("#errors"), /Drop room\.pgm here, too/);
  await drop(tab, [join(maps, "room.pgm")]);
  await idle(tab);
  assert.equal((await saved(tab, "#save-json")).toString(), json("map", "room.yaml"));
});

await test("an image without a yaml file can be described", async (tab) => {
  await idle(tab);
  const pgm = "P5\n3 2\n255\n" + "\x00\xfe\x00\xfe\xcd\xfe";
  await drop(tab, [made("plan.pgm", Buffer.from(pgm, "latin1"))]);
  await tab.locator("#describe").waitFor();
  await tab.click("#describe button");
  await idle(tab);
  made("plan.yaml", YAML("plan.pgm"));
  const row = measured("plan.yaml");
  assert.equal(await tab.textContent("#number"), String(row.mean_information));
  assert.deepEqual(await tab.locator("#warnings li").allTextContents(), row.warnings);
  assert.equal(await tab.locator("#describe").isVisible(), false);
});

await test("files of the names of others take their place", async (tab) => {
  await idle(tab);
  const pgm = (...greys) => Buffer.concat([Buffer.from(`P5\n${greys.length} 1\n255\n`), Buffer.from(greys)]);
  const yaml = made("again.yaml", `${YAML("again.pgm")}mode: scale\n`);
  const seen = async (paths) => {
    await drop(tab, paths);
    const wanted = spawnSync(meaninfo, ["map", "again.yaml", "--format", "json"], { cwd: work, encoding: "utf8" }).stdout;
    const number = String(JSON.parse(wanted)[0].mean_information);
    await tab.waitForFunction((number) => document.getElementById("number").textContent === number, number);
    await idle(tab);
    assert.equal((await saved(tab, "#save-json")).toString(), wanted);
    return number;
  };
  const first = await seen([yaml, made("again.pgm", pgm(0, 100, 120, 254))]);
  // Both again, then the image alone.
  const second = await seen([yaml, made("again.pgm", pgm(0, 150))]);
  const third = await seen([made("again.pgm", pgm(90, 110, 254))]);
  assert.equal(new Set([first, second, third]).size, 3);
});

await test("three maps at once make a table", async (tab) => {
  await idle(tab);
  const paths = [npy("a.npy", 2, 2, [0.1, 0.5, 0.9, 0.25]), npy("b.npy", 2, 3, [0.5, 0.5, 0.5, 0.5, 0.75, 1]), npy("c.npy", 2, 2, [0, 1, 1, 0])];
  await drop(tab, paths);
  await tab.waitForFunction(() => document.querySelectorAll("#rows tr").length === 3);
  await idle(tab);
  const wanted = spawnSync(meaninfo, ["map", "a.npy", "b.npy", "c.npy", "--format", "json"], { cwd: work, encoding: "utf8" }).stdout;
  assert.equal((await saved(tab, "#save-json")).toString(), wanted);
  await tab.click("text=b.npy");
  await tab.waitForFunction(() => document.getElementById("chosen").textContent === "b.npy");
  assert.equal(await tab.textContent("#number"), String(JSON.parse(wanted)[1].mean_information));
  // As log-odds they are other maps.
  await idle(tab);
  await tab.click("summary");
  await tab.selectOption("select[name=encoding]", "log-odds");
  const asLogOdds = spawnSync(meaninfo, ["map", "b.npy", "--encoding", "log-odds", "--format", "json"], { cwd: work, encoding: "utf8" });
  const number = String(JSON.parse(asLogOdds.stdout)[0].mean_information);
  await tab.waitForFunction((number) => document.getElementById("number").textContent === number, number);
  await idle(tab);
  await accessible(tab);
});

await test("a folder is refused, and what came with it is measured", async (tab) => {
  await idle(tab);
  mkdirSync(join(work, "folder.yaml"), { recursive: true });
  await drag(tab, [join(work, "folder.yaml"), made("beside.npy", Buffer.from(npyHead(1, 1) + "\x00\x00\x80\x3e", "latin1"))]);
  await tab.locator("#errors p").waitFor();
  assert.deepEqual(await tab.locator("#errors p").allTextContents(), ["folder.yaml: is a directory; allowed are files"]);
  assert.equal(await tab.textContent("#number"), String(measured("beside.npy").mean_information));
});

await test("files of five gigabytes, a map and none", async (tab) => {
  await idle(tab);
  made("long.yaml", YAML("long.pgm"));
  sparse("long.pgm", "P5\n2 1\n255\n\x00\xfe", 5e9);
  const row = measured("long.yaml");
  assert.match(row.warnings.join(" "), /goes on after its image/);
  sparse("none.npy", "", 5e9);
  await tab.setInputFiles("#files", ["long.yaml", "long.pgm", "none.npy"].map((name) => join(work, name)));
  await tab.locator("#errors p").waitFor();
  assert.deepEqual(await tab.locator("#errors p").allTextContents(), [measured("none.npy")]);
  await tab.waitForFunction(() => document.getElementById("chosen").textContent === "long.yaml");
  assert.equal(await tab.textContent("#number"), String(row.mean_information));
  assert.deepEqual(await tab.locator("#warnings li").allTextContents(), row.warnings);
});

await test("100 million cells hold up nothing else, and can be stopped", async (tab) => {
  await idle(tab);
  made("wide.yaml", YAML("wide.pgm"));
  sparse("wide.pgm", "P5\n10000 10000\n255\n", 1e8 + 18);
  // In the page, as the way to a browser under load may take longer than the map.
  const seen = tab.evaluate(async () => {
    const until = async (is) => { while (!is()) await new Promise((next) => setTimeout(next, 5)); };
    const [stop, p] = ["stop", "p"].map((id) => document.getElementById(id));
    await until(() => !stop.hidden);
    document.getElementById("cell-tab").click();
    p.value = "0x1.8p-2";
    p.dispatchEvent(new Event("input", { bubbles: true }));
    await until(() => document.getElementById("one-rows").textContent.includes("0.375"));
    const isWorking = !stop.hidden;
    document.getElementById("map-tab").click();
    stop.click();
    return isWorking;
  });
  await tab.setInputFiles("#files", ["wide.yaml", "wide.pgm"].map((name) => join(work, name)));
  assert.ok(await seen, "the map was measured before one cell: nothing was seen");
  await tab.locator("#stop").waitFor({ state: "hidden" });
  await goesOn(tab);
});

const small = await launch("--js-flags=--wasm-max-mem-pages=768");
await test("where memory lacks, this is told, and the page goes on", async (tab) => {
  await idle(tab);
  await tab.setInputFiles("#files", sparse("large.npy", npyHead(4000, 4000), 128 + 64e6));
  await tab.locator("#no-picture:not(:empty)").waitFor();
  assert.match(await tab.textContent("#no-picture"), /not enough memory/);
  // Its number needs no memory.
  assert.equal(await tab.textContent("#number"), String(measured("large.npy").mean_information));
  await goesOn(tab);
}, { browser: small });
await small.close();

await test("the licences of others", async (tab) => {
  await tab.click("#licences summary");
  await tab.locator("#licences-text:not(:empty)").waitFor();
  assert.equal(await tab.textContent("#licences-text"), readFileSync(new URL("THIRD_PARTY.txt", import.meta.url), "utf8"));
  await accessible(tab);
});

await test("the room's limits follow a slider", async (tab) => {
  await tab.click("#room-tab");
  await tab.locator("#limits tr").first().waitFor();
  await tab.focus("#sigma-slider");
  for (let k = 0; k < 3; k++) await tab.keyboard.press("ArrowRight");
  const sigma = await tab.inputValue("#sigma-number");
  assert.equal(sigma, "0.23");
  for (const [row, weight] of [[0, "radial"], [1, "area"]]) {
    const { value } = JSON.parse(json("limit", "--range", "2", "--sigma", sigma, "--weight", weight));
    await tab.waitForFunction(([row, value]) => document.querySelectorAll("#limits tr")[row].cells[1].textContent === value, [row, String(value)]);
  }
  const grid = JSON.parse(json("converge", "--range", "2", "--sigma", sigma, "--grid", "cartesian", "--resolutions", "0.05"));
  assert.equal(await tab.textContent("#limits tr:nth-child(2) td:nth-child(3)"), String(grid.rows[0].mean_information));
  await tab.fill("#range-number", "-1");
  await tab.locator("#room-error:not(:empty)").waitFor();
  await tab.fill("#range-number", "2");
  await tab.locator("#room-error:empty").waitFor({ state: "attached" });
  await accessible(tab);
});

await test("one cell, decimal and hexadecimal", async (tab) => {
  await tab.click("#cell-tab");
  await tab.fill("#p", "0x1.8p-2");
  await tab.waitForFunction(() => document.querySelector("#one-rows")?.textContent.includes("0.375"));
  const bits = Buffer.alloc(8);
  bits.writeDoubleBE(0.375);
  const binary = [...bits].map((byte) => byte.toString(2).padStart(8, "0")).join("");
  assert.equal((await tab.locator("#one-rows tr:nth-child(2) .part").allTextContents()).join(""), binary);
  const asked = ["cell.entropy", "cell.information"].flatMap((op) => ["f32", "f64"].map((format) =>
    JSON.stringify({ cmd: "run", seq: 1, op, format, args: { p: "0x1.8p-2" } })));
  const answers = spawnSync(meaninfo, ["port"], { input: asked.join("\n") + "\n", encoding: "utf8" }).stdout.trim().split("\n");
  const shown = await tab.textContent("#one-rows");
  for (const answer of answers) assert.ok(shown.includes(JSON.parse(answer).result), `${answer} in ${shown}`);
  await tab.fill("#p", "2");
  await tab.locator("#p-error:not(:empty)").waitFor();
  assert.equal(await tab.textContent("#p-error"), "p is 2.0, allowed are 0 to 1");
  await accessible(tab);
});

await test("maps inside the page", async (tab) => {
  await idle(tab);
  assert.equal(await tab.textContent("#chosen"), "plan.yaml");
  assert.equal(await tab.locator("#errors p").count(), 0);
}, withMaps);

/** Has the command write a page with a map inside. */
function withMaps() {
  const out = join(work, "report.html");
  made("plan.yaml", YAML("plan.pgm"));
  made("plan.pgm", Buffer.from("P5\n3 2\n255\n\x00\xfe\x00\xfe\xcd\xfe", "latin1"));
  const { status, stderr } = spawnSync(meaninfo, ["page", "--output", out, "plan.yaml"], { cwd: work, encoding: "utf8" });
  assert.equal(status, 0, stderr);
  return { page: pathToFileURL(out).href };
}

for (const colorScheme of ["light", "dark"]) {
  for (const [width, height] of [[390, 844], [1200, 900], [2000, 1200]]) {
    await test(`pictures at ${width} px, ${colorScheme}`, async (tab) => {
      const shot = (view) => tab.screenshot({ path: join(pictures, `${view}-${width}-${colorScheme}.png`), fullPage: true });
      const fits = async () => {
        const [wide, room] = await tab.evaluate(() => [document.documentElement.scrollWidth, document.documentElement.clientWidth]);
        assert.ok(wide <= room, `${wide} px wide in ${room}`);
      };
      await idle(tab);
      for (const [view, ready] of [["map", "#number"], ["room", "#limits tr"], ["cell", "#one-rows tr"]]) {
        await tab.click(`#${view}-tab`);
        await tab.locator(ready).first().waitFor();
        await tab.waitForTimeout(300);
        await shot(view);
        await fits();
        await accessible(tab);
      }
    }, { colorScheme, viewport: { width, height } });
  }
}

await import("./tests/packed.mjs");
await import("./tests/worst.mjs");
await import("./tests/chosen.mjs");
await import("./tests/replaced.mjs");
await import("./tests/described.mjs");
await import("./tests/shown.mjs");
await finish();
