/** What the page's main thread did in the frames since `reset`, script and WebGL calls apart [ms]. */
export interface LedgerReading {
  /**
   * Own script of each frame: callbacks of frames, timers, messages, events and microtasks, without the WebGL calls
   * inside.
   */
  readonly script_ms: readonly number[];
  /** Time inside WebGL calls of each frame; without a graphics card it is the rasteriser's. */
  readonly gl_ms: readonly number[];
  readonly seconds: number;
  /** Tasks over 50 ms as the browser counts them, with our part of them. */
  readonly longTasks: readonly LongTask[];
}
export interface LongTask {
  readonly at_ms: number;
  readonly took_ms: number;
  readonly script_ms: number;
  readonly gl_ms: number;
  readonly what: string;
}
export interface Ledger {
  reset(): void;
  read(): LedgerReading;
}
declare global {
  interface Window {
    twincellLedger: Ledger;
  }
}

/**
 * Runs in the page before anything else and wraps every way into our script (frames, timers, messages, events,
 * microtasks) and every WebGL call, so that a frame's cost does not rest on what the program under test says of itself.
 * A frame is what happens from the first frame callback to the next frame's. Reactions to promises are not seen; the
 * sum is compared with the browser's own count by who reads it.
 */
function install(asTheyAre: boolean): void {
  const now = performance.now.bind(performance);
  const KEPT = 1 << 15;
  const starts = new Float64Array(KEPT);
  const ends = new Float64Array(KEPT);
  const gls = new Float64Array(KEPT);
  const whats: string[] = [];
  const longTasks: { startTime: number; duration: number }[] = [];
  let entries = 0;
  let depth = 0;
  let began = 0;
  let gl = 0;
  let frame = -1;
  let frameScript = 0;
  let frameGl = 0;
  let since = now();
  let script_ms: number[] = [];
  let gl_ms: number[] = [];

  function closeFrame(): void {
    if (frame >= 0) {
      script_ms.push(frameScript);
      gl_ms.push(frameGl);
    }
    frameScript = frameGl = 0;
  }
  function leave(what: string): void {
    if (--depth > 0) return;
    const ended = now();
    const at = entries++ % KEPT;
    starts[at] = began;
    ends[at] = ended;
    gls[at] = gl;
    whats[at] = what;
    frameScript += ended - began - gl;
    frameGl += gl;
  }
  function enter(): void {
    if (depth++ === 0) {
      began = now();
      gl = 0;
    }
  }

  type Call = (this: unknown, ...given: unknown[]) => unknown;
  const wrapped = new WeakMap<object, Call>();
  function wrap(call: unknown, what: string): unknown {
    if (typeof call !== "function") return call;
    const inner = call as Call;
    let outer = wrapped.get(inner);
    if (!outer) {
      outer = function (this: unknown, ...given: unknown[]): unknown {
        enter();
        try {
          return inner.apply(this, given);
        } finally {
          leave(what);
        }
      };
      wrapped.set(inner, outer);
    }
    return outer;
  }
  function replace(owner: object, name: string, make: (was: Call) => Call): void {
    const was: unknown = Reflect.get(owner, name);
    Reflect.set(owner, name, make(was as Call));
  }

  const callFrame = (call: FrameRequestCallback, at: number): void => {
    if (at !== frame) {
      closeFrame();
      frame = at;
    }
    call(at);
  };
  if (asTheyAre) {
    replace(window, "requestAnimationFrame", was => (call: unknown) => {
      const inner = wrap(call, "frame") as FrameRequestCallback;
      return was.call(window, (at: number) => {
        callFrame(inner, at);
      });
    });
  } else {
    const waiting = new Map<number, FrameRequestCallback>();
    let asked = 0;
    window.requestAnimationFrame = call => {
      waiting.set(++asked, wrap(call, "frame") as FrameRequestCallback);
      return asked;
    };
    window.cancelAnimationFrame = handle => {
      waiting.delete(handle);
    };
    setInterval(() => {
      const at = now();
      const due = [...waiting.values()];
      waiting.clear();
      console.timeStamp("frame");
      for (const call of due) callFrame(call, at);
    }, 1000 / 60);
  }
  for (const name of ["setTimeout", "setInterval"])
    replace(
      window,
      name,
      was =>
        (call: unknown, ...rest: unknown[]) =>
          was.call(window, wrap(call, "timer"), ...rest),
    );
  replace(window, "queueMicrotask", was => (call: unknown) => was.call(window, wrap(call, "microtask")));
  replace(
    EventTarget.prototype,
    "addEventListener",
    was =>
      function (this: unknown, type: unknown, call: unknown, ...rest: unknown[]) {
        return was.call(this ?? window, type, wrap(call, String(type)), ...rest);
      },
  );
  replace(
    EventTarget.prototype,
    "removeEventListener",
    was =>
      function (this: unknown, type: unknown, call: unknown, ...rest: unknown[]) {
        return was.call(this ?? window, type, typeof call === "function" ? (wrapped.get(call) ?? call) : call, ...rest);
      },
  );
  for (const owner of [MessagePort.prototype, Worker.prototype]) {
    const slot = Object.getOwnPropertyDescriptor(owner, "onmessage")!;
    Object.defineProperty(owner, "onmessage", {
      ...slot,
      set(call: unknown) {
        slot.set!.call(this, wrap(call, "message"));
      },
    });
  }
  // Another size of the canvas is another picture to allocate: it waits for the rasteriser like a call does.
  for (const name of ["width", "height"]) {
    const slot = Object.getOwnPropertyDescriptor(HTMLCanvasElement.prototype, name)!;
    Object.defineProperty(HTMLCanvasElement.prototype, name, {
      ...slot,
      set(value: unknown) {
        const from = now();
        slot.set!.call(this, value);
        gl += now() - from;
      },
    });
  }
  const context = WebGL2RenderingContext.prototype;
  for (const name of Object.getOwnPropertyNames(context)) {
    const slot = Object.getOwnPropertyDescriptor(context, name);
    if (name === "constructor" || typeof slot?.value !== "function") continue;
    if (!asTheyAre && /^(draw(Arrays|Elements|Range)|clear$|clearBuffer|blitFramebuffer)/.test(name)) {
      replace(context, name, () => () => undefined);
      continue;
    }
    replace(
      context,
      name,
      was =>
        function (this: unknown, ...given: unknown[]) {
          const from = now();
          try {
            return was.apply(this, given);
          } finally {
            gl += now() - from;
          }
        },
    );
  }
  new PerformanceObserver(list => {
    for (const { startTime, duration } of list.getEntries()) longTasks.push({ startTime, duration });
  }).observe({ type: "longtask", buffered: true });

  /** Our part of a long task: the entries that lie within it. */
  function share({ startTime, duration }: { startTime: number; duration: number }): LongTask {
    let script = 0;
    let inGl = 0;
    let longest = 0;
    let what = "";
    for (let at = 0; at < Math.min(entries, KEPT); at++) {
      if (ends[at]! < startTime || starts[at]! > startTime + duration) continue;
      const own = ends[at]! - starts[at]! - gls[at]!;
      script += own;
      inGl += gls[at]!;
      if (own > longest) {
        longest = own;
        what = whats[at]!;
      }
    }
    return { at_ms: startTime, took_ms: duration, script_ms: script, gl_ms: inGl, what };
  }
  window.twincellLedger = {
    reset() {
      script_ms = [];
      gl_ms = [];
      frame = -1;
      frameScript = frameGl = 0;
      since = now();
    },
    read() {
      return {
        script_ms,
        gl_ms,
        seconds: (now() - since) / 1000,
        longTasks: longTasks.filter(task => task.startTime >= since).map(share),
      };
    },
  };
}

/**
 * To be given to a page before it starts.
 *
 * @param frames  "as they come", or "paced": then draw calls are left out and frames begin 60 times a second, as with a
 *                graphics card, and do not wait for the rasteriser. Our script does the same in both.
 */
export const ledger = (frames: "as they come" | "paced"): string =>
  `(${install.toString()})(${frames === "as they come"});`;

/** The value that so large a part of them does not exceed. */
export function quantile(values: readonly number[], part: number): number {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.min(sorted.length - 1, Math.ceil(part * sorted.length) - 1)] ?? 0;
}
