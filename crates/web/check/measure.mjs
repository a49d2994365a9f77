// Size, start and speed of the laboratory in a real browser: `node measure.mjs SITE CHROMIUM PROGRAM FOLDER`. Medians, on an
// idle machine; the native program is measured beside it, by turns.

import { execFile } from "node:child_process";
import fs from "node:fs/promises";
import path from "node:path";
import { promisify } from "node:util";
import { ISOLATION, Laboratory, launch, program, serve, site } from "./laboratory.mjs";

const STARTS = 7;
const PICTURES = 21;
const DRAGS = 5;

const address = await serve(ISOLATION, { isPacked: true });

function median(numbers) {
  return numbers.toSorted((a, b) => a - b)[numbers.length >> 1];
}

function told(numbers, digits = 0) {
  const text = (number) => number.toFixed(digits);
  return `median ${text(median(numbers))} of ${numbers.length} (${text(Math.min(...numbers))} to ${text(Math.max(...numbers))})`;
}

// Loads the page, and gives back when its first traced picture was there, milliseconds after the navigation began, and what
// was loaded for it.
async function load(page) {
  const names = new Set();
  const note = (request) => names.add(new URL(request.url()).pathname.slice(1));
  page.on("request", note);
  await page.goto("about:blank");
  await page.goto(`${address}studio.html#example=whitted`, { waitUntil: "commit" });
  await page.waitForFunction(() => self.catoptric);
  const time = await page.evaluate(async () => {
    for (;;) {
      if ((await self.catoptric.state())?.pictures) {
        return performance.now();
      }
      await new Promise((resolve) => setTimeout(resolve, 5));
    }
  });
  page.off("request", note);
  return { time, names: [...names].filter(Boolean) };
}

async function bytesOf(names, ending) {
  let sum = 0;
  for (const name of names) {
    const file = path.join(site, name);
    const packed = await fs.stat(file + ending).catch(() => fs.stat(file));
    sum += packed.size;
  }
  return sum;
}

async function measureStart(browser) {
  const cold = [];
  const cached = [];
  let loaded = [];
  for (let run = 0; run < STARTS; run++) {
    const context = await browser.newContext({ viewport: { width: 1280, height: 800 } });
    const page = await context.newPage();
    const { time, names } = await load(page);
    cold.push(time);
    // The service worker loads itself and what is kept for later; the first picture does not wait for them.
    loaded = names.filter((name) => name !== "service-worker.js");
    await page.waitForTimeout(4000);
    cached.push((await load(page)).time);
    await context.close();
  }
  console.log(`loaded for the first picture: ${loaded.join(", ")}`);
  for (const [ending, name] of [[".br", "brotli"], [".gz", "gzip"], ["", "unpacked"]]) {
    console.log(`bytes for the first picture, ${name}: ${await bytesOf(loaded, ending)}`);
  }
  console.log(`first traced picture, nothing cached, ms: ${told(cold)}`);
  console.log(`first traced picture, cached, ms: ${told(cached)}`);
}

async function traceNative() {
  const words = ["render", "whitted", "--size", "1280x720", "--threads", "2", "--quiet", "--stats", "-", "-o"];
  const { stdout } = await promisify(execFile)(program, [...words, path.join(site, "../measured.exr")]);
  return JSON.parse(stdout).milliseconds.trace;
}

async function measureSpeed(browser) {
  const laboratory = await Laboratory.open(browser, "", {}, address);
  await laboratory.settled();
  const order = { width: 1280, height: 720, example: "whitted", format: "exr" };
  // The browser optimizes the program while it runs.
  for (let run = 0; run < 8; run++) {
    await laboratory.draw(order, null);
  }
  const ours = [];
  const native = [];
  for (let run = 0; run < PICTURES; run++) {
    native.push(await traceNative());
    ours.push(await laboratory.draw(order));
  }
  console.log(`whitted, 1280x720, two threads, native, ms: ${told(native, 1)}`);
  console.log(`whitted, 1280x720, ${(await laboratory.state()).threads} threads, Chromium, ms: ${told(ours, 1)}`);
  console.log(`speed of Chromium over native: ${(median(native) / median(ours)).toFixed(2)}`);
  await laboratory.close();
}

// Drags the ball of four-bodies around, and counts the pictures. Without a graphics card the browser's own drawing of the
// window takes most of the time: a small window tells that apart.
async function measureEditing(browser, viewport) {
  const laboratory = await Laboratory.open(browser, "#example=four-bodies", { viewport }, address);
  await laboratory.settled();
  const { mouse } = laboratory.page;
  const rates = [];
  for (let run = 0; run < DRAGS; run++) {
    const [x, y] = await laboratory.place(0.19, 0.47);
    await mouse.move(x, y);
    await mouse.down();
    await mouse.move(x + 10, y);
    const before = await laboratory.state();
    const start = performance.now();
    while (performance.now() - start < 3000) {
      const angle = (performance.now() - start) / 300;
      await mouse.move(x + 40 * Math.sin(angle), y + 10 * Math.sin(2 * angle));
      await laboratory.page.waitForTimeout(8);
    }
    const after = await laboratory.state();
    rates.push((1000 * (after.pictures - before.pictures)) / (performance.now() - start));
    await mouse.move(x, y);
    await mouse.up();
    await laboratory.settled();
  }
  const size = `${viewport.width}x${viewport.height}`;
  console.log(`pictures a second while four-bodies is edited in a window of ${size}: ${told(rates, 1)}`);
  await laboratory.close();
}

const browser = await launch();
console.log(`Chromium ${browser.version()}`);
await measureStart(browser);
await measureSpeed(browser);
for (const [width, height] of [[1280, 800], [640, 400]]) {
  await measureEditing(browser, { width, height });
}
await browser.close();
process.exit(0);
