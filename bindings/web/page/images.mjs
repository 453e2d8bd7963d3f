// Images of ROS maps: the descriptions that name them, and the form for those that none describes.
import { element, make } from "./parts.mjs";

const IMAGE = /\.(pgm|png|bmp|ppm|pbm|pnm|pam|jpe?g|tiff?|gif|webp|tga)$/i;

/** Tells whether a file is an image by its name. */
export const isImage = (name) => IMAGE.test(name);

const DEFAULTS = { resolution: "0.05", occupied_thresh: "0.65", free_thresh: "0.196", mode: "trinary", negate: "0" };

export class Images {
  #client;
  /** The image that each description names, by the text of small files: what else is in them their reader tells. */
  #named = new Map();
  /** What the form said, by the name of the description made of it. */
  #made = new Map();
  /** The images that were found to be readable. */
  #readable = new Set();

  constructor(client) {
    this.#client = client;
    const { mode, unknown } = element("describe").elements;
    const change = () => {
      unknown.disabled = mode.value !== "probability";
      element("describe-unknown").hidden = unknown.disabled;
    };
    mode.addEventListener("change", change);
    change();
  }

  forget() {
    for (const held of [this.#named, this.#made, this.#readable]) held.clear();
    element("describe").hidden = true;
  }

  /** Returns the name of the image that a description names. */
  of(description) {
    return this.#named.get(description);
  }

  /** Returns the image that was described in the form under this name, its mode and its unknown grey. */
  made(description) {
    return this.#made.get(description);
  }

  /** Returns the descriptions that name one of these images. */
  describing(images) {
    return [...this.#named].filter(([, image]) => images.includes(image)).map(([name]) => name);
  }

  async learn(files) {
    for (const [name, file] of files) {
      if (!/\.ya?ml$/i.test(name) || file.size > 1 << 20) continue;
      const named = /^\s*image\s*:\s*["']?([^"'#\n\r]*)/m.exec(await file.text())?.[1]?.trim();
      if (named) this.#named.set(name, named.split(/[\\/]/).pop());
      else this.#named.delete(name);
    }
  }

  /**
   * Offers to describe the images that no file describes, and that the form did not describe so that they are among the
   * measured; `refuse` hears of those given now that cannot be read.
   */
  async offer(files, given, measured, refuse) {
    const described = new Set([...this.#named].filter(([name]) => !this.#made.has(name) || measured.has(name)).map(([, image]) => image));
    const alone = [...files.keys()].filter((name) => isImage(name) && !described.has(name));
    const list = (more) => this.#client.ask({ ask: "files", files: [...files.values(), ...more] });
    for (const name of alone.filter((name) => given.includes(name))) {
      const tried = this.#file(name, "tried", DEFAULTS);
      try {
        await list([tried]);
        await this.#client.ask({ ask: "check", name: tried.name });
        this.#readable.add(name);
      } catch ({ message }) {
        this.#readable.delete(name);
        // Nobody gave the description that was tried.
        refuse(message.replace(` (the image that ${tried.name} names)`, ""));
      } finally {
        await list([]);
      }
    }
    const offered = alone.filter((name) => this.#readable.has(name));
    element("describe").hidden = !offered.length;
    element("described").replaceChildren(...offered.map((name) => make("option", {}, name)));
    return offered;
  }

  /** Returns the description that the form says; its name is no other file's. */
  describe() {
    const form = Object.fromEntries(new FormData(element("describe")));
    // The files' own modes are three; the fourth is asked of their reader.
    const isProbability = form.mode === "probability";
    const file = this.#file(form.image, "described", { ...form, mode: isProbability ? "trinary" : form.mode });
    this.#made.set(file.name, { image: form.image, ...(isProbability ? { mode: form.mode, unknown: form.unknown?.trim() ?? "" } : {}) });
    return file;
  }

  #file(image, what, values) {
    const lines = Object.keys(DEFAULTS).map((name) => `${name}: ${values[name]}`);
    return new File([`image: ${image}\norigin: [0, 0, 0]\n${lines.join("\n")}\n`], `${image}.${what}.yaml`);
  }
}
