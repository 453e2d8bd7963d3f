// The worker: it holds the module, reads files piece by piece, and answers the page's requests one after the other.
import { Stopped, load } from "./module.mjs";
import { unzipped } from "./unzipped.mjs";

let ask = null;
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
    if (base64) {
      ask = await load(await unzipped(base64).arrayBuffer(), readPiece);
      postMessage({ id, bytes: new Uint8Array() });
      return;
    }
    if (!ask) throw new Error("this browser does not run the page's WebAssembly; a newer one does");
    [current, bytesRead, bytesTold] = [id, 0, 0];
    if (request.ask === "files") ({ files } = request);
    const bytes = ask(request.ask === "files" ? listed() : request);
    postMessage({ id, bytes }, [bytes.buffer]);
  } catch (error) {
    postMessage({ id, message: error.message, missingImage: error.missingImage ?? null, isOver: error instanceof Stopped });
  }
}
