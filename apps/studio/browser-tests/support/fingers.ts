import type { CDPSession } from "playwright-core";

/** Fingers on the glass: each has a number, and all that touch are told of together. */
export class Fingers {
  readonly #session: CDPSession;
  readonly #down = new Map<number, { readonly x: number; readonly y: number }>();
  constructor(session: CDPSession) {
    this.#session = session;
  }
  async put(id: number, x: number, y: number): Promise<void> {
    const type = this.#down.has(id) ? "touchMove" : "touchStart";
    this.#down.set(id, { x, y });
    await this.#tell(type);
  }
  async lift(id: number): Promise<void> {
    this.#down.delete(id);
    await this.#tell("touchEnd");
  }
  async #tell(type: "touchStart" | "touchMove" | "touchEnd"): Promise<void> {
    await this.#session.send("Input.dispatchTouchEvent", {
      type,
      touchPoints: [...this.#down].map(([id, { x, y }]) => ({ id, x, y })),
    });
  }
}
