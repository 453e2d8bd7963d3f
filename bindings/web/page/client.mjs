// The page's side of the worker: requests that answer with a promise.
import { element } from "./parts.mjs";

/** A request that was refused, or that stopped the module. */
class Refusal extends Error {
  constructor({ message, missingImage, field }) {
    super(message);
    this.missingImage = missingImage;
    this.field = field;
  }
}

export class Client {
  #worker = null;
  #waiting = new Map();
  #last = 0;
  /** The requests whose effects a new worker is to have, too: the files, and the maps that were measured. */
  #effects = [];
  /** Called with the part that is done, from 0 to 1. */
  progress = () => {};

  constructor() {
    this.start();
  }

  start() {
    const source = new Blob([element("worker").textContent], { type: "text/javascript" });
    const address = URL.createObjectURL(source);
    this.#worker = new Worker(address);
    this.#worker.onmessage = ({ data }) => this.#hear(data);
    this.#worker.onerror = ({ message }) => this.#fail(message || "this browser does not start the page's worker");
    const begin = [{ wasm: element("wasm").textContent.trim() }, ...this.#effects.map((request) => ({ request }))];
    for (const message of begin) this.#send(message).catch(() => {});
  }

  /** Ends what the worker does, and begins anew; what waits for it is refused. */
  stop(message = "stopped") {
    this.#worker.terminate();
    this.#fail(message);
    this.start();
  }

  #fail(message) {
    const waiting = [...this.#waiting.values()];
    this.#waiting.clear();
    for (const { reject } of waiting) reject(new Refusal({ message, missingImage: null }));
  }

  #hear({ id, bytes, progress, isOver, ...refusal }) {
    if (progress) {
      this.progress(progress.of > 0 ? progress.at / progress.of : 0);
      return;
    }
    const waiting = this.#waiting.get(id);
    this.#waiting.delete(id);
    if (!waiting) return;
    if (bytes) waiting.resolve(bytes);
    else waiting.reject(new Refusal(refusal));
    if (isOver) this.stop(refusal.message);
  }

  #send(message) {
    const id = ++this.#last;
    const answer = new Promise((resolve, reject) => this.#waiting.set(id, { resolve, reject }));
    this.#worker.postMessage({ id, ...message });
    return answer;
  }

  /** Answers with bytes. */
  async ask(request) {
    const isReplaced = ({ ask, name }) => (request.ask === "forget" ? ask === "measure" : ask === request.ask && name === request.name);
    // Each stays in its place; what is refused or stopped leaves none, as in the module.
    const before = this.#effects.findIndex(isReplaced);
    const others = (effects) => effects.filter((effect) => !isReplaced(effect));
    const after = this.#effects.slice(before < 0 ? this.#effects.length : before + 1);
    this.#effects = others(this.#effects);
    if (request.ask === "files") this.#effects.unshift(request);
    const bytes = await this.#send({ request });
    if (request.ask === "measure") {
      const at = this.#effects.findIndex((effect) => after.includes(effect));
      this.#effects.splice(at < 0 ? this.#effects.length : at, 0, request);
    }
    return bytes;
  }

  async text(request) {
    return new TextDecoder().decode(await this.ask(request));
  }

  async json(request) {
    return JSON.parse(await this.text(request));
  }
}
