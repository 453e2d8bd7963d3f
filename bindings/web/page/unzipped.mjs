// What the page holds in gzip and in digits of base 85, of which five are four bytes: the module, and the licences of others.

/** The digits; none begins an element or a reference of HTML. */
export const DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#()*+,./:;=>?@[]^_{|}~";

/** Returns what was packed, as a response to read bytes or text from. The first digit is the number of bytes to leave out. */
export function unzipped(packed) {
  const text = packed.trim();
  const value = new Uint8Array(128);
  for (let k = 0; k < DIGITS.length; k++) value[DIGITS.charCodeAt(k)] = k;
  const words = new DataView(new ArrayBuffer(((text.length - 1) / 5) * 4));
  for (let from = 1, to = 0; from < text.length; from += 5, to += 4) {
    let word = 0;
    for (let k = from; k < from + 5; k++) word = word * 85 + value[text.charCodeAt(k)];
    words.setUint32(to, word);
  }
  const bytes = new Uint8Array(words.buffer, 0, words.byteLength - Number(text[0]));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip")));
}
