// Which of the programs this page can run, and the threads of one.

import { programs } from "./build.js";

// The smallest program with a vector instruction that leaves the rounding to the processor, `i32x4.relaxed_trunc_f32x4_s`:
// where it is valid, the quicker vectors are there.
const RELAXED = [0, 97, 115, 109, 1, 0, 0, 0, 1, 6, 1, 96, 1, 123, 1, 123, 3, 2, 1, 0, 10, 9, 1, 7, 0, 32, 0, 253, 129, 2, 11];

// The programs that this page can run, the quickest first: with several threads where it may share memory. Another one can be
// asked for, to compare them.
const canShare = self.crossOriginIsolated === true;
const needs = { relaxed: canShare && WebAssembly.validate(new Uint8Array(RELAXED)), threads: canShare, single: true };
const possible = Object.keys(needs).filter((name) => needs[name] && programs[name]);
const wanted = new URLSearchParams(location.search).get("program");

// The program's folder, and how many bytes it has.
export const program = possible.includes(wanted) ? wanted : possible[0];
export const { bytes } = programs[program] ?? {};
// How many threads it can have; none where it is the one without.
export const processors = program !== "single" ? Math.max(navigator.hardwareConcurrency || 2, 2) : 0;
// The folders of the programs that this page does not run.
export const others = Object.keys(programs).filter((name) => name !== program);

// The workers of a program's threads, which do one piece of work after the other: to start one takes longer than most work.
export class Threads {
  #workers = new Set();
  #idle = [];
  #shared = null;
  #hear;
  #lose;

  // `hear` is told what the threads say, `lose` that one of them is lost.
  constructor(hear, lose) {
    this.#hear = hear;
    this.#lose = lose;
  }

  // What all threads need: the message `shared` of the program's worker.
  share({ folder, module, memory }) {
    this.#shared = { folder, module, memory };
  }

  // Does what a message `thread` asks for.
  start({ name, work }) {
    const worker = this.#idle.pop() ?? this.#open(name);
    worker.postMessage({ ...this.#shared, work });
  }

  #open(name) {
    const worker = new Worker("thread.js", { type: "module", name });
    this.#workers.add(worker);
    worker.onmessage = ({ data }) => {
      if (data.type === "ended") {
        this.#idle.push(worker);
      } else {
        this.#hear(data);
      }
    };
    worker.onerror = (event) => this.#lose(event.message);
    return worker;
  }

  stop() {
    this.#workers.forEach((worker) => worker.terminate());
  }
}
