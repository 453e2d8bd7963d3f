// What two ways to write a formula in MathML have in common: its signs in their order, with fractions, roots, scripts and
// tables, and without what is a matter of style.

/** The elements of a text of MathML, as a tree of names and texts. */
function tree(mathml) {
  const open = [{ name: "", children: [] }];
  for (const [, end, name, empty, text] of mathml.matchAll(/<(\/?)([a-z]+)[^>]*?(\/?)>|([^<]+)/g)) {
    if (text !== undefined) open.at(-1).children.push(text);
    else if (!end) {
      const child = { name, children: [] };
      open.at(-1).children.push(child);
      if (!empty) open.push(child);
    } else if (open.pop().name !== name) throw new Error(`</${name}> ends another element: ${mathml}`);
  }
  if (open.length !== 1) throw new Error(`an element does not end: ${mathml}`);
  return open[0];
}

function written(element) {
  if (typeof element === "string") return element;
  const parts = element.children.map(written);
  const [base, ...scripts] = parts;
  switch (element.name) {
    // The source; spaces.
    case "annotation":
    case "mspace":
      return "";
    case "msub":
    case "munder":
      return `${base}_(${scripts})`;
    case "msup":
    case "mover": {
      // Primes may stand behind the base or above it.
      const [, primes, above] = /^((?:′|″|‴)*)(.*)$/su.exec(scripts[0]);
      return above === "" ? base + primes : `${base}${primes}^(${above})`;
    }
    case "msubsup":
    case "munderover":
      return `${base}_(${scripts[0]})^(${scripts[1]})`;
    case "mfrac":
      return `(${base})/(${scripts})`;
    case "msqrt":
      return `√(${parts.join("")})`;
    case "mtr":
      return `[${parts.join("&")}]`;
    default:
      return parts.join("");
  }
}

/** Returns the structure of a formula in MathML, without its number, whoever wrote it. */
export function structure(mathml) {
  const references = { lt: "<", gt: ">", amp: "&", nbsp: " " };
  const characters = (text) => text.replace(/&#(\d+);|&(\w+);/g, (_, code, name) => (code ? String.fromCodePoint(code) : references[name]));
  // Letters of other alphabets are those letters; what has no width is nothing.
  const plain = characters(written(tree(mathml.replace(/<span class="tag">[^<]*<\/span>/, "")))).normalize("NFKC").replace(/[\u2061\u200b\s]/gu, "");
  return plain.replace(/∣/gu, "|").replace(/[ˉ\u0304\u0305]/gu, "¯");
}
