// A thread of the studio: a worker that shares its memory, and does one piece of work.

import { initSync, runThread } from "./threads/studio.js";

const STACK = 4 << 20;

self.onmessage = ({ data: { module, memory, work } }) => {
  initSync({ module, memory, thread_stack_size: STACK });
  runThread(work);
  self.postMessage({ type: "ended" });
};
