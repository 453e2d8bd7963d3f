// Packs what the page holds, for page/unzipped.mjs.
import { spawnSync } from "node:child_process";
import { gzipSync } from "node:zlib";
import { DIGITS, checksum } from "./page/unzipped.mjs";

/** Returns bytes in LZMA, whose head tells their number; `null` where there is no xz. */
export function inLzma(bytes) {
  const { status, stdout } = spawnSync("xz", ["--format=lzma", "-9e", "--stdout"], { input: bytes, maxBuffer: 1 << 28 });
  if (status !== 0) return null;
  // xz leaves the number out, and marks the end.
  stdout.writeBigUInt64LE(BigInt(bytes.length), 5);
  return stdout;
}

/** Returns bytes in gzip, which is larger by a third. */
export const inGzip = (bytes) => gzipSync(bytes, { level: 9 });

/** Returns packed bytes as digits, after a checksum and the number of bytes that these hold too many. */
export function inDigits(zipped) {
  let [text, bits, held] = ["", 0, 0];
  const put = () => {
    text += DIGITS[(bits & 8191) % 91] + DIGITS[Math.floor((bits & 8191) / 91)];
    [bits, held] = [bits >>> 13, held - 13];
  };
  for (const byte of zipped) {
    bits |= byte << held;
    held += 8;
    if (held >= 13) put();
  }
  if (held > 0) put();
  text = Math.floor((text.length / 2) * 13 / 8) - zipped.length + text;
  return checksum(text) + text;
}

/** Packs bytes as small as can be had. */
export function packed(bytes) {
  return inDigits(inLzma(Buffer.from(bytes)) ?? inGzip(bytes));
}
