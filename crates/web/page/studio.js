// The page around the studio: it forwards what happens, keeps files, and starts the studio anew when it fails.

import { answerFileRequest, give } from "./dialogs.js";
import { copyImage, copyText, pasteText } from "./clipboard.js";
import { addressOf, viewIn } from "./link.js";
import { listen } from "./input.js";
import { Threads, bytes, others, processors, program } from "./program.js";
import { Store } from "./store.js";
import { language, say } from "./words.js";

// Says in this tab that the page was loaded once more for its isolation.
const RELOADED = "catoptric reloaded";
// A studio that fails so soon after a start, milliseconds, fails for good.
const SOON = 10_000;

// So long a service worker is waited for, milliseconds.
const PATIENCE = 4000;
// A studio that says nothing for so long, milliseconds, may be lost.
const SILENCE = 10_000;

const stage = document.getElementById("stage");
const cover = document.getElementById("cover");
const again = document.getElementById("again");
const typing = document.getElementById("typing");

const store = new Store();

// The questions of scripts that the studio has not answered yet, by number.
const questions = new Map();
let questionCount = 0;

// The studio that runs: its worker, those of its threads, and its canvas.
let current = null;

function show(message, detail = "", progress = null) {
  document.getElementById("message").textContent = message;
  document.getElementById("detail").textContent = detail;
  const bar = document.getElementById("progress");
  bar.hidden = progress === null;
  if (progress > 0) {
    bar.value = progress;
  } else {
    bar.removeAttribute("value");
  }
  again.hidden = true;
  cover.hidden = false;
}

function showFailure(message, detail) {
  show(message, detail);
  again.hidden = false;
  again.textContent = say("again");
}

async function optionsOf(fragment) {
  const parameters = new URLSearchParams(fragment.replace(/^#/, ""));
  const options = usualOptions();
  if (parameters.has("view")) {
    options.link = await viewIn(parameters.get("view"));
  } else if (parameters.has("example")) {
    options.example = parameters.get("example");
  }
  return options;
}

// On somebody's page the picture stands alone, with a button to the laboratory.
const isEmbedded = new URLSearchParams(location.search).has("embed");

// The studio as it is started anew: with what it had last. Software drivers draw what has changed, unless the whole window is
// asked for, to compare them.
function usualOptions() {
  const isWhole = new URLSearchParams(location.search).get("paint") === "whole";
  return { language, page: store.page, isEmbedded, isWhole };
}

function start(options) {
  const canvas = document.createElement("canvas");
  canvas.id = "canvas";
  canvas.tabIndex = 0;
  stage.replaceChildren(canvas);
  const worker = new Worker("worker.js", { type: "module", name: "studio" });
  const studio = { worker, canvas, startedAt: performance.now(), heardAt: performance.now(), isShown: false };
  studio.threads = new Threads((message) => hear(studio, message), (reason) => lose(studio, reason));
  current = studio;
  worker.onmessage = ({ data }) => hear(studio, data);
  worker.onerror = (event) => lose(studio, event.message);
  const drawing = canvas.transferControlToOffscreen();
  const tell = (event) => worker.postMessage({ type: "event", event });
  const sizes = listen(canvas, typing, tell, (files) => take(studio, files));
  studio.stopListening = sizes.stop;
  const parts = { files: store.files(), options, size: sizes.first, processors, folder: program, bytes };
  const message = { type: "start", canvas: drawing, ...parts };
  worker.postMessage(message, [drawing]);
  canvas.focus();
}

function stop(studio) {
  studio.stopListening();
  studio.worker.terminate();
  studio.threads.stop();
  for (const { resolve } of questions.values()) {
    resolve(null);
  }
  questions.clear();
  current = null;
}

// The studio is lost: a new one comes with what was kept.
function lose(studio, reason) {
  if (studio !== current) {
    return;
  }
  const why = studio.panic ?? reason;
  const wasShown = studio.isShown;
  stop(studio);
  console.error("The studio is lost:", why);
  if (!wasShown) {
    showFailure(say(why?.startsWith("WebGL 2") ? "noWebGl" : "failed"), why);
  } else if (performance.now() - studio.startedAt < SOON) {
    showFailure(say("failedAgain"), why);
  } else {
    show(say("stopped"), "", 0);
    start(usualOptions());
  }
}

// Puts files where the studio finds them; gives back their paths.
async function take(studio, files) {
  const paths = [];
  for (const file of files) {
    const path = `/files/${file.name}`;
    const bytes = new Uint8Array(await file.arrayBuffer());
    studio.worker.postMessage({ type: "file", path, bytes });
    store.keep(path, bytes);
    paths.push(path);
  }
  return paths;
}

function hear(studio, message) {
  if (studio !== current) {
    return;
  }
  const tell = (event) => studio.worker.postMessage({ type: "event", event });
  switch (message.type) {
    case "progress":
      show(say("loading"), "", message.share);
      break;
    case "starting":
      show(say("starting"), store.isLasting ? "" : say("noStore"), 0);
      break;
    case "shared":
      studio.threads.share(message);
      break;
    case "thread":
      studio.threads.start(message);
      break;
    case "wake":
      studio.worker.postMessage({ type: "wake" });
      break;
    case "answer":
      answer(message);
      break;
    case "pong":
      hearAgain(studio);
      break;
    case "frame":
      if (!studio.isShown) {
        studio.isShown = true;
        cover.hidden = true;
        showOpener();
        studio.heardAt = performance.now();
        performance.mark("first frame");
        keepAll();
      }
      break;
    case "changes":
      for (const [path, bytes] of message.changes) {
        store.keep(path, bytes);
        if (bytes) {
          give(path, bytes);
        }
      }
      break;
    case "image":
      copyImage(message.image);
      break;
    case "commands":
      for (const command of message.commands) {
        obey(studio, command, tell);
      }
      break;
    case "panic":
      studio.panic = message.message;
      break;
    case "fault":
      lose(studio, message.message);
      break;
  }
}

async function obey(studio, command, tell) {
  switch (command.type) {
    case "cursor":
      studio.canvas.style.cursor = command.css;
      break;
    case "copy":
      copyText(command.text);
      break;
    case "paste": {
      const text = await pasteText();
      if (text) {
        tell({ type: "paste", text });
      }
      break;
    }
    case "open":
      window.open(command.url, "_blank", "noopener");
      break;
    case "title":
      document.title = command.text;
      break;
    case "askFile": {
      const path = await answerFileRequest(command, (files) => take(studio, files));
      tell({ type: "file", id: command.id, path });
      break;
    }
    case "link":
      tell({ type: "link", outcome: await copyLink(command.view) });
      break;
    case "typeAt":
      if (command.place) {
        typing.style.left = `${command.place[0]}px`;
        typing.style.top = `${command.place[1]}px`;
        typing.focus({ preventScroll: true });
      } else if (document.activeElement === typing) {
        studio.canvas.focus({ preventScroll: true });
      }
      break;
  }
}

async function copyLink(view) {
  const address = await addressOf(view);
  if (address === null) {
    return "tooLong";
  }
  return (await copyText(address)) ? "copied" : "refused";
}

// A worker can die without a word, and a studio without threads is busy for long while it renders: the person decides.
function ping() {
  if (!current?.isShown || document.hidden) {
    return;
  }
  if (performance.now() - current.heardAt > SILENCE) {
    offer(say("silent"), say("restart"), () => lose(current, say("silent")));
  }
  current.worker.postMessage({ type: "ping" });
}

function hearAgain(studio) {
  if (performance.now() - studio.heardAt > SILENCE) {
    withdraw();
  }
  studio.heardAt = performance.now();
}

function showOpener() {
  const opener = document.getElementById("opener");
  opener.hidden = !isEmbedded;
  opener.textContent = say("open");
  opener.href = `studio.html${location.hash}`;
}

// Shows a notice with a button that does something.
function offer(text, button, act) {
  document.getElementById("offer-text").textContent = text;
  const take = document.getElementById("offer-button");
  take.textContent = button;
  take.onclick = () => {
    withdraw();
    act();
  };
  document.getElementById("offer").hidden = false;
}

function withdraw() {
  document.getElementById("offer").hidden = true;
}

// Asks the studio something for a script; `null` when there is none.
function ask(message) {
  if (!current) {
    return Promise.resolve(null);
  }
  return new Promise((resolve, reject) => {
    const number = questionCount++;
    questions.set(number, { resolve, reject });
    current.worker.postMessage({ ...message, number });
  });
}

function answer({ number, value, error }) {
  const question = questions.get(number);
  questions.delete(number);
  if (error === undefined) {
    question?.resolve(value);
  } else {
    question?.reject(new Error(error));
  }
}

// For scripts of the page, and for tests: commands by their names, how the studio stands, what is seen in its window, and
// pictures.
self.catoptric = {
  run(command) {
    return ask({ type: "run", command: String(command) });
  },
  async state() {
    return JSON.parse(await ask({ type: "ask" }));
  },
  async widgets() {
    return JSON.parse(await ask({ type: "look" }));
  },
  picture(order) {
    return ask({ type: "draw", order: JSON.stringify(order) });
  },
};

document.addEventListener("visibilitychange", () => {
  if (current) {
    current.heardAt = performance.now();
    current.worker.postMessage({ type: "hidden", isHidden: document.hidden });
  }
});
again.onclick = () => start(usualOptions());

// The service worker keeps the laboratory for later, and isolates the page where the server does not: then it is loaded
// once more.
async function keepForLater() {
  const workers = navigator.serviceWorker;
  if (!workers) {
    return;
  }
  try {
    const registration = await workers.register("service-worker.js");
    // Where it may not run, this comes never.
    await Promise.race([workers.ready, new Promise((_, reject) => setTimeout(reject, PATIENCE, "no answer"))]);
    announceNewer(registration);
  } catch (error) {
    console.warn("Nothing is kept for when there is no network:", error);
    return;
  }
  if (self.crossOriginIsolated || self !== self.top || sessionStorage.getItem(RELOADED)) {
    return;
  }
  sessionStorage.setItem(RELOADED, "yes");
  location.reload();
  await new Promise(() => {});
}

function keepAll() {
  navigator.serviceWorker?.controller?.postMessage({ type: "keep", without: others });
}

// Offers a newer laboratory, which waits until no page has the old one.
function announceNewer(registration) {
  const announce = () => {
    if (!registration.waiting || !registration.active) {
      return;
    }
    offer(say("newer"), say("load"), () => {
      navigator.serviceWorker.addEventListener("controllerchange", () => location.reload());
      registration.waiting.postMessage({ type: "take over" });
    });
  };
  announce();
  registration.addEventListener("updatefound", () => {
    registration.installing?.addEventListener("statechange", announce);
  });
}

show(say("loading"), "", 0);
await Promise.all([store.open(), keepForLater()]);
const options = await optionsOf(location.hash);
if (options.link !== undefined && !isEmbedded) {
  // It is the person's now: loaded again, the page comes back as it was left, not as the link had it.
  history.replaceState(null, "", location.pathname + location.search);
}
start(options);
setInterval(ping, 2000);
window.addEventListener("hashchange", () => location.reload());
