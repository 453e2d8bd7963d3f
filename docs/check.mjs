// Parses every formula of the book as KaTeX does, strictly: `node docs/check.mjs`.
//
// KaTeX is the version that src/book/typeset.html names, from the npm registry, kept in target/ and compared with the
// digests given there.
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readFileSync, readdirSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const docs = dirname(fileURLToPath(import.meta.url));
const header = readFileSync(join(docs, "../src/book/typeset.html"), "utf8");
const linked = /katex@([\d.]+)\/dist\/([\w.]+)"\s+integrity="sha384-([^"]+)"/g;
const files = [...header.matchAll(linked)].map(([, version, name, digest]) => ({ version, name, digest }));
const [{ version }] = files;
if (files.length !== 2 || files.some((file) => file.version !== version)) {
  throw new Error("src/book/typeset.html: a script and a style sheet of one version, each with its digest");
}

const folder = join(resolve(process.env.CARGO_TARGET_DIR ?? join(docs, "../target")), `katex-${version}`);
if (!existsSync(join(folder, "package"))) {
  mkdirSync(folder, { recursive: true });
  const archive = execFileSync("npm", ["pack", "--silent", `katex@${version}`], { cwd: folder, encoding: "utf8" });
  execFileSync("tar", ["xzf", archive.trim()], { cwd: folder });
}
for (const { name, digest } of files) {
  const found = createHash("sha384").update(readFileSync(join(folder, "package/dist", name))).digest("base64");
  if (found !== digest) throw new Error(`${name} has the digest sha384-${found}`);
}
const katex = createRequire(import.meta.url)(join(folder, "package/dist/katex.min.js"));

/** The formulas of a chapter with the lines they begin on, and what is no formula though it looks like one. */
function formulas(text) {
  const found = [];
  let fence = null;
  text.split("\n").forEach((line, index) => {
    const mark = /^\s*(`{3,})\s*(\w*)/.exec(line);
    if (fence) {
      if (mark && mark[1].length >= fence.length && mark[2] === "") {
        if (fence.maths) found.push({ line: fence.line, tex: fence.lines.join("\n"), displayMode: true });
        fence = null;
      } else fence.lines.push(line);
    } else if (mark) {
      fence = { length: mark[1].length, maths: mark[2] === "math", line: index + 2, lines: [] };
    } else {
      const rest = line.replace(/\$`([^`]*)`\$/g, (_, tex) => {
        // GitHub ends a cell of a table at a bar, in a formula, too.
        const broken = line.startsWith("|") && tex.includes("|") ? "a bar in a table: \\lvert, \\rvert" : undefined;
        found.push({ line: index + 1, tex, displayMode: false, broken });
        return "";
      });
      if (rest.includes("$`") || rest.includes("`$")) {
        found.push({ line: index + 1, broken: "a formula in a line ends in that line: $`…`$" });
      }
    }
  });
  if (fence) found.push({ line: fence.line, broken: "the block does not end" });
  return found;
}

let count = 0;
let wrong = 0;
for (const name of readdirSync(docs).filter((name) => name.endsWith(".md")).sort()) {
  for (const { line, tex, displayMode, broken } of formulas(readFileSync(join(docs, name), "utf8"))) {
    count += 1;
    try {
      if (broken) throw new Error(broken);
      const refused = /\\(operatorname|mbox|phantom|hphantom|vphantom|def|newcommand|renewcommand|require)\b/.exec(tex);
      if (refused) throw new Error(`GitHub refuses ${refused[0]}`);
      katex.renderToString(tex, { displayMode, strict: "error", throwOnError: true });
    } catch (error) {
      wrong += 1;
      console.error(`docs/${name}:${line}: ${error.message}`);
    }
  }
}
console.log(`${count} formulas, ${wrong} wrong`);
process.exit(wrong === 0 && count > 0 ? 0 : 1);
