// Writes the formulas of the book in MathML, from the part of TeX that the book has: no network, no font of its own.
//
// Included in every page of the book (src/book/mod.rs); `node docs/check.mjs` holds it to KaTeX, formula by formula.

// The classes of atoms, as in The TeXbook, chapter 18: between them stand its spaces.
const [ORD, OP, BIN, REL, OPEN, CLOSE, PUNCT, INNER] = Array(8).keys();
// For a left class the spaces before each right class: 1 thin, 2 medium, 3 thick; negative ones are not in scripts.
const SPACES = [
  [0, 1, -2, -3, 0, 0, 0, -1],
  [1, 1, 0, -3, 0, 0, 0, -1],
  [-2, -2, 0, 0, -2, 0, 0, -2],
  [-3, -3, 0, 0, -3, 0, 0, -3],
  [0, 0, 0, 0, 0, 0, 0, 0],
  [0, 1, -2, -3, 0, 0, 0, -1],
  [-1, -1, 0, -1, -1, -1, -1, -1],
  [-1, 1, -2, -3, -1, 0, -1, -1],
];
const WIDTHS = ["0", "0.1667em", "0.2222em", "0.2778em"];

const table = (text) => Object.fromEntries(text.trim().split(/\s+/).map((entry) => entry.split("=")));
const LETTERS = table(`alpha=α beta=β gamma=γ delta=δ varepsilon=ε zeta=ζ eta=η theta=θ kappa=κ lambda=λ mu=μ nu=ν xi=ξ pi=π
  rho=ρ sigma=σ tau=τ varphi=φ chi=χ psi=ψ omega=ω`);
const UPRIGHT = table("Gamma=Γ Delta=Δ Omega=Ω infty=∞");
const BINARY = table("cdot=⋅ times=× pm=± mp=∓");
const RELATIONS = table("le=≤ ge=≥ ne=≠ approx=≈ to=→");
const FENCES = table("lvert=| rvert=| lfloor=⌊ rfloor=⌋ {={ }=}");
const INNERS = table("ldots=… cdots=⋯");
const FUNCTIONS = new Set("arctan arg cos cosh exp ln log max min sin tanh".split(" "));
const BIG = table("sum=∑ prod=∏ int=∫ iint=∬");
// Those whose scripts stand below and above them in a displayed formula.
const LIMITS = new Set(["sum", "prod", "max", "min"]);
const MARKS = { bar: "‾", hat: "^" };
const GAPS = { ",": WIDTHS[1], ";": WIDTHS[3], quad: "1em", qquad: "2em" };
const CHARACTERS = {
  "+": [BIN, "+"], "-": [BIN, "−"], "*": [BIN, "∗"], "=": [REL, "="], "<": [REL, "<"], ">": [REL, ">"], ":": [REL, ":"],
  "(": [OPEN, "("], "[": [OPEN, "["], ")": [CLOSE, ")"], "]": [CLOSE, "]"], "!": [CLOSE, "!"],
  ",": [PUNCT, ","], ";": [PUNCT, ";"], "|": [ORD, "|"], "/": [ORD, "/"],
};
const SCRIPTS = { E: "ℰ", L: "ℒ", R: "ℛ", H: "ℋ", I: "ℐ", B: "ℬ", F: "ℱ", M: "ℳ" };

// No tag is written out below: rustdoc would take it for one of its page.
const tagged = (name, content, attributes = "") => `<${name}${attributes && ` ${attributes}`}>${content}</${name}>`;
const escaped = (text) => text.replace(/[&<>]/g, (character) => `&#${character.charCodeAt(0)};`);
const identifier = (text) => tagged("mi", text);
const upright = (text) => tagged("mi", text, 'mathvariant="normal"');
const space = (width) => tagged("mspace", "", `width="${width}"`);
const operator = (sign, stretchy = false) => tagged("mo", escaped(sign), `stretchy="${stretchy}" lspace="0" rspace="0"`);
const group = (parts) => (parts.length === 1 ? parts[0] : tagged("mrow", parts.join("")));

/** What the argument of a command that changes letters becomes. */
const ALPHABETS = {
  mathrm: (text) => (text.length === 1 ? upright(text) : identifier(text)),
  mathtt: (text) => tagged("mi", text, 'class="code" mathvariant="normal"'),
  mathcal: (text) => identifier(SCRIPTS[text] ?? String.fromCodePoint(0x1d49c + text.charCodeAt(0) - 65)),
};

class Parser {
  constructor(tex) {
    const found = [...tex.matchAll(/\\(?:[a-zA-Z]+|.)|[0-9]+(?:\.[0-9]+)?|\S/gsu)];
    this.tokens = found.map(([token]) => token);
    this.places = found.map(({ index }) => index);
    this.source = tex;
    this.at = 0;
    this.tag = null;
  }

  next() {
    if (this.at === this.tokens.length) throw new Error(`${this.source}: ends too early`);
    return this.tokens[this.at++];
  }

  expect(token) {
    const found = this.next();
    if (found !== token) throw new Error(`${this.source}: ${found} where ${token} is due`);
  }

  /** The text in braces, without a look into it. */
  text() {
    // Spaces count in it, which no token has.
    const text = /^\{([^{}]*)\}/.exec(this.source.slice(this.places[this.at]))?.[1];
    if (text === undefined) throw new Error(`${this.source}: no text in braces`);
    while (this.next() !== "}");
    return text;
  }

  /** The atoms up to one of these tokens, which stays; each with its class and its MathML. */
  list(ends, style, first = null) {
    const atoms = first === null ? [] : [{ kind: first, mathml: "" }];
    while (this.at < this.tokens.length && !ends.includes(this.tokens[this.at])) atoms.push(this.scripted(style));
    return atoms;
  }

  /** The elements of a list, with the spaces between its atoms; split for `pieces` after each relation and binary sign. */
  spaced(atoms, style, pieces = null) {
    const seen = atoms.filter((atom) => atom.kind !== null);
    seen.forEach((atom, k) => {
      const [before, after] = [seen[k - 1]?.kind ?? OPEN, seen[k + 1]?.kind ?? CLOSE];
      const alone = [OP, BIN, REL, OPEN, PUNCT].includes(before) || [REL, CLOSE, PUNCT].includes(after);
      if (atom.kind === BIN && alone) atom.kind = ORD;
    });
    let [parts, last] = [[], null];
    for (const { kind, mathml } of atoms) {
      if (kind !== null && last !== null) {
        const between = SPACES[last][kind];
        if (between > 0 || (between < 0 && style !== "script")) parts.push(space(WIDTHS[Math.abs(between)]));
        if (pieces && (last === BIN || last === REL)) {
          pieces.push(parts);
          parts = [];
        }
      }
      last = kind ?? last;
      if (mathml !== "") parts.push(mathml);
    }
    return parts;
  }

  /** What stands up to an end, in one element. */
  inner(end, style) {
    const parts = this.spaced(this.list([end], style), style);
    this.expect(end);
    return group(parts);
  }

  /** The argument of a command or a script: a group, or one atom; of a number its first digit. */
  argument(style) {
    const token = this.tokens[this.at];
    if (/^[0-9]./.test(token)) {
      this.tokens[this.at] = token.slice(1);
      return tagged("mn", token[0]);
    }
    if (token !== "{") return this.atom(style).mathml;
    this.next();
    return this.inner("}", style);
  }

  /** An atom with its scripts. */
  scripted(style) {
    const base = this.atom(style);
    let [within, below, above] = [base.mathml, null, null];
    while (/^[_^']$/.test(this.tokens[this.at])) {
      const mark = this.next();
      // As large as what it stands behind: fonts have it raised and small already.
      if (mark === "'") within = group([within, operator("′")]);
      else if (mark === "_") below = this.argument("script");
      else above = this.argument("script");
    }
    if (below === null && above === null) return { ...base, mathml: within };
    const [low, high] = base.limits && style === "display" ? ["under", "over"] : ["sub", "sup"];
    const name = `m${below === null ? "" : low}${above === null ? "" : high}`;
    return { kind: base.kind, mathml: tagged(name, within + (below ?? "") + (above ?? "")) };
  }

  atom(style) {
    const token = this.next();
    if (token === "{") return { kind: ORD, mathml: this.inner("}", style) };
    if (token.startsWith("\\")) return this.command(token.slice(1), style);
    if (/^[0-9]/.test(token)) return { kind: ORD, mathml: tagged("mn", token) };
    if (/^[a-zA-Z]$/.test(token)) return { kind: ORD, mathml: identifier(token) };
    if (token === "°") return { kind: ORD, mathml: upright(token) };
    if (!Object.hasOwn(CHARACTERS, token)) throw new Error(`${this.source}: ${token} has no MathML`);
    const [kind, sign] = CHARACTERS[token];
    return { kind, mathml: operator(sign) };
  }

  command(name, style) {
    const has = (names) => Object.hasOwn(names, name);
    const smaller = style === "display" ? "text" : "script";
    if (has(LETTERS)) return { kind: ORD, mathml: identifier(LETTERS[name]) };
    if (has(UPRIGHT)) return { kind: ORD, mathml: upright(UPRIGHT[name]) };
    if (has(BINARY)) return { kind: BIN, mathml: operator(BINARY[name]) };
    if (has(RELATIONS)) return { kind: REL, mathml: operator(RELATIONS[name]) };
    if (has(FENCES)) return { kind: /^[l{]/.test(name) ? OPEN : CLOSE, mathml: operator(FENCES[name]) };
    if (has(INNERS)) return { kind: INNER, mathml: operator(INNERS[name]) };
    if (has(GAPS)) return { kind: null, mathml: space(GAPS[name]) };
    if (has(BIG)) return { kind: OP, limits: LIMITS.has(name), mathml: tagged("mo", BIG[name], 'lspace="0" rspace="0"') };
    if (FUNCTIONS.has(name)) return { kind: OP, limits: LIMITS.has(name), mathml: identifier(name) };
    if (has(ALPHABETS)) return { kind: ORD, mathml: ALPHABETS[name](this.tokens[this.at] === "{" ? this.text() : this.next()) };
    if (has(MARKS)) {
      const mark = operator(MARKS[name], name === "bar");
      return { kind: ORD, mathml: tagged("mover", this.argument(style) + mark, `class="${name}" accent="true"`) };
    }
    switch (name) {
      case "frac":
        return { kind: ORD, mathml: tagged("mfrac", this.argument(smaller) + this.argument(smaller)) };
      case "tfrac": {
        const fraction = tagged("mfrac", this.argument("script") + this.argument("script"));
        return { kind: ORD, mathml: tagged("mstyle", fraction, 'displaystyle="false"') };
      }
      case "cfrac": {
        const part = () => tagged("mstyle", this.argument("display"), 'displaystyle="true" scriptlevel="0"');
        return { kind: ORD, mathml: tagged("mfrac", part() + part()) };
      }
      case "sqrt":
        return { kind: ORD, mathml: tagged("msqrt", this.argument(style)) };
      case "text":
        return { kind: ORD, mathml: tagged("mtext", escaped(this.text()).replace(/^ | $/g, "\u00a0")) };
      case "left": {
        const open = this.fence();
        const inside = this.spaced(this.list(["\\right"], style), style);
        this.expect("\\right");
        return { kind: INNER, mathml: group([open, ...inside, this.fence()].filter((part) => part !== "")) };
      }
      case "begin":
        return this.rows(this.text(), style);
      case "tag":
        this.tag = this.text();
        return { kind: null, mathml: "" };
      default:
        throw new Error(`${this.source}: \\${name} has no MathML`);
    }
  }

  /** A fence that grows with what it encloses; a dot is none. */
  fence() {
    const token = this.next();
    const sign = FENCES[token.replace(/^\\/, "")] ?? (/^[()[\]|]$/.test(token) ? token : null);
    if (token === ".") return "";
    if (sign === null) throw new Error(`${this.source}: ${token} is no fence`);
    return operator(sign, true);
  }

  /** An environment: rows of cells. */
  rows(name, style) {
    if (name !== "aligned" && name !== "cases") throw new Error(`${this.source}: ${name} has no MathML`);
    const within = name === "aligned" ? "display" : "text";
    const [rows, cells] = [[], []];
    for (let end = null; end !== "\\end"; ) {
      // After the sign of alignment a relation is one between two sides.
      const first = name === "aligned" && cells.length % 2 === 1 ? ORD : null;
      const parts = this.spaced(this.list(["&", "\\\\", "\\end"], within, first), within);
      cells.push(tagged("mtd", parts.join("")));
      end = this.next();
      if (end !== "&") rows.push(tagged("mtr", cells.splice(0).join("")));
    }
    if (this.text() !== name) throw new Error(`${this.source}: ${name} has another end`);
    if (name === "cases") return { kind: INNER, mathml: group([operator("{", true), tagged("mtable", rows.join(""), 'class="cases"')]) };
    return { kind: ORD, mathml: tagged("mtable", rows.join(""), 'class="aligned" displaystyle="true"') };
  }
}

/** Returns a formula as HTML: displayed with its number, or in a line, which may break after a relation or a binary sign. */
export function formula(tex, displayed) {
  const parser = new Parser(tex);
  const style = displayed ? "display" : "text";
  const pieces = [];
  pieces.push(parser.spaced(parser.list([], style), style, displayed ? null : pieces));
  const maths = pieces.map((parts) => tagged("math", parts.join(""), displayed ? 'display="block"' : ""));
  // A space of no width, at which a line may end.
  if (!displayed) return maths.join("\u200b");
  const tag = parser.tag === null ? "" : tagged("span", `(${parser.tag})`, 'class="tag"');
  return tagged("div", maths.join("") + tag, 'class="formula"');
}
