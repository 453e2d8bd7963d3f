// The WebAssembly module behind one function: a request in JSON, an answer in bytes. Node.js and the page's worker share it.

/** A request that was refused: its message is one line. */
export class Refused extends Error {
  constructor({ message, missing_image, field }) {
    super(message);
    this.missingImage = missing_image;
    this.field = field;
  }
}

/** The end of the module: a fault of the program, or no more memory. It answers no more. */
export class Stopped extends Error {}

/**
 * Instantiates the module of these bytes. `readPiece(file, at, length)` returns at most `length` bytes of a file, by its place
 * in the list of the request `files`, from byte `at` on.
 */
export async function load(bytes, readPiece) {
  let fault = null;
  const memory = (at, length) => new Uint8Array(exports.memory.buffer, at >>> 0, length >>> 0);
  const page = {
    read(file, at, into, length) {
      try {
        const piece = readPiece(file, at, length);
        memory(into, piece.length).set(piece);
        return piece.length;
      } catch {
        return -1;
      }
    },
    fault(text, length) {
      fault = new TextDecoder().decode(memory(text, length));
    },
  };
  const { instance: { exports } } = await WebAssembly.instantiate(bytes, { page });

  /** Returns the bytes of the answer; throws `Refused` or `Stopped`. */
  return function ask(request) {
    const { ask: name, ...rest } = request;
    const written = new TextEncoder().encode(JSON.stringify({ [name]: rest }));
    try {
      memory(exports.request(written.length), written.length).set(written);
      const refused = exports.ask();
      const answer = memory(exports.answer(), exports.answer_length()).slice();
      if (!refused) return answer;
      throw new Refused(JSON.parse(new TextDecoder().decode(answer)));
    } catch (error) {
      if (error instanceof Refused) throw error;
      // Rust tells of every fault but of memory that cannot be had.
      throw new Stopped(fault ? `a fault of this page, please report it: ${fault}` : "not enough memory in this browser");
    }
  };
}
