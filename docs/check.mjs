// Typesets every formula of the book and of the command's pages, and compares with KaTeX: `node docs/check.mjs`.
//
// src/book/mathml.mjs writes them in a reader's browser; here its MathML must have the structure of KaTeX's, which also
// parses each strictly. Those of the command's pages are written beforehand: `node docs/check.mjs --write`.
// KaTeX comes from the npm registry, is kept in target/ and compared with a digest.
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { formula } from "../src/book/mathml.mjs";
import { structure } from "./structure.mjs";

const VERSION = "0.16.47";
const DIGEST = "CwjPRVHTvLiMBFjEoij+QZViMV5rhTOIp7CJzl24JEqpRDA1sJFHVXXLURktbYYp";
const docs = dirname(fileURLToPath(import.meta.url));
const PAGES = join(docs, "../crates/cli/src/output/formulas.rs");

const folder = join(resolve(process.env.CARGO_TARGET_DIR ?? join(docs, "../target")), `katex-${VERSION}`);
if (!existsSync(join(folder, "package"))) {
  mkdirSync(folder, { recursive: true });
  const archive = execFileSync("npm", ["pack", "--silent", `katex@${VERSION}`], { cwd: folder, encoding: "utf8" });
  execFileSync("tar", ["xzf", archive.trim()], { cwd: folder });
}
const script = join(folder, "package/dist/katex.min.js");
const found = createHash("sha384").update(readFileSync(script)).digest("base64");
if (found !== DIGEST) throw new Error(`${script} has the digest sha384-${found}`);
const katex = createRequire(import.meta.url)(script);

/** The formulas of a chapter with the lines they begin on, and what is no formula though it looks like one. */
function formulas(text) {
  const found = [];
  let fence = null;
  text.split("\n").forEach((line, index) => {
    const mark = /^\s*(`{3,})\s*(\w*)/.exec(line);
    if (fence) {
      if (mark && mark[1].length >= fence.length && mark[2] === "") {
        if (fence.maths) found.push({ line: fence.line, tex: fence.lines.join("\n"), displayed: true });
        fence = null;
      } else fence.lines.push(line);
    } else if (mark) {
      fence = { length: mark[1].length, maths: mark[2] === "math", line: index + 2, lines: [] };
    } else {
      const rest = line.replace(/\$`([^`]*)`\$/g, (_, tex) => {
        // GitHub ends a cell of a table at a bar, in a formula, too.
        const broken = line.startsWith("|") && tex.includes("|") ? "a bar in a table: \\lvert, \\rvert" : undefined;
        found.push({ line: index + 1, tex, displayed: false, broken });
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

/** Throws where a formula is refused by KaTeX or GitHub, has no MathML, or another structure than KaTeX gives it. */
function check({ tex, displayed, broken }) {
  if (broken) throw new Error(broken);
  const refused = /\\(operatorname|mbox|phantom|hphantom|vphantom|def|newcommand|renewcommand|require)\b/.exec(tex);
  if (refused) throw new Error(`GitHub refuses ${refused[0]}`);
  const options = { displayMode: displayed, strict: "error", throwOnError: true };
  katex.renderToString(tex, options);
  const untagged = tex.replace(/\\tag\{[^}]*\}/, "");
  const theirs = structure(katex.renderToString(untagged, { ...options, output: "mathml" }));
  const ours = structure(formula(tex, displayed));
  if (ours !== theirs) throw new Error(`${tex}: typeset as ${ours}, by KaTeX as ${theirs}`);
}

let count = 0;
let wrong = 0;
const fault = (place, message) => {
  wrong += 1;
  console.error(`${place}: ${message}`);
};
const displayed = new Set();
for (const name of readdirSync(docs).filter((name) => name.endsWith(".md")).sort()) {
  for (const found of formulas(readFileSync(join(docs, name), "utf8"))) {
    count += 1;
    if (found.displayed) displayed.add(found.tex);
    try {
      check(found);
    } catch (error) {
      fault(`docs/${name}:${found.line}`, error.message);
    }
  }
}

// Each formula of the pages is one that the book displays, with its MathML after it.
const source = readFileSync(PAGES, "utf8");
const written = source.replace(/((?:\/\/ .*\n)+)(pub\(crate\) const \w+: &str = r#")(.*)("#;\n)/g, (_, comment, head, html, end) => {
  const tex = comment.replace(/^\/\/ /gm, "").trimEnd();
  count += 1;
  if (!displayed.has(tex)) fault(PAGES, `the book has no ${tex}`);
  return comment + head + formula(tex, true) + end;
});
if (process.argv.includes("--write")) writeFileSync(PAGES, written);
else if (written !== source) fault(PAGES, "is not what `node docs/check.mjs --write` writes");

console.log(`${count} formulas, ${wrong} wrong`);
process.exit(wrong === 0 && count > 2000 ? 0 : 1);
