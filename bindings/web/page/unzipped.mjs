// What the page holds packed, in LZMA or gzip, and in digits of base 91: the module, and the licences of others.
import { fromLzma } from "./lzma.mjs";

/** The digits: two are 13 bits, from the lowest on. None begins an element, a reference or a comment of HTML. */
export const DIGITS = Array.from({ length: 94 }, (_, k) => String.fromCharCode(33 + k)).filter((digit) => !"<&-".includes(digit)).join("");

/** Returns what was packed, as a response to read bytes or text from. The first digit is the number of bytes to leave out. */
export function unzipped(packed) {
  const text = packed.trim();
  const value = new Uint8Array(128);
  for (let k = 0; k < DIGITS.length; k++) value[DIGITS.charCodeAt(k)] = k;
  const bytes = new Uint8Array(Math.floor(((text.length - 1) / 2) * 13 / 8) - Number(text[0]));
  let [bits, held] = [0, 0];
  for (let from = 1, to = 0; from < text.length; from += 2) {
    bits |= (value[text.charCodeAt(from)] + 91 * value[text.charCodeAt(from + 1)]) << held;
    for (held += 13; held >= 8; held -= 8, bits >>>= 8) bytes[to++] = bits & 255;
  }
  // The mark of gzip, which was taken where the page was built without xz.
  if (bytes[0] !== 0x1f) return new Response(fromLzma(bytes));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip")));
}
