// The laboratory in a real browser, with hands to use it.

import fs from "node:fs/promises";
import http from "node:http";
import path from "node:path";
import { chromium } from "playwright-core";

// What the scripts are started with: the folder of the built site, the browser, the native program, and a folder for
// what is written.
export const [site, executablePath, program, folder, ...words] = process.argv.slice(2);

// So long everything may take, milliseconds: machines of checks are slow, and busy.
export const PATIENCE = 90_000;

const TYPES = {
  ".css": "text/css",
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript",
  ".png": "image/png",
  ".wasm": "application/wasm",
};
export const ISOLATION = {
  "Cross-Origin-Opener-Policy": "same-origin",
  "Cross-Origin-Embedder-Policy": "require-corp",
};

// Serves the site; gives back its address. `change` may make other bytes of a file; `isPacked` hands out compressed copies,
// as other servers do.
export function serve(headers, { change = (_, bytes) => bytes, isPacked = false } = {}) {
  const server = http.createServer(async (request, response) => {
    const name = path.normalize(new URL(request.url, "http://x").pathname);
    const file = path.join(site, name);
    try {
      const packed = isPacked ? await fs.readFile(`${file}.br`).catch(() => null) : null;
      const bytes = packed ?? change(path.basename(name), await fs.readFile(file));
      const type = TYPES[path.extname(name)] ?? "application/octet-stream";
      const encoding = packed ? { "Content-Encoding": "br" } : {};
      response.writeHead(200, { "Content-Type": type, "Cache-Control": "no-cache", ...encoding, ...headers });
      response.end(bytes);
    } catch {
      response.writeHead(404);
      response.end();
    }
  });
  server.unref();
  return new Promise((resolve) => {
    server.listen(0, "127.0.0.1", () => resolve(`http://127.0.0.1:${server.address().port}/`));
  });
}

export const isolated = await serve(ISOLATION);
export const plain = await serve({});

// The programs of the site, with the number of their bytes; `null` for one that was not built.
export const { programs } = await import(`data:text/javascript,${encodeURIComponent(await fs.readFile(path.join(site, "build.js"), "utf8"))}`);

export function assert(condition, what) {
  if (!condition) {
    throw new Error(what);
  }
}

export function launch() {
  return chromium.launch({
    executablePath,
    // Also as root and without a graphics card, which SwiftShader stands in for.
    args: [
      "--no-sandbox",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      "--ignore-gpu-blocklist",
      "--enable-unsafe-webgpu",
      "--use-webgpu-adapter=swiftshader",
    ],
  });
}

// A page with the laboratory.
export class Laboratory {
  constructor(context, page, address) {
    this.context = context;
    this.page = page;
    this.address = address;
    // What the page wrote to its console.
    this.said = [];
  }

  // Opens the studio's page with what follows its name.
  static async open(browser, rest = "", options = {}, address = isolated) {
    const size = { width: 1280, height: 800 };
    const context = await browser.newContext({ viewport: size, acceptDownloads: true, ...options });
    await context.grantPermissions(["clipboard-read", "clipboard-write"], { origin: new URL(address).origin });
    const laboratory = new Laboratory(context, await context.newPage(), address);
    laboratory.page.on("console", (message) => laboratory.said.push(`${message.type()}: ${message.text()}`));
    await laboratory.go(rest);
    return laboratory;
  }

  async go(rest = "") {
    // Another fragment alone would not load the page again.
    await this.page.goto("about:blank");
    await this.page.goto(new URL(`studio.html${rest}`, this.address).href);
    await this.shown();
  }

  async shown() {
    const isShown = () => document.getElementById("cover")?.hidden && self.catoptric;
    await this.page.waitForFunction(isShown, null, { timeout: PATIENCE });
  }

  state() {
    return this.page.evaluate(() => self.catoptric.state());
  }

  // Waits until the state is so, and gives it back.
  async until(what, condition) {
    const deadline = Date.now() + PATIENCE;
    for (;;) {
      const state = await this.state();
      if (state && condition(state)) {
        return state;
      }
      assert(Date.now() < deadline, `waited in vain: ${what}`);
      await this.page.waitForTimeout(100);
    }
  }

  async run(command) {
    await this.page.evaluate((name) => self.catoptric.run(name), command);
    await this.settled();
  }

  // Waits until what was done is seen: twice the same, with a finished picture.
  async settled() {
    let before = null;
    return this.until("quiet", (state) => {
      const now = JSON.stringify(state);
      const isQuiet = state.isIdle && now === before;
      before = now;
      return isQuiet;
    });
  }

  // What is seen in the window and has this name, as a screen reader would be told.
  widget(name, isMeant = () => true) {
    return this.seen((widget) => (widget.name === name || widget.value === name) && isMeant(widget), name);
  }

  // What is meant of what is seen in the window; waits until it is there and stays where it is.
  async seen(isMeant, what) {
    const deadline = Date.now() + PATIENCE;
    let before = null;
    for (;;) {
      const widgets = (await this.page.evaluate(() => self.catoptric.widgets())) ?? [];
      const found = widgets.find(isMeant);
      if (found && `${found.place}` === before) {
        return found;
      }
      before = `${found?.place}`;
      assert(Date.now() < deadline, `waited in vain: ${what} is not seen`);
      await this.page.waitForTimeout(100);
    }
  }

  // Clicks on what is seen and has this name.
  async press(name, isMeant) {
    const [left, top, width, height] = (await this.widget(name, isMeant)).place;
    await this.page.mouse.click(left + width / 2, top + height / 2);
  }

  // Puts a number into the field of this name, and ends that with a key.
  async fill(name, text, key = "Enter") {
    await this.press(name, (widget) => widget.role === "SpinButton");
    // It becomes a field for text.
    await this.settled();
    await this.page.keyboard.press("Control+a");
    await this.page.keyboard.type(text);
    await this.page.keyboard.press(key);
    await this.settled();
  }

  // A place in the picture, from shares of its width and height.
  async place(x, y) {
    const [left, top, width, height] = (await this.until("a viewport", (state) => state.viewport)).viewport;
    return [left + x * width, top + y * height];
  }

  async drag(from, to, options = {}) {
    const { mouse } = this.page;
    await mouse.move(...from);
    await mouse.down(options);
    const steps = 8;
    for (let step = 1; step <= steps; step++) {
      const share = step / steps;
      await mouse.move(from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1]));
      await this.page.waitForTimeout(30);
    }
    await mouse.up(options);
    await this.settled();
  }

  // Moves fingers along lines, each from a place to another.
  async touch(lines, hold = 0) {
    const session = await this.context.newCDPSession(this.page);
    const tell = (type, share) => {
      const between = (from, to) => from + share * (to - from);
      const touchPoints = lines.map(([from, to], id) => ({ id, x: between(from[0], to[0]), y: between(from[1], to[1]) }));
      return session.send("Input.dispatchTouchEvent", { type, touchPoints: type === "touchEnd" ? [] : touchPoints });
    };
    await tell("touchStart", 0);
    await this.page.waitForTimeout(hold);
    const steps = lines.every(([from, to]) => from === to) ? 0 : 8;
    for (let step = 1; step <= steps; step++) {
      await tell("touchMove", step / steps);
      await this.page.waitForTimeout(30);
    }
    await tell("touchEnd", 1);
    await session.detach();
  }

  // Draws a picture and writes it to a file, unless that is `null`; gives back how long it was traced, milliseconds.
  async draw(order, file) {
    const { bytes, milliseconds } = await this.page.evaluate(async ([order, isKept]) => {
      const { bytes, milliseconds } = await self.catoptric.picture(order);
      if (!isKept) {
        return { milliseconds };
      }
      let text = "";
      for (let at = 0; at < bytes.length; at += 0x8000) {
        text += String.fromCharCode(...bytes.subarray(at, at + 0x8000));
      }
      return { bytes: btoa(text), milliseconds };
    }, [order, file !== null]);
    if (file) {
      await fs.mkdir(path.dirname(file), { recursive: true });
      await fs.writeFile(file, Buffer.from(bytes, "base64"));
    }
    return milliseconds;
  }

  // Drops a file on the page.
  async drop(name, text) {
    await this.page.evaluate(([name, text]) => {
      const dataTransfer = new DataTransfer();
      dataTransfer.items.add(new File([text], name));
      window.dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
    }, [name, text]);
    await this.settled();
  }

  async close() {
    await this.context.close();
  }
}
