// The page that holds a picture against a scene: files are given to a worker on this machine, and what it finds is shown.

import { examples } from "./examples.js";
import { bytes, processors, program, Threads } from "./program.js";
import { language, words } from "./check-words.js";

// Extensions of scenes; other files are pictures.
const SCENES = [".toml", ".rt", ".yml", ".yaml", ".nff"];
const SVG = "http://www.w3.org/2000/svg";

const at = (id) => document.getElementById(id);

// The files that were chosen: the scene and what it uses, and the picture.
const chosen = { scene: null, beside: [], picture: null };
// The worker that runs: it is thrown away when another check begins before it has answered.
let current = null;
// The addresses of the pictures that are shown.
let shown = [];

function sayAll() {
  document.documentElement.lang = language;
  document.title = `Catoptric – ${words.title}`;
  const texts = {
    heading: words.title,
    lead: words.lead,
    "scene-legend": words.scene,
    "scene-help": words.sceneHelp,
    "scene-file-label": words.choose,
    "example-label": words.example,
    "picture-legend": words.picture,
    "picture-help": words.pictureHelp,
    "picture-file-label": words.choose,
    "curve-label": words.curve,
    start: words.start,
  };
  for (const [id, text] of Object.entries(texts)) {
    at(id).textContent = text;
  }
  for (const [value, text] of Object.entries(words.curves)) {
    at("curve").append(new Option(text, value));
  }
  for (const [name, titles] of Object.entries(examples)) {
    at("example").append(new Option(`${name} – ${titles[language]}`, name));
  }
  const other = language === "ru" ? ["en", "English"] : ["ru", "Русский"];
  const link = at("other-language");
  [link.lang, link.textContent] = other;
  link.href = `check.html?lang=${other[0]}`;
  at("home").href = language === "ru" ? "ru.html" : "index.html";
}

const isScene = (file) => SCENES.some((extension) => file.name.toLowerCase().endsWith(extension));

// Takes files for the scene's place, the picture's, or whichever they fit.
function take(files, place) {
  const all = [...files];
  const scene = all.find(isScene);
  if (place !== "picture" && scene) {
    chosen.scene = scene;
    chosen.beside = all.filter((file) => file !== scene);
    at("example").value = "";
  }
  const picture = place === "scene" ? null : all.find((file) => !isScene(file));
  if (picture) {
    chosen.picture = picture;
    chosen.beside = chosen.beside.filter((file) => file !== picture);
  }
  showChoice();
}

function showChoice() {
  const example = at("example").value;
  at("scene-name").textContent = [chosen.scene, ...chosen.beside].map((file) => file?.name ?? "").filter(Boolean).join(", ");
  at("picture-name").textContent = chosen.picture?.name ?? "";
  at("scene-place").classList.toggle("filled", Boolean(chosen.scene || example));
  at("picture-place").classList.toggle("filled", Boolean(chosen.picture));
  at("start").disabled = !(chosen.picture && (chosen.scene || example));
}

function status(text, isFault = false) {
  at("status").textContent = text;
  at("status").classList.toggle("fault", isFault);
}

// A worker with the program; its answers go to who asked last.
function open() {
  const worker = new Worker("check-worker.js", { type: "module", name: "check" });
  const run = { worker, asker: null, isReady: null };
  const threads = new Threads((message) => hear(message), (reason) => hear({ type: "fault", message: reason }));
  let ready = null;
  run.isReady = new Promise((resolve, reject) => (ready = { resolve, reject }));
  run.isReady.catch(() => {});
  const hear = (message) => {
    switch (message.type) {
      case "ready":
        ready.resolve();
        break;
      case "shared":
        threads.share(message);
        break;
      case "thread":
        threads.start(message);
        break;
      case "found":
        run.asker?.resolve(message);
        run.asker = null;
        break;
      case "refusal":
      case "panic":
      case "fault": {
        ready.reject(new Error(message.message));
        // The person gave files without folders.
        const reason = message.message.replaceAll(/\/files\/(scene|picture)\//g, "");
        run.asker?.reject(new Error(message.type === "refusal" ? reason : `${words.failed} ${reason}`));
        run.asker = null;
        if (message.type !== "refusal") {
          run.stop();
        }
        break;
      }
    }
  };
  worker.onmessage = ({ data }) => hear(data);
  worker.onerror = (event) => hear({ type: "fault", message: event.message });
  run.stop = () => {
    worker.terminate();
    threads.stop();
    if (current === run) {
      current = null;
    }
  };
  worker.postMessage({ type: "start", folder: program, processors });
  return run;
}

// Holds a picture against a scene: `scene` is a file or the name of a built-in one, `beside` are files that it uses.
async function check({ scene, picture, beside = [], toneCurve = "", dialect = "", allow }) {
  if (!bytes) {
    throw new Error(words.noProgram);
  }
  if (current?.asker) {
    current.asker.reject(new DOMException("", "AbortError"));
    current.stop();
  }
  current ??= open();
  const run = current;
  const answer = new Promise((resolve, reject) => (run.asker = { resolve, reject }));
  const files = [];
  const stored = async (file, folder) => {
    const path = `/files/${folder}/${file.name}`;
    files.push([path, new Uint8Array(await file.arrayBuffer())]);
    return path;
  };
  const order = { language, dialect, ...(toneCurve && { toneCurve }), ...(allow !== undefined && { allow }) };
  order.scene = typeof scene === "string" ? scene : await stored(scene, "scene");
  for (const file of beside) {
    await stored(file, "scene");
  }
  order.picture = await stored(picture, "picture");
  run.isReady.then(() => run.worker.postMessage({ type: "check", order, files }), (error) => run.asker?.reject(error));
  return answer;
}

async function checkChosen() {
  const isFirst = !current;
  at("result").hidden = true;
  status(isFirst ? words.loading : words.checking);
  const scene = chosen.scene ?? at("example").value;
  try {
    const answer = check({ scene, picture: chosen.picture, beside: chosen.beside, toneCurve: at("curve").value });
    current?.isReady.then(() => status(words.checking), () => {});
    show(await answer);
    status("");
  } catch (error) {
    if (error.name !== "AbortError") {
      status(error.message, true);
    }
  }
}

const codes = (triple) => triple.join(", ");

function show({ found, pictures }) {
  shown.forEach((address) => URL.revokeObjectURL(address));
  shown = pictures.map((png) => URL.createObjectURL(new Blob([png], { type: "image/png" })));
  const verdict = at("verdict");
  verdict.textContent = found.right ? words.right : words.wrong;
  verdict.className = found.right ? "right" : "wrong";
  at("sentence").textContent = found.sentence;
  const [yours, exact, detail, exactDetail] = shown;
  const marks = (key) => [...found.places.map((place) => place[key])];
  // Without places of a rest, the worst pixel is marked.
  const [stored, upright] = ["stored", "pixel"].map((key) => (found.places.length || !found.worst ? marks(key) : [found.worst[key]]));
  const figures = [
    figure(yours, found.size, `${words.yours}: ${chosen.picture?.name ?? ""}`, stored),
    figure(exact, found.exactSize, words.exact, upright),
  ];
  if (found.worst) {
    const { stored, found: own, exact, middle } = found.worst;
    figures.push(neighborhood(detail, middle, words.worst(stored, codes(own))));
    figures.push(neighborhood(exactDetail, middle, words.worstExact(codes(exact))));
  }
  at("pictures").replaceChildren(...figures);
  at("places").replaceChildren(...(found.places.length ? [table(found.places)] : []));
  at("result").hidden = false;
  verdict.focus();
}

function svg(name, attributes, ...children) {
  const node = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) {
    node.setAttribute(key, value);
  }
  node.append(...children);
  return node;
}

function framed(drawing, caption, kind = "") {
  const node = document.createElement("figure");
  node.className = kind;
  const words = document.createElement("figcaption");
  words.textContent = caption;
  node.append(drawing, words);
  return node;
}

// A picture with numbered places.
function figure(address, [width, height], caption, places) {
  const radius = Math.max(width, height) / 40;
  const marks = places.map(([x, y], index) => {
    const [cx, cy] = [x + 0.5, y + 0.5];
    const shift = cx + 3 * radius > width ? -1.7 * radius : 1.7 * radius;
    const text = { x: cx + shift, y: Math.min(Math.max(cy + 0.5 * radius, 1.3 * radius), height), "font-size": 1.6 * radius, "stroke-width": radius / 6 };
    return svg("g", {}, svg("circle", { cx, cy, r: radius, "stroke-width": radius / 6 }), svg("text", text, String(index + 1)));
  });
  const image = svg("image", { href: address, width, height, preserveAspectRatio: "none" });
  return framed(svg("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": caption }, image, ...marks), caption);
}

// The pixels around the worst one.
function neighborhood(address, [x, y], caption) {
  const image = svg("image", { href: address, width: "100%", height: "100%" });
  const drawing = svg("svg", { viewBox: "0 0 15 15", role: "img", "aria-label": caption }, image);
  const picture = new Image();
  picture.onload = () => {
    const [width, height] = [picture.naturalWidth, picture.naturalHeight];
    drawing.setAttribute("viewBox", `0 0 ${width} ${height}`);
    drawing.append(svg("rect", { x, y, width: 1, height: 1, "stroke-width": 0.12 }));
  };
  picture.src = address;
  return framed(drawing, caption, "detail");
}

function table(places) {
  const node = document.createElement("table");
  node.createCaption().textContent = words.places;
  const heads = node.createTHead().insertRow();
  for (const text of words.heads) {
    const head = document.createElement("th");
    head.scope = "col";
    head.textContent = text;
    heads.append(head);
  }
  const body = node.createTBody();
  places.forEach((place, index) => {
    const row = body.insertRow();
    const head = document.createElement("th");
    head.scope = "row";
    head.textContent = `${index + 1}. ${place.place}`;
    row.append(head);
    for (const text of [place.share, codes(place.stored), codes(place.found), codes(place.expected)]) {
      row.insertCell().textContent = text;
    }
  });
  return node;
}

// Files may be dropped anywhere: beyond the two places, they go where they fit.
function listenToDrops() {
  const placeOf = (event) => event.target.closest?.(".place")?.id.replace("-place", "");
  const mark = (place) => {
    for (const name of ["scene", "picture"]) {
      at(`${name}-place`).classList.toggle("over", place === name);
    }
  };
  addEventListener("dragover", (event) => {
    event.preventDefault();
    mark(placeOf(event));
  });
  addEventListener("dragleave", () => mark(null));
  addEventListener("drop", (event) => {
    event.preventDefault();
    mark(null);
    take(event.dataTransfer.files, placeOf(event));
  });
}

// For scripts of the page, and for tests.
self.catoptric = { check };

sayAll();
showChoice();
listenToDrops();
at("scene-file").onchange = (event) => take(event.target.files, "scene");
at("picture-file").onchange = (event) => {
  chosen.picture = event.target.files[0] ?? null;
  showChoice();
};
at("example").onchange = () => {
  if (at("example").value) {
    chosen.scene = null;
    chosen.beside = [];
    at("scene-file").value = "";
  }
  showChoice();
};
at("form").onsubmit = (event) => {
  event.preventDefault();
  checkChosen();
};
