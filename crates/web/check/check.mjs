// The laboratory in a real browser, driven as a person would: `node check.mjs ADDRESS CHROMIUM FOLDER`, where ADDRESS is
// that of the built site on a server that isolates its pages, and pictures of failures go to FOLDER.
//
// Each check opens a page in a profile of its own.

import fs from "node:fs/promises";
import path from "node:path";
import { chromium } from "playwright-core";

const [address, executablePath, folder, only] = process.argv.slice(2);
const PATIENCE = 60_000;

function assert(condition, what) {
  if (!condition) {
    throw new Error(what);
  }
}

// A page with the laboratory, and hands to use it.
class Laboratory {
  constructor(context, page) {
    this.context = context;
    this.page = page;
  }

  static async open(browser, fragment = "", options = {}) {
    const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, acceptDownloads: true, ...options });
    await context.grantPermissions(["clipboard-read", "clipboard-write"], { origin: new URL(address).origin });
    const laboratory = new Laboratory(context, await context.newPage());
    await laboratory.go(fragment);
    return laboratory;
  }

  async go(fragment = "") {
    await this.page.goto(new URL(`studio.html${fragment}`, address).href);
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
      await this.page.waitForTimeout(50);
    }
  }

  async run(command) {
    await this.page.evaluate((name) => self.catoptric.run(name), command);
    await this.settled();
  }

  // Waits for frames that answer what was done.
  async settled() {
    await this.page.waitForTimeout(300);
    await this.state();
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
  const before = (await laboratory.state()).scene;
  await laboratory.drag(await laboratory.place(...BALL), await laboratory.place(...BALL_ASIDE));
  return laboratory.until("a moved ball", (state) => state.scene !== before);
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
    const laboratory = await Laboratory.open(browser, "?plain", { serviceWorkers: "block" });
    const state = await laboratory.until("a finished picture", (state) => state.isIdle && state.samples >= 16);
    assert(state.threads === 1, `${state.threads} threads`);
    await moveBall(laboratory);
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
    assert(link.startsWith(address), `no link in the clipboard: ${link.slice(0, 80)}`);
    const other = await Laboratory.open(browser, link.slice(link.indexOf("#")));
    const state = await other.until("the rays", (state) => state.rays !== null);
    const wanted = await laboratory.state();
    assert(state.scene === moved.scene, "another scene");
    assert(JSON.stringify([state.pixel, state.selected]) === JSON.stringify([wanted.pixel, wanted.selected]), "another view");
    await laboratory.close();
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
};

const browser = await chromium.launch({
  executablePath,
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
});
let failures = 0;
for (const [name, check] of Object.entries(CHECKS)) {
  if (only && !name.includes(only)) {
    continue;
  }
  const start = Date.now();
  const strangers = [];
  const contexts = new Set();
  const watch = (context) => {
    context.on("request", (request) => {
      if (!request.url().startsWith(address) && !request.url().startsWith("blob:")) {
        strangers.push(request.url());
      }
    });
  };
  const newContext = browser.newContext.bind(browser);
  const watched = new Proxy(browser, {
    get: (target, key) =>
      key === "newContext"
        ? async (options) => {
            const context = await newContext(options);
            contexts.add(context);
            watch(context);
            return context;
          }
        : target[key],
  });
  let error = null;
  try {
    await check(watched);
    assert(strangers.length === 0, `requests left the page's origin: ${strangers}`);
  } catch (failure) {
    error = failure;
    failures += 1;
  }
  const shots = [...contexts].flatMap((context) => context.pages());
  for (const [index, page] of shots.entries()) {
    if (error || process.env.SHOTS) {
      await page.screenshot({ path: path.join(folder, `${name.replaceAll(/\W+/g, "-")}-${index}.png`) }).catch(() => {});
    }
  }
  for (const context of contexts) {
    await context.close().catch(() => {});
  }
  console.log(`${error ? "FAILED" : "ok"}: ${name} (${((Date.now() - start) / 1000).toFixed(1)} s)${error ? `\n  ${error.message}` : ""}`);
}
await browser.close();
process.exit(failures > 0 ? 1 : 0);
