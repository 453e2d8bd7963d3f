// A decoder of LZMA, as its specification has it: what browsers bring, gzip, makes the page larger by a fifth.

/** Half, of 2^11: where every probability begins. */
const EVEN = 1 << 10;

/** Decodes bits one after the other, each with a probability that learns. */
class RangeDecoder {
  #bytes;
  #at;
  #range = 0xffffffff;
  #code = 0;

  constructor(bytes, at) {
    [this.#bytes, this.#at] = [bytes, at];
    for (let k = 0; k < 5; k++) this.#code = (this.#code * 256 + bytes[this.#at++]) % 2 ** 32;
  }

  bit(chances, at) {
    const chance = chances[at];
    const bound = (this.#range >>> 11) * chance;
    const is = this.#code >= bound ? 1 : 0;
    if (is) {
      this.#range -= bound;
      this.#code -= bound;
      chances[at] = chance - (chance >> 5);
    } else {
      this.#range = bound;
      chances[at] = chance + ((2048 - chance) >> 5);
    }
    this.#refill();
    return is;
  }

  /** Decodes a number of bits that are as likely as not. */
  even(bits) {
    let value = 0;
    for (let k = 0; k < bits; k++) {
      this.#range >>>= 1;
      const is = this.#code >= this.#range ? 1 : 0;
      if (is) this.#code -= this.#range;
      this.#refill();
      value = value * 2 + is;
    }
    return value;
  }

  /** Decodes a number from its highest bit on, each bit by those before. */
  tree(chances, from, bits) {
    let node = 1;
    for (let k = 0; k < bits; k++) node = (node << 1) | this.bit(chances, from + node);
    return node - (1 << bits);
  }

  /** Decodes a number from its lowest bit on. */
  reversed(chances, from, bits) {
    let [node, value] = [1, 0];
    for (let k = 0; k < bits; k++) {
      const is = this.bit(chances, from + node);
      node = (node << 1) | is;
      value |= is << k;
    }
    return value;
  }

  #refill() {
    if (this.#range >= 2 ** 24) return;
    this.#range *= 256;
    this.#code = this.#code * 256 + this.#bytes[this.#at++];
  }
}

const chances = (count) => new Uint16Array(count).fill(EVEN);

/** Decodes the lengths of what is repeated, less 2. */
class Lengths {
  #choice = chances(2);
  #low = chances(16 * 8);
  #middle = chances(16 * 8);
  #high = chances(256);

  next(decoder, place) {
    if (!decoder.bit(this.#choice, 0)) return decoder.tree(this.#low, place * 8, 3);
    if (!decoder.bit(this.#choice, 1)) return 8 + decoder.tree(this.#middle, place * 8, 3);
    return 16 + decoder.tree(this.#high, 0, 8);
  }
}

/** Returns what a file of LZMA holds: properties, 4 bytes of the dictionary's size, 8 of the length, the code. */
export function fromLzma(bytes) {
  const [lc, lp, pb] = [bytes[0] % 9, Math.floor(bytes[0] / 9) % 5, Math.floor(bytes[0] / 45)];
  const length = new DataView(bytes.buffer, bytes.byteOffset).getUint32(5, true);
  const out = new Uint8Array(length);
  const decoder = new RangeDecoder(bytes, 13);
  const [isMatch, isLong] = [chances(12 * 16), chances(12 * 16)];
  const [isRepeated, isOther, isThird, isFourth] = [chances(12), chances(12), chances(12), chances(12)];
  const literals = chances(0x300 << (lc + lp));
  const [slots, middle, aligned] = [chances(4 * 64), chances(115), chances(16)];
  const [lengths, lengthsOfRepeated] = [new Lengths(), new Lengths()];

  const literal = (at, state, distance) => {
    const before = at > 0 ? out[at - 1] : 0;
    const from = 0x300 * (((at & ((1 << lp) - 1)) << lc) + (before >> (8 - lc)));
    let byte = 1;
    if (state >= 7) {
      for (let other = out[at - distance - 1]; byte < 0x100; other <<= 1) {
        const expected = (other >> 7) & 1;
        const is = decoder.bit(literals, from + ((1 + expected) << 8) + byte);
        byte = (byte << 1) | is;
        if (is !== expected) break;
      }
    }
    while (byte < 0x100) byte = (byte << 1) | decoder.bit(literals, from + byte);
    return byte & 0xff;
  };
  const distanceOf = (size) => {
    const slot = decoder.tree(slots, 64 * Math.min(size, 3), 6);
    if (slot < 4) return slot;
    const bits = (slot >> 1) - 1;
    const start = (2 | (slot & 1)) * 2 ** bits;
    if (slot < 14) return start + decoder.reversed(middle, start - slot, bits);
    return start + decoder.even(bits - 4) * 16 + decoder.reversed(aligned, 0, 4);
  };

  let state = 0;
  let recent = [0, 0, 0, 0];
  for (let at = 0; at < length; ) {
    const place = at & ((1 << pb) - 1);
    if (!decoder.bit(isMatch, state * 16 + place)) {
      out[at] = literal(at, state, recent[0]);
      at += 1;
      state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
      continue;
    }
    let size;
    if (!decoder.bit(isRepeated, state)) {
      size = lengths.next(decoder, place);
      recent = [distanceOf(size), recent[0], recent[1], recent[2]];
      state = state < 7 ? 7 : 10;
    } else {
      let which = 0;
      if (decoder.bit(isOther, state)) which = !decoder.bit(isThird, state) ? 1 : decoder.bit(isFourth, state) ? 3 : 2;
      else if (!decoder.bit(isLong, state * 16 + place)) {
        out[at] = out[at - recent[0] - 1];
        at += 1;
        state = state < 7 ? 9 : 11;
        continue;
      }
      recent.unshift(...recent.splice(which, 1));
      size = lengthsOfRepeated.next(decoder, place);
      state = state < 7 ? 8 : 11;
    }
    for (const end = Math.min(length, at + size + 2); at < end; at++) out[at] = out[at - recent[0] - 1];
  }
  return out;
}
