// The worker that holds pictures against scenes: it may wait, and the page never does.

const STACK = 4 << 20;

let glue = null;

self.onmessage = async ({ data }) => {
  try {
    if (data.type === "start") {
      await start(data);
    } else {
      await check(data);
    }
  } catch (error) {
    const message = String(error?.message ?? error);
    self.postMessage({ type: error instanceof WebAssembly.RuntimeError ? "fault" : "refusal", message });
  }
};

async function start({ folder, processors }) {
  glue = await import(`./${folder}/studio.js`);
  const response = await fetch(new URL(`./${folder}/studio_bg.wasm`, import.meta.url));
  if (!response.ok) {
    throw new Error(`${response.url}: ${response.status} ${response.statusText}`);
  }
  // Servers that do not know the type are no matter.
  const headers = { "Content-Type": "application/wasm" };
  const module = await WebAssembly.compileStreaming(new Response(response.body, { headers }));
  const { memory } = glue.initSync(processors > 0 ? { module, thread_stack_size: STACK } : { module });
  if (processors > 0) {
    self.postMessage({ type: "shared", folder, module, memory });
    glue.useThreads(processors);
  }
  self.postMessage({ type: "ready" });
}

async function check({ order, files }) {
  for (const [path, bytes] of files) {
    glue.putFile(path, bytes);
  }
  const work = new glue.Check(JSON.stringify(order));
  try {
    let found = work.take();
    while (!found) {
      await new Promise((resolve) => setTimeout(resolve, 20));
      found = work.take();
    }
    const [json, ...pictures] = found;
    self.postMessage({ type: "found", found: JSON.parse(json), pictures });
  } finally {
    work.free();
  }
}
