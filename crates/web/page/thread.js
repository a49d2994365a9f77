// A thread of the studio: a worker that shares its memory, and does one piece of work after the other.

const STACK = 4 << 20;

let glue = null;

self.onmessage = async ({ data: { folder, module, memory, work } }) => {
  try {
    if (!glue) {
      glue = await import(`./${folder}/studio.js`);
      glue.initSync({ module, memory, thread_stack_size: STACK });
    }
    await glue.runThread(work);
    self.postMessage({ type: "ended" });
  } catch (error) {
    // The page hears of it as of an error that nobody caught.
    self.reportError(error);
  }
};
