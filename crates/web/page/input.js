// What happens on the page, as the studio is told it.

// Keys of the browser that the studio leaves to it, whatever is held with them.
const BROWSERS_KEYS = new Set(["F5", "F11", "F12"]);
// With Ctrl or Cmd: reload, tabs and windows, the address. The clipboard has events of its own.
const BROWSERS_LETTERS = new Set(["r", "t", "w", "n", "l"]);
const CLIPBOARD_LETTERS = new Set(["c", "x", "v"]);

function keysOf(event) {
  return { alt: event.altKey, ctrl: event.ctrlKey, shift: event.shiftKey, meta: event.metaKey };
}

// Listens until `stop` is called; `first` is what the studio has to know from the beginning.
export function listen(canvas, typing, tell, take) {
  const controller = new AbortController();
  const on = (target, name, listener, options = {}) =>
    target.addEventListener(name, listener, { signal: controller.signal, ...options });
  const colors = matchMedia("(prefers-color-scheme: dark)");
  const size = () => ({ type: "size", width: innerWidth, height: innerHeight, ratio: devicePixelRatio || 1 });
  const theme = () => ({ type: "theme", isDark: colors.matches });
  const focus = () => ({ type: "focus", focused: document.hasFocus() });

  on(window, "resize", () => tell(size()));
  on(colors, "change", () => tell(theme()));
  for (const name of ["focus", "blur"]) {
    on(window, name, () => tell(focus()));
  }
  listenToPointer(canvas, on, tell);
  listenToKeys(canvas, typing, on, tell);
  listenToFiles(on, tell, take);
  return { first: [size(), theme(), focus()], stop: () => controller.abort() };
}

function listenToPointer(canvas, on, tell) {
  const fingers = new Map();
  const place = (event) => ({ x: event.clientX, y: event.clientY });
  const finger = (event, phase) => {
    if (phase === "start") {
      fingers.set(event.pointerId, fingers.size === 0);
    }
    const isFirst = fingers.get(event.pointerId);
    if (isFirst === undefined) {
      return;
    }
    if (phase === "end" || phase === "cancel") {
      fingers.delete(event.pointerId);
    }
    tell({ type: "touch", id: event.pointerId, phase, ...place(event), isFirst });
  };
  const button = (event, pressed) => {
    tell({ type: "button", ...place(event), button: event.button, pressed, keys: keysOf(event) });
  };
  const isFinger = (event) => event.pointerType === "touch";

  on(canvas, "pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    if (isFinger(event)) {
      finger(event, "start");
    } else {
      button(event, true);
    }
    // The text field keeps the focus only while something is typed; the studio says so.
    event.preventDefault();
    if (document.activeElement === document.body) {
      canvas.focus();
    }
  });
  on(canvas, "pointermove", (event) => {
    if (isFinger(event)) {
      finger(event, "move");
    } else {
      tell({ type: "move", ...place(event) });
      // A second button while one is held comes as a move.
      if (event.button >= 0) {
        button(event, (event.buttons & [1, 4, 2, 8, 16][event.button]) !== 0);
      }
    }
  });
  on(canvas, "pointerup", (event) => (isFinger(event) ? finger(event, "end") : button(event, false)));
  on(canvas, "pointercancel", (event) => (isFinger(event) ? finger(event, "cancel") : button(event, false)));
  on(canvas, "pointerleave", (event) => isFinger(event) || tell({ type: "leave" }));
  on(canvas, "contextmenu", (event) => event.preventDefault());
  const wheel = (event) => {
    event.preventDefault();
    tell({ type: "wheel", dx: event.deltaX, dy: event.deltaY, mode: event.deltaMode, keys: keysOf(event) });
  };
  on(canvas, "wheel", wheel, { passive: false });
}

function listenToKeys(canvas, typing, on, tell) {
  const isTyping = () => document.activeElement === typing;
  on(window, "keydown", (event) => {
    if (event.isComposing) {
      return;
    }
    const hasCommand = event.ctrlKey || event.metaKey;
    const letter = hasCommand ? letterOf(event) : "";
    const isClipboards = CLIPBOARD_LETTERS.has(letter) && !event.shiftKey && !event.altKey;
    if (BROWSERS_KEYS.has(event.key) || BROWSERS_LETTERS.has(letter) || isClipboards) {
      return;
    }
    tell({ type: "key", key: event.key, code: event.code, pressed: true, keys: keysOf(event) });
    if (!hasCommand && !isTyping() && [...event.key].length === 1) {
      tell({ type: "text", text: event.key });
    }
    const isText = isTyping() && !hasCommand && ([...event.key].length === 1 || event.key === "Dead");
    if (!isText) {
      event.preventDefault();
    }
  });
  on(window, "keyup", (event) => {
    tell({ type: "key", key: event.key, code: event.code, pressed: false, keys: keysOf(event) });
  });
  on(typing, "input", (event) => {
    if (event.isComposing) {
      tell({ type: "composing", text: typing.value });
    } else {
      if (typing.value) {
        tell({ type: "text", text: typing.value });
      }
      typing.value = "";
    }
  });
  on(typing, "compositionend", (event) => {
    tell({ type: "composed", text: event.data });
    typing.value = "";
  });
  for (const name of ["copy", "cut"]) {
    on(document, name, (event) => {
      event.preventDefault();
      tell({ type: name });
    });
  }
  on(document, "paste", (event) => {
    event.preventDefault();
    const text = event.clipboardData.getData("text").replaceAll("\r\n", "\n");
    if (text) {
      tell({ type: "paste", text });
    }
  });
}

// The Latin letter of a key, whatever the alphabet.
function letterOf(event) {
  return event.code.startsWith("Key") ? event.code.slice(3).toLowerCase() : event.key.toLowerCase();
}

function listenToFiles(on, tell, take) {
  on(window, "dragover", (event) => {
    event.preventDefault();
    tell({ type: "hovering", count: event.dataTransfer.items.length });
  });
  on(window, "dragleave", () => tell({ type: "hovering", count: 0 }));
  on(window, "drop", async (event) => {
    event.preventDefault();
    tell({ type: "dropped", paths: await take(event.dataTransfer.files) });
  });
}
