// Elements, numbers and files, in few words.

const SVG = "http://www.w3.org/2000/svg";

/** Returns the element of an id. */
export const element = (id) => document.getElementById(id);

/** Creates an element with attributes and children. */
export function make(name, attributes = {}, ...children) {
  return filled(document.createElement(name), attributes, children);
}

/** Creates an element of SVG. */
export function svg(name, attributes = {}, ...children) {
  return filled(document.createElementNS(SVG, name), attributes, children);
}

function filled(made, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (value !== null && value !== false) made.setAttribute(name, value === true ? "" : value);
  }
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

/** Returns a number with thin groups of digits, for counts. */
export const grouped = (count) => String(count).replace(/\B(?=(\d{3})+$)/g, "\u202f");

/** Returns a number to so many decimals; "none" if there is none. */
export const fixed = (x, digits) => (x === null ? "none" : x.toFixed(digits));

/** Returns a number to at most four significant digits. */
export const short = (x) => String(Number(x.toPrecision(4)));

/** Returns a number to at most six significant digits, where it is no result that is compared. */
export const rounded = (x) => String(Number(x.toPrecision(6)));

/** Returns how many there are of something, which has a plural in s. */
export const counted = (count, what) => `${grouped(count)} ${what}${count === 1 ? "" : "s"}`;

/** Hands a file to whoever looks at the page. */
export function save(name, blob) {
  const address = URL.createObjectURL(blob);
  make("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}

/** Returns files that the page holds, from the JSON of an element. */
export function held(id) {
  const parsed = JSON.parse(element(id).textContent);
  return parsed.map(({ name, base64 }) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    return new File([bytes], name);
  });
}

/** Calls `work` once for many calls, with the last arguments, never twice at a time. */
export function latest(work) {
  let running = false;
  let next = null;
  return async function call(...args) {
    next = args;
    if (running) return;
    running = true;
    while (next) {
      const now = next;
      next = null;
      try {
        await work(...now);
      } catch (error) {
        console.error(error);
      }
    }
    running = false;
  };
}
