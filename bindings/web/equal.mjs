// Compares the module's JSON with the command's for every map under some folders: node bindings/web/equal.mjs MEANINFO FOLDER...
// Equal to the byte: rows, and the line of a refusal. Bags are the command's alone.
import { spawnSync } from "node:child_process";
import { existsSync, readdirSync } from "node:fs";
import { basename, dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const MAP = /\.(ya?ml|np[yz]|gridmap(\.gz)?|ot|bt|pbstream)$/;
const [command, ...folders] = process.argv.slice(2);
const meaninfo = resolve(command);
const measure = fileURLToPath(new URL("measure.mjs", import.meta.url));

const mapsIn = (folder) =>
  readdirSync(folder, { withFileTypes: true }).sort((a, b) => (a.name < b.name ? -1 : 1)).flatMap((entry) => {
    const path = join(folder, entry.name);
    return entry.isDirectory() ? mapsIn(path) : MAP.test(entry.name) ? [path] : [];
  });

const said = (program, args, cwd) => {
  const { stdout, stderr, status } = spawnSync(program, args, { cwd, encoding: "utf8" });
  return { status, stdout: status === 0 ? stdout : "", stderr };
};

let [equal, refused, beside, failed] = [0, 0, 0, 0];
for (const path of folders.filter((folder) => existsSync(folder)).flatMap(mapsIn)) {
  for (const options of path.endsWith(".pbstream") ? [[], ["--submaps"]] : [[]]) {
    // In the folder, as the page knows no others.
    const [name, folder] = [basename(path), dirname(path)];
    const wanted = said(meaninfo, ["map", "--format", "json", ...options, name], folder);
    const got = said(process.execPath, [measure, ...options, name], folder);
    const same = wanted.status === got.status && wanted.stdout === got.stdout && wanted.stderr === got.stderr;
    if (same && wanted.status === 0) equal += 1;
    else if (same) refused += 1;
    // A page is handed no folders: it finds by its name an image that the description looks for elsewhere.
    else if (got.status === 0 && /image is ".*lies beside the yaml file/.test(wanted.stderr)) beside += 1;
    else {
      failed += 1;
      console.log(`${path} ${options}\n  the command: ${wanted.status} ${wanted.stdout}${wanted.stderr}\n  the page: ${got.status} ${got.stdout}${got.stderr}`);
    }
  }
}
console.log(`${equal} maps equal to the byte, ${refused} refused by the same line, ${beside} with an image that only the page finds, ${failed} different`);
process.exitCode = failed || equal === 0 ? 1 : 0;
