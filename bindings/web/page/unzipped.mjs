// What the page holds packed, in LZMA or gzip, and in digits of base 91: the module, and the licences of others.
import { fromLzma } from "./lzma.mjs";

/** The digits: two are 13 bits, from the lowest on. None begins an element, a reference or a comment of HTML. */
export const DIGITS = Array.from({ length: 94 }, (_, k) => String.fromCharCode(33 + k)).filter((digit) => !"<&-".includes(digit)).join("");

/** Returns the checksum of a text of one byte a letter, CRC-32, in 8 hexadecimal digits. */
export function checksum(text) {
  const table = Uint32Array.from({ length: 256 }, (_, rest) => {
    for (let k = 0; k < 8; k++) rest = rest & 1 ? (rest >>> 1) ^ 0xedb88320 : rest >>> 1;
    return rest;
  });
  let rest = -1;
  for (let k = 0; k < text.length; k++) rest = (rest >>> 8) ^ table[(rest ^ text.charCodeAt(k)) & 255];
  return (~rest >>> 0).toString(16).padStart(8, "0");
}

/**
 * Returns what was packed, as a response to read bytes or text from; one that fails where it is not what was packed. A checksum
 * comes first, then the number of bytes to leave out.
 */
export function unzipped(packed) {
  const [sum, text] = [packed.trim().slice(0, 8), packed.trim().slice(8)];
  // LZMA tells of no fault.
  if (sum !== checksum(text)) {
    const failed = () => Promise.reject(new Error("this page is damaged; get it anew"));
    return { arrayBuffer: failed, text: failed };
  }
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
