// What rustdoc's pages of the book need beside their HTML: figures, formulas (by `formula`, which stands above this in the
// page), and a sign at tables that are wider than the page. Without it the source of each formula stays.

for (const figure of document.querySelectorAll("script[data-figure]")) {
  const image = document.querySelector(`img[src="${figure.dataset.figure}"]`);
  if (image) image.src = "data:image/svg+xml," + encodeURIComponent(figure.text.trim());
}

// Rustdoc lists the chapters by the alphabet; here they stand in the order of reading.
const order = document.querySelector("[data-chapters]")?.dataset.chapters.split(" ") ?? [];
const chapter = (item) => order.indexOf(item.textContent.trim());
for (const list of document.querySelectorAll(".sidebar ul.mod")) {
  list.append(...[...list.children].sort((one, other) => chapter(one) - chapter(other)));
}

// A browser that knows no MathML would run the parts of a formula together: it shows the source.
const typeset = typeof MathMLElement === "undefined" ? null : formula;
const made = (name, html) => Object.assign(document.createElement(name), { innerHTML: html });
for (const source of document.querySelectorAll("pre.language-math")) {
  if (typeset) source.closest(".example-wrap").replaceWith(...made("div", typeset(source.textContent, true)).children);
}
for (const source of document.querySelectorAll(".docblock code")) {
  const before = source.previousSibling, after = source.nextSibling;
  if (before?.nodeName !== "#text" || after?.nodeName !== "#text") continue;
  if (!before.data.endsWith("$") || !after.data.startsWith("$")) continue;
  // The dollars go in any case; the punctuation that follows stays in the line of the formula.
  const [mark, stop] = /^\$([.,;:?!)]*)/.exec(after.data);
  before.data = before.data.slice(0, -1);
  after.data = after.data.slice(mark.length);
  const place = made("span", typeset ? typeset(source.textContent, false) : source.outerHTML);
  place.append(stop);
  source.replaceWith(place);
  // A short formula stays in one line.
  place.style.whiteSpace = "nowrap";
  if (place.offsetWidth > place.parentElement.clientWidth / 3) place.style.whiteSpace = "";
}

/** Marks a table by whether there is more of it to the right, and lets the keyboard reach what scrolls. */
function mark(box) {
  const hidden = box.scrollWidth - box.clientWidth;
  box.classList.toggle("wide", hidden > 1);
  box.classList.toggle("more", hidden - box.scrollLeft > 1);
  if (hidden > 1) box.tabIndex = 0;
  else box.removeAttribute("tabindex");
}
const boxes = new ResizeObserver((entries) => entries.forEach(({ target }) => mark(target)));
for (const box of document.querySelectorAll(".docblock div:has(> table), .docblock .formula")) {
  box.addEventListener("scroll", () => mark(box), { passive: true });
  boxes.observe(box);
}
