// The studio's files in the browser's database, across reloads and crashes.
//
// Each page has a name of its own, and holds a lock of that name while it lives, so that what it keeps of unsaved work is
// not taken for something left behind by others.

const DATABASE = "catoptric";
const FILES = "files";
const RECOVERY = "/catoptric/recovery/";
const LOCK = "catoptric page ";

function result(request) {
  return new Promise((resolve, reject) => {
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
}

function open() {
  const request = indexedDB.open(DATABASE, 1);
  request.onupgradeneeded = () => request.result.createObjectStore(FILES, { keyPath: "path" });
  return result(request);
}

async function livingPages() {
  if (!navigator.locks) {
    return new Set();
  }
  const { held } = await navigator.locks.query();
  return new Set(held.map((lock) => lock.name));
}

export class Store {
  #database = null;
  // A number that no other page has.
  page = crypto.getRandomValues(new Uint32Array(1))[0];
  #owner = LOCK + this.page;
  // What is kept, in case that the database fails.
  #files = new Map();

  // Whether the browser keeps anything.
  get isLasting() {
    return this.#database !== null;
  }

  async open() {
    navigator.locks?.request(this.#owner, () => new Promise(() => {}));
    try {
      this.#database = await open();
      const living = await livingPages();
      const files = await result(this.#database.transaction(FILES).objectStore(FILES).getAll());
      for (const { path, bytes, owner } of files) {
        if (!path.startsWith(RECOVERY) || !living.has(owner)) {
          this.#files.set(path, bytes);
        }
      }
    } catch (error) {
      console.warn("Nothing can be kept:", error);
      this.#database = null;
    }
  }

  files() {
    return [...this.#files];
  }

  // Keeps a file, or removes it for `null`.
  async keep(path, bytes) {
    if (bytes) {
      this.#files.set(path, bytes);
    } else {
      this.#files.delete(path);
    }
    if (!this.#database) {
      return;
    }
    const files = this.#database.transaction(FILES, "readwrite").objectStore(FILES);
    try {
      await result(bytes ? files.put({ path, bytes, owner: this.#owner }) : files.delete(path));
    } catch (error) {
      console.warn("A file cannot be kept:", path, error);
    }
  }
}
