// A thread of the studio: a worker that shares its memory, and does one piece of work after the other.

import { initSync, runThread } from "./threads/studio.js";

const STACK = 4 << 20;

let isReady = false;

self.onmessage = ({ data: { module, memory, work } }) => {
  if (!isReady) {
    initSync({ module, memory, thread_stack_size: STACK });
    isReady = true;
  }
  runThread(work);
  self.postMessage({ type: "ended" });
};
