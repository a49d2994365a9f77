// The laboratory in a real browser, driven as a person would: `node check.mjs SITE CHROMIUM SHOTS [PART]`, where SITE is the
// folder of the built site, and pictures of pages that fail go to the folder SHOTS. Of the checks those run whose names
// have PART in them.
//
// Each check opens its pages in profiles of their own.

import fs from "node:fs/promises";
import http from "node:http";
import path from "node:path";
import { chromium } from "playwright-core";

const [site, executablePath, folder, part = ""] = process.argv.slice(2);
const PATIENCE = 60_000;

const TYPES = {
  ".css": "text/css",
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript",
  ".png": "image/png",
  ".wasm": "application/wasm",
};
const ISOLATION = {
  "Cross-Origin-Opener-Policy": "same-origin",
  "Cross-Origin-Embedder-Policy": "require-corp",
};

// Serves the site; gives back its address.
function serve(headers) {
  const server = http.createServer(async (request, response) => {
    const name = path.normalize(new URL(request.url, "http://x").pathname);
    try {
      const bytes = await fs.readFile(path.join(site, name));
      const type = TYPES[path.extname(name)] ?? "application/octet-stream";
      response.writeHead(200, { "Content-Type": type, "Cache-Control": "no-cache", ...headers });
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

const isolated = await serve(ISOLATION);
const plain = await serve({});

function assert(condition, what) {
  if (!condition) {
    throw new Error(what);
  }
}

// A page with the laboratory, and hands to use it.
class Laboratory {
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
    await this.page.waitForFunction(() => document.getElementById("cover")?.hidden && self.catoptric, null, { timeout: PATIENCE });
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
      await this.page.waitForTimeout(150);
    }
  }

  async run(command) {
    await this.page.evaluate((name) => self.catoptric.run(name), command);
    await this.settled();
  }

  // Waits until what was done is seen: twice the same, with a finished picture.
  async settled() {
    let before = null;
    await this.until("quiet", (state) => {
      const now = JSON.stringify(state);
      const isQuiet = state.isIdle && now === before;
      before = now;
      return isQuiet;
    });
    return this.state();
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

const BALL = [0.19, 0.47];
const BALL_ASIDE = [0.27, 0.47];

async function moveBall(laboratory) {
  const before = (await laboratory.settled()).scene;
  await laboratory.drag(await laboratory.place(...BALL), await laboratory.place(...BALL_ASIDE));
  await laboratory.until("a moved ball", (state) => state.scene !== before);
  return laboratory.settled();
}

const CHECKS = {
  async "draws with several threads where pages are isolated"(browser) {
    const laboratory = await Laboratory.open(browser, "#example=whitted");
    const state = await laboratory.until("a finished picture", (state) => state.isIdle && state.samples >= 16);
    assert(await laboratory.page.evaluate(() => self.crossOriginIsolated), "the page is not isolated");
    assert(state.threads >= 2, `${state.threads} threads`);
    assert(state.scene.includes("checker"), "another scene than asked for");
    return laboratory;
  },

  async "draws in slices where pages are not isolated"(browser) {
    const laboratory = await Laboratory.open(browser, "", { serviceWorkers: "block" }, plain);
    const state = await laboratory.until("a finished picture", (state) => state.isIdle && state.samples >= 16);
    assert(state.threads === 1, `${state.threads} threads`);
    await moveBall(laboratory);
    return laboratory;
  },

  async "isolates itself on servers that do not"(browser) {
    const laboratory = await Laboratory.open(browser, "", {}, plain);
    const state = await laboratory.until("threads", (state) => state.threads >= 2);
    assert(state.threads >= 2, `${state.threads} threads`);
    return laboratory;
  },

  async "a body is dragged, and that is undone"(browser) {
    const laboratory = await Laboratory.open(browser);
    const before = (await laboratory.state()).scene;
    await moveBall(laboratory);
    await laboratory.page.keyboard.press("Control+z");
    await laboratory.until("the ball back", (state) => state.scene === before);
    return laboratory;
  },

  async "the language changes, and stays changed"(browser) {
    const laboratory = await Laboratory.open(browser);
    assert((await laboratory.state()).language === "english", "not English at first");
    await laboratory.run("window.language.russian");
    await laboratory.until("Russian", (state) => state.language === "russian");
    await laboratory.page.waitForTimeout(1500);
    await laboratory.go();
    await laboratory.until("Russian after a reload", (state) => state.language === "russian");
    return laboratory;
  },

  async "speaks the language of the browser at first"(browser) {
    const laboratory = await Laboratory.open(browser, "", { locale: "ru-RU" });
    await laboratory.until("Russian", (state) => state.language === "russian");
    return laboratory;
  },

  async "a pixel is pinned and audited"(browser) {
    const laboratory = await Laboratory.open(browser, "#example=whitted");
    await laboratory.run("audit.tool");
    await laboratory.page.mouse.click(...(await laboratory.place(0.5, 0.5)));
    const state = await laboratory.until("rays", (state) => state.rays !== null);
    assert(state.pixel !== null && state.rays >= 1, "no pixel");
    return laboratory;
  },

  async "a scene is saved and opened again"(browser) {
    const laboratory = await Laboratory.open(browser);
    const moved = (await moveBall(laboratory)).scene;
    // Without the dialog of the File System Access API, which no script can use.
    await laboratory.page.evaluate(() => delete self.showSaveFilePicker);
    const [download] = await Promise.all([
      laboratory.page.waitForEvent("download", { timeout: PATIENCE }),
      laboratory.page.keyboard.press("Control+s"),
    ]);
    const saved = await fs.readFile(await download.path(), "utf8");
    assert(saved === moved, "what was saved is not the scene");
    assert(download.suggestedFilename().endsWith(".toml"), download.suggestedFilename());
    const other = await Laboratory.open(browser);
    const [chooser] = await Promise.all([
      other.page.waitForEvent("filechooser", { timeout: PATIENCE }),
      other.page.keyboard.press("Control+o"),
    ]);
    await chooser.setFiles({ name: "again.toml", mimeType: "application/toml", buffer: Buffer.from(saved) });
    const state = await other.until("the file", (state) => state.title.startsWith("again"));
    assert(state.scene === saved && state.isSaved, "what was opened is not what was saved");
    await laboratory.close();
    return other;
  },

  async "a link brings everything back"(browser) {
    const laboratory = await Laboratory.open(browser);
    const moved = await moveBall(laboratory);
    await laboratory.run("audit.tool");
    await laboratory.page.mouse.click(...(await laboratory.place(0.5, 0.5)));
    await laboratory.until("rays", (state) => state.rays !== null);
    await laboratory.run("file.copy-link");
    await laboratory.page.waitForTimeout(500);
    const link = await laboratory.page.evaluate(() => navigator.clipboard.readText());
    assert(link.startsWith(isolated), `no link in the clipboard: ${link.slice(0, 80)}`);
    const other = await Laboratory.open(browser, link.slice(link.indexOf("#")));
    const state = await other.until("the rays", (state) => state.rays !== null);
    const wanted = await laboratory.state();
    assert(state.scene === moved.scene, "another scene");
    assert(JSON.stringify([state.pixel, state.selected]) === JSON.stringify([wanted.pixel, wanted.selected]), "another view");
    await laboratory.close();
    return other;
  },

  async "work on a link outlives a reload"(browser) {
    const laboratory = await Laboratory.open(browser);
    await laboratory.run("file.copy-link");
    await laboratory.page.waitForTimeout(500);
    const link = await laboratory.page.evaluate(() => navigator.clipboard.readText());
    const other = await Laboratory.open(browser, link.slice(link.indexOf("#")));
    const moved = (await moveBall(other)).scene;
    await other.until("kept work", (state) => state.isKept);
    await other.page.waitForTimeout(300);
    await other.page.reload();
    await other.shown();
    await other.until("the work", (state) => state.scene === moved);
    return other;
  },

  async "a damaged link is told of"(browser) {
    const laboratory = await Laboratory.open(browser, "#view=abc");
    await laboratory.until("the first example", (state) => state.scene.length > 100);
    return laboratory;
  },

  async "unsaved work outlives a reload"(browser) {
    const laboratory = await Laboratory.open(browser);
    const moved = (await moveBall(laboratory)).scene;
    await laboratory.until("kept work", (state) => state.isKept);
    await laboratory.page.waitForTimeout(300);
    await laboratory.go();
    await laboratory.until("the work", (state) => state.scene === moved);
    return laboratory;
  },

  async "a broken file changes nothing"(browser) {
    const laboratory = await Laboratory.open(browser);
    const before = (await laboratory.state()).scene;
    await laboratory.drop("broken.toml", "format = \u0000 [[[");
    await laboratory.page.waitForTimeout(500);
    assert((await laboratory.state()).scene === before, "the scene has changed");
    return laboratory;
  },

  async "a dropped scene is opened"(browser) {
    const laboratory = await Laboratory.open(browser);
    await laboratory.drop("one.toml", 'format = "catoptric/1"\n\n[[bodies]]\nname = "lonely"\nshape = "sphere"\n');
    await laboratory.until("the scene", (state) => state.scene.includes("lonely"));
    return laboratory;
  },

  async "a lost worker is replaced, and the work comes back"(browser) {
    const laboratory = await Laboratory.open(browser);
    const moved = (await moveBall(laboratory)).scene;
    await laboratory.until("kept work", (state) => state.isKept);
    const studio = laboratory.page.workers().find((worker) => worker.url().endsWith("worker.js"));
    await studio.evaluate(() => self.close()).catch(() => {});
    await laboratory.page.click("#offer-button", { timeout: PATIENCE });
    await laboratory.page.waitForTimeout(500);
    await laboratory.shown();
    await laboratory.until("the work", (state) => state.scene === moved);
    return laboratory;
  },

  async "works without a network after the first visit"(browser) {
    const laboratory = await Laboratory.open(browser);
    await laboratory.page.waitForTimeout(3000);
    await laboratory.context.setOffline(true);
    await laboratory.go("#example=whitted");
    await laboratory.until("a picture", (state) => state.samples > 0);
    return laboratory;
  },

  async "the picture stands alone on somebody's page"(browser) {
    const laboratory = await Laboratory.open(browser, "?embed#example=whitted");
    const state = await laboratory.until("a picture", (state) => state.samples > 0);
    assert(state.viewport[2] >= 1270 && state.viewport[3] >= 790, `the picture has ${state.viewport}`);
    const href = await laboratory.page.getAttribute("#opener", "href");
    assert(href === "studio.html#example=whitted", href);
    return laboratory;
  },

  async "a finger turns the view and taps"(browser) {
    const tablet = { viewport: { width: 820, height: 1180 }, hasTouch: true };
    const laboratory = await Laboratory.open(browser, "", tablet);
    await laboratory.page.touchscreen.tap(...(await laboratory.place(0.19, 0.49)));
    await laboratory.until("a selection", (state) => state.selected.length === 1);
    return laboratory;
  },
};

// Runs one check; gives back its failure, if it fails.
async function run(browser, name, check) {
  const contexts = [];
  const strangers = [];
  const open = {
    async newContext(options) {
      const context = await browser.newContext(options);
      contexts.push(context);
      context.on("request", (request) => {
        const isOwn = [isolated, plain, "blob:"].some((start) => request.url().startsWith(start));
        if (!isOwn) {
          strangers.push(request.url());
        }
      });
      return context;
    },
  };
  let failure = null;
  try {
    await check(open);
    assert(strangers.length === 0, `requests left the page's origin: ${strangers}`);
  } catch (error) {
    failure = error;
  }
  for (const [index, page] of contexts.flatMap((context) => context.pages()).entries()) {
    if (failure || process.env.SHOTS) {
      const file = path.join(folder, `${name.replaceAll(/\W+/g, "-")}-${index}.png`);
      await page.screenshot({ path: file }).catch(() => {});
    }
  }
  await Promise.all(contexts.map((context) => context.close().catch(() => {})));
  return failure;
}

const browser = await chromium.launch({
  executablePath,
  // Also as root and without a graphics card.
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
});
await fs.mkdir(folder, { recursive: true });
let failures = 0;
for (const [name, check] of Object.entries(CHECKS).filter(([name]) => name.includes(part))) {
  const start = Date.now();
  const failure = await run(browser, name, check);
  const seconds = ((Date.now() - start) / 1000).toFixed(1);
  console.log(failure ? `FAILED: ${name} (${seconds} s)\n  ${failure.message}` : `ok: ${name} (${seconds} s)`);
  failures += failure ? 1 : 0;
}
await browser.close();
process.exit(failures > 0 ? 1 : 0);
