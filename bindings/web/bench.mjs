// Measures a PGM of 20 000 x 20 000 pixels on the page and by the command: node bindings/web/bench.mjs MEANINFO [PAGE.html]
//
// Processor time, and the most memory that was resident: of the page its renderer's, less what it took for the sample. Needs
// python3, 400 MB for temporary files, and what `test.mjs` brought. Both must agree.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { closeSync, mkdtempSync, openSync, readFileSync, readdirSync, rmSync, writeFileSync, writeSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const SIDE = Number(process.env.SIDE ?? 20_000);
const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
const target = join(resolve(process.env.CARGO_TARGET_DIR ?? join(root, "target")), "web");
const meaninfo = resolve(process.argv[2]);
const page = pathToFileURL(resolve(process.argv[3] ?? join(target, "meaninfo.html"))).href;
const { chromium } = createRequire(join(target, "node_modules/"))("playwright-core");

const folder = mkdtempSync(join(tmpdir(), "meaninfo-bench-"));
const paths = ["large.yaml", "large.pgm"].map((name) => join(folder, name));
writeFileSync(paths[0], "image: large.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\nmode: scale\noccupied_thresh: 1\nfree_thresh: 0\n");
const file = openSync(paths[1], "w");
writeSync(file, `P5\n${SIDE} ${SIDE}\n255\n`);
// Runs of greys, of which 127 is unknown.
const row = Buffer.from(Uint8Array.from({ length: SIDE }, (_, k) => [254, 127, 250, 20][(k >> 5) & 3] - ((k * 7) % 5 === 0 ? 1 : 0)));
for (let k = 0; k < SIDE; k++) writeSync(file, row);
closeSync(file);

const TIMED = `import os, subprocess, sys
p = subprocess.Popen(sys.argv[1:], stdout=subprocess.PIPE)
out = p.stdout.read()
u = os.wait4(p.pid, 0)[2]
print(u.ru_utime + u.ru_stime, u.ru_maxrss)
sys.stdout.write(out.decode())`;
const said = execFileSync("python3", ["-c", TIMED, meaninfo, "map", "--format", "json", paths[0]], { encoding: "utf8" });
const [first, ...rest] = said.split("\n");
const [seconds, kibibytes] = first.split(" ").map(Number);
const [wanted] = JSON.parse(rest.join("\n"));
console.log(`the command: ${seconds.toFixed(2)} s, ${Math.round(kibibytes / 1024)} MiB`);

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync"],
});
const tab = await browser.newPage();
tab.setDefaultTimeout(1_200_000);
await tab.goto(page);
await tab.locator("#sweep:not([hidden])").waitFor();
/** Processor seconds and peak memory in MiB of the renderer that has worked most. */
const renderer = () =>
  readdirSync("/proc").filter((id) => /^\d+$/.test(id)).flatMap((id) => {
    try {
      if (!readFileSync(`/proc/${id}/cmdline`, "latin1").includes("--type=renderer")) return [];
      const [user, system] = readFileSync(`/proc/${id}/stat`, "latin1").split(") ")[1].split(" ").slice(11, 13).map(Number);
      const peak = Number(/VmHWM:\s+(\d+)/.exec(readFileSync(`/proc/${id}/status`, "latin1"))[1]) / 1024;
      return [{ id, seconds: (user + system) / 100, peak }];
    } catch {
      return [];
    }
  }).sort((a, b) => b.seconds - a.seconds)[0];
const before = renderer();
const began = performance.now();
await tab.setInputFiles("#files", paths);
await tab.waitForFunction(() => document.getElementById("chosen").textContent === "large.yaml" && !document.getElementById("summary").hidden);
const after = renderer();
assert.equal(await tab.textContent("#number"), String(wanted.mean_information));
console.log(`the page: ${(after.seconds - before.seconds).toFixed(2)} s, ${Math.round(after.peak)} MiB in all, ${Math.round(after.peak - before.peak)} MiB more than with the sample; ${((performance.now() - began) / 1000).toFixed(1)} s by the clock`);
await tab.locator("#no-picture:not(:empty), #sweep:not([hidden])").first().waitFor();
console.log(`then: ${await tab.textContent("#no-picture") || "the picture is there"}`);
await browser.close();
rmSync(folder, { recursive: true });
