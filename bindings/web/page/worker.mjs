// The worker: it holds the module, reads files piece by piece, and answers the page's requests one after the other.
import { Stopped, load } from "./module.mjs";
import { unzipped } from "./unzipped.mjs";

let ask = null;
/** Why there is no module. */
let lacking = "this browser does not run the page's WebAssembly; a newer one does";
let files = [];
let bytesRead = 0;
let bytesTold = 0;
let current = null;
const reader = new FileReaderSync();

function readPiece(file, at, length) {
  const piece = new Uint8Array(reader.readAsArrayBuffer(files[file].slice(at, at + length)));
  bytesRead += piece.length;
  if (bytesRead - bytesTold >= 1 << 23) {
    bytesTold = bytesRead;
    postMessage({ id: current, progress: { at: at + piece.length, of: files[file].size } });
  }
  return piece;
}

const listed = () => ({ ask: "files", files: files.map(({ name, size }) => ({ name, length: size })) });

// One at a time, in order.
let queue = Promise.resolve();
onmessage = ({ data }) => {
  queue = queue.then(() => serve(data));
};

async function serve({ id, request, wasm: base64 }) {
  try {
    if (base64 !== undefined) {
      const bytes = await unzipped(base64).arrayBuffer().catch((error) => {
        lacking = error.message;
        throw error;
      });
      ask = await load(bytes, readPiece);
      postMessage({ id, bytes: new Uint8Array() });
      return;
    }
    if (!ask) throw new Error(lacking);
    [current, bytesRead, bytesTold] = [id, 0, 0];
    if (request.ask === "files") ({ files } = request);
    const bytes = ask(request.ask === "files" ? listed() : request);
    postMessage({ id, bytes }, [bytes.buffer]);
  } catch (error) {
    const { message, missingImage = null, field = null } = error;
    postMessage({ id, message, missingImage, field, isOver: error instanceof Stopped });
  }
}
