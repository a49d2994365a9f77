// The laboratory in a real browser, driven as a person would: `node check.mjs SITE CHROMIUM PROGRAM FOLDER [PART]`, where SITE
// is the folder of the built site, PROGRAM the native one, and pictures of pages that fail go to FOLDER. Of the checks those
// run whose names have PART in them.
//
// Each check opens its pages in profiles of their own. One that fails is tried once more.

import { execFile } from "node:child_process";
import fs from "node:fs/promises";
import path from "node:path";
import { promisify } from "node:util";
import { ISOLATION, Laboratory, PATIENCE, assert, folder, isolated, launch, plain, program, programs, serve, words } from "./laboratory.mjs";

const [part = ""] = words;
const hasThreads = Boolean(programs.threads);

const BALL = [0.19, 0.47];
const BALL_ASIDE = [0.27, 0.47];

// A scene of miniRT with a shadow.
const BALLS = `R 64 48
A 0.2 255,255,255
C 0,0,6 0,0,-1 50
L 2,6,6 0.7 255,255,255
sp -0.6,-0.4,0 3 255,102,51
sp 0.6,1.6,2 0.8 51,102,255
`;

async function moveBall(laboratory) {
  const before = (await laboratory.settled()).scene;
  await laboratory.drag(await laboratory.place(...BALL), await laboratory.place(...BALL_ASIDE));
  await laboratory.until("a moved ball", (state) => state.scene !== before);
  return laboratory.settled();
}

// Runs the native program; gives back what it prints. Statuses above 1 are faults.
async function run(...words) {
  try {
    return (await promisify(execFile)(program, words)).stdout;
  } catch (error) {
    assert(error.code === 1 && error.stdout, `${program} ${words.join(" ")}: ${error.message}`);
    return error.stdout;
  }
}

// The largest share of pixels in which two pictures may differ by more than so much.
const LIMITS = { body: { tolerance: "2/255", share: 0.0005 }, light: { tolerance: "1/255", share: 0.001 } };

// Compares what the browser draws with the native program, for every built-in scene.
async function comparePictures(laboratory, name) {
  const examples = (await run("examples")).split("\n").map((line) => line.match(/^\s*([\w-]+)/)?.[1]).filter(Boolean);
  assert(examples.length >= 20, `${examples.length} examples`);
  const shares = [];
  const size = { width: 160, height: 90 };
  for (const example of examples) {
    const file = (kind, picture) => path.join(folder, "pictures", kind, `${example}${picture}`);
    await laboratory.draw({ ...size, example, format: "exr" }, file(name, ".exr"));
    await laboratory.draw({ ...size, example, layer: "body" }, file(name, "-body.png"));
    await fs.mkdir(path.join(folder, "pictures", "native"), { recursive: true });
    await run("render", example, "--size", "160x90", "--quiet", "-o", file("native", ".exr"));
    const layers = ["--method", "ssr", "--layers", file("native", "")];
    await run("render", example, "--size", "160x90", "--quiet", ...layers, "-o", file("native", "-ssr.exr"));
    const pairs = [
      ["light", file(name, ".exr"), file("native", ".exr")],
      ["body", file(name, "-body.png"), path.join(file("native", ""), "body.png")],
    ];
    for (const [kind, ours, native] of pairs) {
      const { tolerance, share } = LIMITS[kind];
      const told = JSON.parse(await run("diff", ours, native, "--json", "--tolerance", tolerance));
      shares.push(told.share_above);
      assert(told.share_above <= share, `${example}, ${kind}: ${told.share_above} of the pixels differ, largest ${told.max}`);
    }
  }
  console.log(`  ${name}: ${examples.length} scenes, at most ${Math.max(...shares)} of the pixels differ`);
}

// Has a software driver draw by WebGPU before and after a change, and holds its pictures against the processor's. They are
// small: SwiftShader is a hundred times slower than the processor.
async function drawByCard(browser, example, options, address) {
  const device = { viewport: { width: 240, height: 160 }, ...options };
  const laboratory = await Laboratory.open(browser, `?embed#example=${example}`, device, address);
  const shoot = async (backend, change) => {
    const isFinished = (state) => state.isIdle && state.samples >= 16 && state.backend === backend;
    await laboratory.until(`a picture by the ${backend}`, isFinished);
    await laboratory.settled();
    const file = path.join(folder, `card-${example}-${backend}-${change}.png`);
    // The button to the laboratory is left out.
    await laboratory.page.screenshot({ path: file, clip: { x: 0, y: 0, width: 240, height: 110 } });
    return file;
  };
  const { backend } = await laboratory.until("a card", (state) => state.card);
  assert(backend !== "GPU", "a software driver draws though nobody asked for it");
  const before = await shoot("CPU", "before");
  await laboratory.run("view.projection");
  const after = await shoot("CPU", "after");
  await laboratory.run("view.card");
  const pairs = [[await shoot("GPU", "after"), after]];
  await laboratory.run("edit.undo");
  pairs.push([await shoot("GPU", "before"), before]);
  for (const pair of pairs) {
    const { share_above } = JSON.parse(await run("diff", ...pair, "--json", "--tolerance", "2/255"));
    assert(share_above <= 0.002, `${pair[0]}: ${share_above} of the pixels differ`);
    console.log(`  ${path.basename(pair[0])}: ${share_above} of the pixels differ`);
  }
  await laboratory.run("view.card");
  await shoot("CPU", "again");
}

// The same site in two versions: the second one has another service worker, and says so in the title of its page.
async function serveVersions() {
  let version = 1;
  const change = (name, bytes) => {
    if (version === 1 || !["service-worker.js", "studio.html"].includes(name)) {
      return bytes;
    }
    const text = bytes.toString().replace(/"catoptric " \+ "\w+"/, '"catoptric the second"');
    return Buffer.from(text.replace("<title>Catoptric</title>", '<title>Catoptric</title><meta name="version" content="2">'));
  };
  const address = await serve(ISOLATION, { change });
  return { address, renew: () => (version = 2) };
}

const CHECKS = {
  async "pictures are those of the native program, with threads and quicker vectors"(browser) {
    const laboratory = await Laboratory.open(browser);
    await laboratory.settled();
    await comparePictures(laboratory, "relaxed");
  },

  async "pictures are those of the native program, with threads"(browser) {
    const laboratory = await Laboratory.open(browser, "?program=threads");
    await laboratory.settled();
    await comparePictures(laboratory, "threads");
  },

  // The toolkit rasterizes letters by vectors, too, and those that round otherwise fill some of them.
  async "quicker vectors draw the same letters"(browser) {
    const clips = [[0, 0, 1280, 28], [0, 28, 220, 740], [940, 28, 340, 740], [232, 40, 564, 34]];
    const shots = [];
    for (const name of ["relaxed", "threads"]) {
      const laboratory = await Laboratory.open(browser, `?program=${name}#example=whitted`);
      await laboratory.settled();
      for (const [x, y, width, height] of clips) {
        shots.push(await laboratory.page.screenshot({ clip: { x, y, width, height } }));
      }
      await laboratory.close();
    }
    clips.forEach((clip, at) => assert(shots[at].equals(shots[at + clips.length]), `other letters in ${clip}`));
  },

  async "pictures are those of the native program, without threads"(browser) {
    const laboratory = await Laboratory.open(browser, "", { serviceWorkers: "block" }, plain);
    await laboratory.settled();
    await comparePictures(laboratory, "single");
  },

  async "draws with several threads where pages are isolated"(browser) {
    const laboratory = await Laboratory.open(browser, "#example=whitted");
    const state = await laboratory.until("a finished picture", (state) => state.isIdle && state.samples >= 16);
    assert(await laboratory.page.evaluate(() => self.crossOriginIsolated), "the page is not isolated");
    assert(state.threads >= 2, `${state.threads} threads`);
    assert(state.scene.includes("checker"), "another scene than asked for");
  },

  async "draws in slices where pages are not isolated"(browser) {
    const laboratory = await Laboratory.open(browser, "", { serviceWorkers: "block" }, plain);
    const state = await laboratory.until("a finished picture", (state) => state.isIdle && state.samples >= 16);
    assert(state.threads === 1, `${state.threads} threads`);
    await moveBall(laboratory);
  },

  async "isolates itself on servers that do not"(browser) {
    const laboratory = await Laboratory.open(browser, "", {}, plain);
    const state = await laboratory.until("threads", (state) => state.threads >= 2);
    assert(state.threads >= 2, `${state.threads} threads`);
  },

  async "WebGPU draws the same picture, with threads"(browser) {
    await drawByCard(browser, "whitted", {}, isolated);
  },

  async "WebGPU draws the same picture, without threads"(browser) {
    await drawByCard(browser, "four-bodies", { serviceWorkers: "block" }, plain);
  },

  async "what has changed is drawn as the whole window is"(browser) {
    const steps = {
      started: () => {},
      dragged: moveBall,
      menu: ({ page }) => page.mouse.click(20, 14),
      closed: ({ page }) => page.keyboard.press("Escape"),
      russian: (laboratory) => laboratory.run("window.language.russian"),
      audited: async (laboratory) => {
        await laboratory.run("audit.tool");
        await laboratory.page.mouse.click(...(await laboratory.place(0.5, 0.5)));
      },
      smaller: ({ page }) => page.setViewportSize({ width: 1000, height: 700 }),
    };
    for (const way of ["changes", "whole"]) {
      const laboratory = await Laboratory.open(browser, `?paint=${way}#example=four-bodies`);
      for (const [name, step] of Object.entries(steps)) {
        await step(laboratory);
        await laboratory.settled();
        const { width, height } = laboratory.page.viewportSize();
        // The bar at the bottom tells times.
        const clip = { x: 0, y: 0, width, height: height - 30 };
        await laboratory.page.screenshot({ path: path.join(folder, `${name}-${way}.png`), clip });
      }
      await laboratory.close();
    }
    for (const name of Object.keys(steps)) {
      const [changes, whole] = ["changes", "whole"].map((way) => path.join(folder, `${name}-${way}.png`));
      const { share_above, max } = JSON.parse(await run("diff", changes, whole, "--json", "--tolerance", "2/255"));
      assert(share_above === 0, `${name}: ${share_above} of the pixels differ, largest ${max}`);
    }
  },

  async "a command that is not there is refused in words"(browser) {
    const laboratory = await Laboratory.open(browser);
    const said = await laboratory.page.evaluate(() => self.catoptric.run("no.such.command").catch(String));
    assert(said.includes('there is no command "no.such.command"'), said);
    await laboratory.run("view.grid");
  },

  async "an example by its address is traced, whatever was drawn last"(browser) {
    const laboratory = await Laboratory.open(browser);
    await laboratory.run("view.method.ssr");
    // The settings are kept a moment later.
    await laboratory.page.waitForTimeout(2000);
    const loaded = laboratory.page.waitForEvent("load");
    await laboratory.page.evaluate(() => (location.hash = "example=whitted"));
    await loaded;
    await laboratory.shown();
    await laboratory.until("the traced example", (state) => state.method === "whitted");
  },

  async "a body is dragged, and that is undone"(browser) {
    const laboratory = await Laboratory.open(browser);
    const before = (await laboratory.state()).scene;
    await moveBall(laboratory);
    await laboratory.page.keyboard.press("Control+z");
    await laboratory.until("the ball back", (state) => state.scene === before);
  },

  async "the language changes, and stays changed"(browser) {
    const laboratory = await Laboratory.open(browser);
    assert((await laboratory.state()).language === "english", "not English at first");
    await laboratory.run("window.language.russian");
    await laboratory.until("Russian", (state) => state.language === "russian");
    await laboratory.page.waitForTimeout(1500);
    await laboratory.go();
    await laboratory.until("Russian after a reload", (state) => state.language === "russian");
  },

  async "speaks the language of the browser at first"(browser) {
    const laboratory = await Laboratory.open(browser, "", { locale: "ru-RU" });
    await laboratory.until("Russian", (state) => state.language === "russian");
  },

  async "a pixel is pinned and audited"(browser) {
    const laboratory = await Laboratory.open(browser, "#example=whitted");
    await laboratory.run("audit.tool");
    await laboratory.page.mouse.click(...(await laboratory.place(0.5, 0.5)));
    const state = await laboratory.until("rays", (state) => state.rays !== null);
    assert(state.pixel !== null && state.rays >= 1, "no pixel");
  },

  async "a coefficient is typed in the inspector"(browser) {
    const laboratory = await Laboratory.open(browser);
    await laboratory.page.mouse.click(...(await laboratory.place(...BALL)));
    await laboratory.until("a selected ball", (state) => state.selected.length === 1);
    const before = (await laboratory.settled()).scene;
    await laboratory.fill("k_r reflection", "0.37");
    const state = await laboratory.until("the coefficient", (state) => state.scene !== before);
    assert(state.scene.includes("reflection = 0.37"), "another coefficient");
    await laboratory.page.keyboard.press("Control+z");
    await laboratory.until("the coefficient back", (state) => state.scene === before);
  },

  async "a picture too large for the memory is refused in words"(browser) {
    const laboratory = await Laboratory.open(browser);
    const moved = (await moveBall(laboratory)).scene;
    const said = (order) =>
      laboratory.page.evaluate((order) => self.catoptric.picture(order).then(() => "drawn", (error) => error.message), order);
    const tooLarge = await said({ width: 1_000_000, height: 1_000_000, format: "exr" });
    assert(tooLarge.includes("is too large"), tooLarge);
    const noMemory = await said({ width: 16_384, height: 16_384, format: "exr" });
    assert(noMemory.includes("not enough memory"), noMemory);
    const state = await laboratory.settled();
    assert(state.scene === moved, "the scene has changed");
    // As a person asks for it.
    await laboratory.run("picture.render");
    await laboratory.press("Keep proportions");
    await laboratory.fill("Width", "16384", "Tab");
    await laboratory.fill("Height", "16384", "Tab");
    await laboratory.press("Render");
    await laboratory.widget("The picture could not be rendered");
    await laboratory.press("OK");
    assert((await laboratory.settled()).scene === moved, "the scene has changed");
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
  },

  async "a damaged link is told of"(browser) {
    const laboratory = await Laboratory.open(browser, "#view=abc");
    await laboratory.until("the first example", (state) => state.scene.length > 100);
  },

  async "unsaved work outlives a reload"(browser) {
    const laboratory = await Laboratory.open(browser);
    const moved = (await moveBall(laboratory)).scene;
    await laboratory.until("kept work", (state) => state.isKept);
    await laboratory.page.waitForTimeout(300);
    await laboratory.go();
    await laboratory.until("the work", (state) => state.scene === moved);
  },

  async "a broken file changes nothing"(browser) {
    const laboratory = await Laboratory.open(browser);
    const before = (await laboratory.state()).scene;
    await laboratory.drop("broken.toml", "format = \u0000 [[[");
    await laboratory.page.waitForTimeout(500);
    assert((await laboratory.state()).scene === before, "the scene has changed");
  },

  async "a dropped scene is opened"(browser) {
    const laboratory = await Laboratory.open(browser);
    await laboratory.drop("one.toml", 'format = "catoptric/1"\n\n[[bodies]]\nname = "lonely"\nshape = "sphere"\n');
    await laboratory.until("the scene", (state) => state.scene.includes("lonely"));
  },

  async "says what is missing where nothing draws a window"(browser) {
    const without = "OffscreenCanvas.prototype.getContext = () => null;\n";
    const change = (name, bytes) => (name === "worker.js" ? Buffer.concat([Buffer.from(without), bytes]) : bytes);
    const address = await serve(ISOLATION, { change });
    const context = await browser.newContext({ locale: "ru-RU" });
    const page = await context.newPage();
    await page.goto(`${address}studio.html`);
    const message = page.locator("#message", { hasText: "включите аппаратное ускорение" });
    await message.waitFor({ timeout: PATIENCE });
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
  },

  async "works without a network after the first visit"(browser) {
    const laboratory = await Laboratory.open(browser);
    await laboratory.page.waitForTimeout(3000);
    await laboratory.context.setOffline(true);
    await laboratory.go("#example=whitted");
    await laboratory.until("a picture", (state) => state.samples > 0);
  },

  async "a newer version is announced, and loaded when it is wanted"(browser) {
    const { address, renew } = await serveVersions();
    const laboratory = await Laboratory.open(browser, "", {}, address);
    const moved = (await moveBall(laboratory)).scene;
    await laboratory.until("kept work", (state) => state.isKept);
    await laboratory.page.evaluate(() => navigator.serviceWorker.ready);
    const isNew = () => laboratory.page.locator("meta[name=version]").count();
    assert((await isNew()) === 0, "newer from the beginning");
    renew();
    await laboratory.go();
    await laboratory.page.waitForSelector("#offer:not([hidden])", { timeout: PATIENCE });
    assert((await isNew()) === 0, "newer without being asked");
    await Promise.all([laboratory.page.waitForEvent("load", { timeout: PATIENCE }), laboratory.page.click("#offer-button")]);
    await laboratory.shown();
    assert((await isNew()) === 1, "the old version again");
    await laboratory.until("the work", (state) => state.scene === moved);
  },

  async "the picture stands alone on somebody's page"(browser) {
    const laboratory = await Laboratory.open(browser, "?embed#example=whitted");
    const state = await laboratory.until("a picture", (state) => state.samples > 0);
    assert(state.viewport[2] >= 1270 && state.viewport[3] >= 790, `the picture has ${state.viewport}`);
    const href = await laboratory.page.getAttribute("#opener", "href");
    assert(href === "studio.html#example=whitted", href);
  },

  async "a picture is checked on a page of its own"(browser) {
    const file = (name) => path.join(folder, "checked", name);
    await fs.mkdir(file(""), { recursive: true });
    await fs.writeFile(file("balls.rt"), BALLS);
    await run("render", file("balls.rt"), "-o", file("right.png"), "--quiet");
    await run("render", file("balls.rt"), "-o", file("wide.png"), "--dialect", "vertical-fov", "--quiet");
    for (const [language, right, mistake] of [["en", "Right", "the field of view"], ["ru", "Верно", "угол обзора"]]) {
      const context = await browser.newContext({ viewport: { width: 1100, height: 900 } });
      const page = await context.newPage();
      page.on("request", (request) => assert(request.method() === "GET", `${request.method()} ${request.url()}`));
      await page.goto(new URL(`check.html?lang=${language}`, isolated).href);
      const verdict = async () => {
        await page.waitForSelector("#result:not([hidden]), #status.fault", { timeout: PATIENCE });
        return (await page.locator("#result:not([hidden]), #status.fault").first().innerText()).trim();
      };
      // As from the keyboard: the button is behind the choice of the curve.
      await page.setInputFiles("#scene-file", file("balls.rt"));
      await page.setInputFiles("#picture-file", file("right.png"));
      await page.focus("#curve");
      await page.keyboard.press("Tab");
      await page.keyboard.press("Enter");
      assert((await verdict()).startsWith(right), await verdict());
      assert((await page.locator("#pictures figure").count()) === 2, "other pictures than two");
      // Dropped on the page, a picture goes where it belongs.
      const bytes = (await fs.readFile(file("wide.png"))).toString("base64");
      await page.evaluate((bytes) => {
        const dataTransfer = new DataTransfer();
        const array = Uint8Array.from(atob(bytes), (letter) => letter.charCodeAt(0));
        dataTransfer.items.add(new File([array], "wide.png", { type: "image/png" }));
        document.body.dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
      }, bytes);
      await page.click("#start");
      const told = (await verdict()).toLowerCase();
      assert(told.includes(mistake), told);
      assert((await page.locator("#pictures .detail").count()) === 2, "no neighborhood of the worst pixel");
      await page.screenshot({ path: path.join(folder, `check-${language}.png`), fullPage: true });
      // What is no picture is said, and the page goes on.
      await page.setInputFiles("#picture-file", file("balls.rt"));
      await page.click("#start");
      assert((await verdict()).includes("balls.rt"), await verdict());
      await context.close();
    }
  },

  async "fingers tap, turn, zoom and press long"(browser) {
    const tablet = { viewport: { width: 820, height: 1180 }, hasTouch: true };
    const laboratory = await Laboratory.open(browser, "", tablet);
    const ball = await laboratory.place(...BALL);
    await laboratory.page.touchscreen.tap(...ball);
    await laboratory.until("a selection", (state) => state.selected.length === 1);
    await laboratory.touch([[ball, ball]], 2500);
    await laboratory.widget("Duplicate");
    await laboratory.page.keyboard.press("Escape");
    const first = await laboratory.settled();
    const sky = await laboratory.place(0.5, 0.2);
    await laboratory.touch([[sky, [sky[0] + 60, sky[1] + 20]]]);
    const turned = await laboratory.settled();
    assert(`${turned.view}` !== `${first.view}`, "the view has not turned");
    // Over bodies, which stay where they are.
    const [x, y] = await laboratory.place(0.5, 0.5);
    await laboratory.touch([[[x - 20, y], [x - 80, y]], [[x + 20, y], [x + 80, y]]]);
    const scaled = await laboratory.settled();
    assert(`${scaled.view}` !== `${turned.view}`, "the view has not come nearer");
    const bodies = (state) => state.scene.slice(state.scene.indexOf("[[bodies]]"));
    assert(bodies(scaled) === bodies(first), "a body has moved");
  },

  async "the window fits tablets and telephones"(browser) {
    for (const [width, height] of [[1280, 800], [820, 1180], [390, 844]]) {
      for (const locale of ["en-US", "ru-RU"]) {
        const device = { viewport: { width, height }, hasTouch: width < 1000, locale };
        const laboratory = await Laboratory.open(browser, "#example=whitted", device);
        const { viewport } = await laboratory.settled();
        await laboratory.page.screenshot({ path: path.join(folder, `window-${width}-${locale}.png`) });
        const share = (viewport[2] * viewport[3]) / (width * height);
        assert(share > 0.3 && viewport[2] > 0.4 * width, `${width}x${height}: the picture has ${viewport}`);
        await laboratory.close();
      }
    }
  },
};

// Why a check cannot be made with this site; `null` if it can.
function whyNot(name) {
  if (!hasThreads && ["several threads", "with threads", "isolates itself"].some((words) => name.includes(words))) {
    return "the program with threads was not built";
  }
  if (!programs.relaxed && name.includes("quicker vectors")) {
    return "the program with quicker vectors was not built";
  }
  if (!programs.single && ["not isolated", "without threads"].some((words) => name.includes(words))) {
    return "the program without threads was not built";
  }
  return null;
}

// Makes one check; gives back its failure, if it fails.
async function make(browser, name, check) {
  const contexts = [];
  const strangers = [];
  const open = {
    async newContext(options) {
      const context = await browser.newContext(options);
      contexts.push(context);
      context.on("request", (request) => {
        const isOwn = ["http://127.0.0.1:", "blob:"].some((start) => request.url().startsWith(start));
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

const browser = await launch();
await fs.mkdir(folder, { recursive: true });
const counts = { passed: 0, failed: 0, skipped: 0 };
for (const [name, check] of Object.entries(CHECKS).filter(([name]) => name.includes(part))) {
  const reason = whyNot(name);
  if (reason) {
    console.log(`skipped: ${name}: ${reason}`);
    counts.skipped++;
    continue;
  }
  const start = Date.now();
  let failure = await make(browser, name, check);
  if (failure) {
    console.log(`once more: ${name}\n  ${failure.message}`);
    failure = await make(browser, name, check);
  }
  const seconds = ((Date.now() - start) / 1000).toFixed(1);
  console.log(failure ? `FAILED: ${name} (${seconds} s)\n  ${failure.message}` : `ok: ${name} (${seconds} s)`);
  counts[failure ? "failed" : "passed"]++;
}
await browser.close();
console.log(`the laboratory in Chromium: ${counts.passed} passed, ${counts.failed} failed, ${counts.skipped} skipped`);
process.exit(counts.failed > 0 ? 1 : 0);
