// The worker in which the studio lives: it draws, and it may wait.

const STACK = 4 << 20;
// So long after the start the manual is loaded, and so long after that failed, milliseconds.
const MANUAL_AFTER = 4000;
const MANUAL_AGAIN = 15000;

let glue = null;
let studio = null;
let isHidden = false;
let frameAt = Infinity;
// Questions of scripts that wait for a frame: what is answered is how the studio stands after all that has happened.
const questions = [];
// Commands of scripts that wait for the studio.
const orders = [];
let timer = 0;

self.onmessage = ({ data }) => {
  attempt(() => {
    switch (data.type) {
      case "start":
        start(data).catch(fail);
        break;
      case "event":
        studio?.tell(JSON.stringify(data.event));
        drawIn(0);
        break;
      case "run":
        orders.push(data);
        runOrders();
        break;
      case "file":
        glue?.putFile(data.path, data.bytes);
        break;
      case "hidden":
        isHidden = data.isHidden;
        frameAt = Infinity;
        drawIn(0);
        break;
      case "ask":
        questions.push(data);
        answerIfCalm();
        break;
      case "draw":
        drawPicture(data);
        break;
      case "look":
        // What is seen is known after a frame that was drawn with the wish to know it.
        studio?.widgets();
        questions.push(data);
        drawIn(0);
        answerIfCalm();
        break;
      case "ping":
        self.postMessage({ type: "pong" });
        break;
      case "wake":
        drawIn(0);
        break;
    }
  });
};

// Draws a picture for a script of the page.
async function drawPicture({ number, order }) {
  let picture = null;
  try {
    picture = studio.drawPicture(order);
    let bytes = picture.take();
    while (!bytes) {
      await new Promise((resolve) => setTimeout(resolve, 10));
      bytes = picture.take();
    }
    self.postMessage({ type: "answer", number, value: { bytes, milliseconds: picture.milliseconds() } });
  } catch (error) {
    refuse(number, error);
  } finally {
    picture?.free();
  }
}

// Does the commands of scripts, once there is a studio.
function runOrders() {
  for (const { number, command } of studio ? orders.splice(0) : []) {
    try {
      studio.tell(JSON.stringify({ type: "run", command }));
      self.postMessage({ type: "answer", number });
    } catch (error) {
      refuse(number, error);
    }
  }
  drawIn(0);
}

// Tells a script why something cannot be done.
function refuse(number, error) {
  self.postMessage({ type: "answer", number, error: String(error?.message ?? error) });
  if (isFatal(error)) {
    fail(error);
  }
}

async function start({ canvas, files, options, size, processors, folder, bytes }) {
  const hasThreads = processors > 0;
  glue = await import(`./${folder}/studio.js`);
  const module = await compile(new URL(`./${folder}/studio_bg.wasm`, import.meta.url), bytes);
  self.postMessage({ type: "starting" });
  const { memory } = glue.initSync(hasThreads ? { module, thread_stack_size: STACK } : { module });
  if (hasThreads) {
    self.postMessage({ type: "shared", folder, module, memory });
    glue.useThreads(processors);
  }
  for (const [path, bytes] of files) {
    glue.putFile(path, bytes);
  }
  canvas.addEventListener("webglcontextlost", () => {
    studio = null;
    fail(new Error("WebGL"));
  });
  studio = new glue.Studio(canvas, JSON.stringify(options));
  for (const event of size) {
    studio.tell(JSON.stringify(event));
  }
  runOrders();
  setTimeout(loadManual, MANUAL_AFTER, ["en", "ru"]);
  await useCard(hasThreads);
}

// Lets the graphics card draw, if the browser has one for programs. Among threads it is told of work by a promise that not
// every browser has.
async function useCard(hasThreads) {
  if (!navigator.gpu || (hasThreads && !Atomics.waitAsync)) {
    return;
  }
  const info = (await navigator.gpu.requestAdapter())?.info;
  if (info && studio) {
    const name = info.description || [info.vendor, info.architecture].filter(Boolean).join(" ") || "WebGPU";
    studio.useCard(name, info.isFallbackAdapter === true);
    drawIn(0);
  }
}

// Loads the pages of the manual in these languages, which nothing before the first picture needs.
async function loadManual(languages) {
  const left = [];
  for (const language of languages) {
    try {
      const response = await fetch(new URL(`./manual/${language}.json`, import.meta.url));
      for (const [path, text] of await response.json()) {
        glue.putFile(`/manual/${language}/${path}`, new TextEncoder().encode(text));
      }
      drawIn(0);
    } catch {
      left.push(language);
    }
  }
  if (left.length) {
    setTimeout(loadManual, MANUAL_AGAIN, left);
  }
}

// Compiles the program of so many bytes while it is loaded, and tells how far that is.
async function compile(url, bytes) {
  const response = await fetch(url);
  if (!response.ok) {
    throw new Error(`${url.pathname}: ${response.status} ${response.statusText}`);
  }
  let loaded = 0;
  const counted = response.body.pipeThrough(
    new TransformStream({
      transform(chunk, controller) {
        loaded += chunk.byteLength;
        self.postMessage({ type: "progress", share: loaded / bytes });
        controller.enqueue(chunk);
      },
    }),
  );
  const headers = { "Content-Type": "application/wasm" };
  return WebAssembly.compileStreaming(new Response(counted, { headers }));
}

// Has a frame drawn in so many milliseconds at the latest.
function drawIn(delay) {
  const at = performance.now() + delay;
  if (!studio || at >= frameAt) {
    return;
  }
  frameAt = at;
  clearTimeout(timer);
  timer = 0;
  if (isHidden) {
    timer = setTimeout(draw, Math.max(delay, 250));
  } else if (delay > 0) {
    timer = setTimeout(() => requestAnimationFrame(draw), delay);
  } else {
    requestAnimationFrame(draw);
  }
}

function draw() {
  if (frameAt === Infinity) {
    return;
  }
  frameAt = Infinity;
  attempt(() => {
    const { commands, delay } = JSON.parse(studio.frame(performance.now()));
    const changes = glue.takeChanges();
    if (changes.length > 0) {
      self.postMessage({ type: "changes", changes });
    }
    for (let image = studio.takeImage(); image; image = studio.takeImage()) {
      self.postMessage({ type: "image", image });
    }
    if (commands.length > 0) {
      self.postMessage({ type: "commands", commands });
    }
    self.postMessage({ type: "frame" });
    answer();
    if (delay !== null) {
      drawIn(delay);
    }
  });
}

function answerIfCalm() {
  if (!studio || frameAt > performance.now() + 100) {
    answer();
  }
}

function answer() {
  for (const { type, number } of questions.splice(0)) {
    const value = (type === "ask" ? studio?.state() : studio?.widgets()) ?? null;
    self.postMessage({ type: "answer", number, value });
  }
}

function attempt(work) {
  try {
    work();
  } catch (error) {
    fail(error);
  }
}

function isFatal(error) {
  return error instanceof WebAssembly.RuntimeError || error instanceof RangeError;
}

// A studio that has failed once is not asked again. One that refuses goes on.
function fail(error) {
  if (studio && !isFatal(error)) {
    console.error(error);
    return;
  }
  studio = null;
  self.postMessage({ type: "fault", message: String(error?.message ?? error) });
}
