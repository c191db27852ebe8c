import type { Page } from "playwright-core";
import type {} from "../../src/console.ts";

declare global {
  interface Window {
    testPad: { connected: boolean; readonly buttons: number[]; readonly axes: number[] };
  }
}

/** A gamepad of the W3C standard layout, 17 buttons and 4 axes, before the page starts. */
export const PAD_SCRIPT = `{
  const pad = window.testPad = { connected: false, buttons: new Array(17).fill(0), axes: new Array(4).fill(0) };
  const shown = () => ({ id: "Standard pad", index: 0, mapping: "standard", connected: true, timestamp: performance.now(), axes: [...pad.axes], buttons: pad.buttons.map(value => ({ value, pressed: value >= .5, touched: value > 0 })) });
  navigator.getGamepads = () => [pad.connected ? shown() : null, null, null, null];
}`;

/** Thumbs on a pad. What the eyes need, the position of the tool, is read as a person reads it: once a frame. */
export class Pad {
  private readonly page: Page;
  constructor(page: Page) {
    this.page = page;
  }

  async plug(): Promise<void> {
    await this.page.evaluate(() => {
      window.testPad.connected = true;
      window.dispatchEvent(new Event("gamepadconnected"));
    });
    await this.page.waitForFunction(() => window.twincell.stores.gamepadStore.getState().pad !== null);
  }
  async pull(): Promise<void> {
    await this.page.evaluate(() => {
      window.testPad.connected = false;
      window.dispatchEvent(new Event("gamepaddisconnected"));
    });
  }
  async button(index: number, value: number): Promise<void> {
    await this.page.evaluate(
      ([at, to]) => {
        window.testPad.buttons[at] = to;
      },
      [index, value] as const,
    );
    await this.frames(2);
  }
  async stick(axis: number, value: number): Promise<void> {
    await this.page.evaluate(
      ([at, to]) => {
        window.testPad.axes[at] = to;
      },
      [axis, value] as const,
    );
    await this.frames(2);
  }
  async press(index: number): Promise<void> {
    await this.button(index, 1);
    await this.button(index, 0);
  }
  async letGo(): Promise<void> {
    await this.page.evaluate(() => {
      window.testPad.buttons.fill(0);
      window.testPad.axes.fill(0);
    });
    await this.frames(2);
  }
  /** A change of the pad is read in the next frame and moves the robot in the one after. */
  async frames(count: number): Promise<void> {
    await this.page.evaluate(
      left =>
        new Promise<void>(done => {
          const next = (): void => {
            if (left-- <= 0) done();
            else requestAnimationFrame(next);
          };
          next();
        }),
      count,
    );
  }

  /**
   * Steers the tool tip with the left stick and the D-pad to a place in the world.
   * @param within_m  a coordinate counts as reached so near; a coordinate left out is not steered.
   */
  async steerTip(
    goal: { readonly x?: number; readonly y?: number; readonly z?: number },
    within_m: number,
  ): Promise<void> {
    await this.page.evaluate(
      ({ wanted, within }) =>
        new Promise<void>((arrived, lost) => {
          const pad = window.testPad;
          const started = performance.now();
          const calm = { frames: 0 };
          // Displacement to stick: full far away, then in proportion, always outside the dead zone.
          const thumb = (left: number): number =>
            Math.abs(left) < within / 3 ? 0 : Math.sign(left) * Math.min(1, 0.15 + Math.abs(left) * 17);
          const look = (): void => {
            const [x, y, z] = window.twincell.live.now().worldFromTcp.position;
            const dx = wanted.x === undefined ? 0 : wanted.x - x;
            const dy = wanted.y === undefined ? 0 : wanted.y - y;
            const dz = wanted.z === undefined ? 0 : wanted.z - z;
            const near = Math.max(Math.abs(dx), Math.abs(dy), Math.abs(dz)) <= within;
            calm.frames = near ? calm.frames + 1 : 0;
            pad.axes[0] = near ? 0 : thumb(dx);
            pad.axes[1] = near ? 0 : -thumb(dy);
            pad.buttons[12] = dz > within ? 1 : 0;
            pad.buttons[13] = dz < -within ? 1 : 0;
            if (calm.frames > 2) {
              arrived();
              return;
            }
            if (performance.now() - started > 40_000) {
              pad.axes.fill(0);
              pad.buttons.fill(0);
              lost(
                new Error(
                  `The tip is still ${(dx * 1000).toFixed(2)}, ${(dy * 1000).toFixed(2)}, ${(dz * 1000).toFixed(2)} mm away. ${window.twincell.stores.jogStore.getState().blocked?.sentence ?? ""}`,
                ),
              );
              return;
            }
            requestAnimationFrame(look);
          };
          look();
        }),
      { wanted: goal, within: within_m },
    );
  }

  /** Steers the joints, in the joint frame, one after the other, to angles [rad]. */
  async steerJoints(goal: readonly number[], within_rad: number): Promise<void> {
    await this.page.evaluate(
      ({ wanted, within }) =>
        new Promise<void>((arrived, lost) => {
          const pad = window.testPad;
          const started = performance.now();
          const turnButton = [1, 0, 2];
          let doing = "";
          const look = (): void => {
            const q = window.twincell.live.now().q_rad;
            const joint = wanted.findIndex((angle, i) => Math.abs(angle - q[i]!) > within);
            const left = joint < 0 ? 0 : wanted[joint]! - q[joint]!;
            const wish = joint < 0 ? "nothing" : `${joint} ${Math.sign(left)}`;
            if (wish !== doing || performance.now() - started > 60_000) {
              pad.axes.fill(0);
              pad.buttons.fill(0);
            }
            if (joint < 0) {
              requestAnimationFrame(() => arrived());
              return;
            }
            if (performance.now() - started > 60_000) {
              lost(new Error(`Joint ${joint + 1} is still ${left.toFixed(3)} rad away.`));
              return;
            }
            const thumb = Math.sign(left) * Math.min(1, 0.3 + Math.abs(left) * 4);
            if (joint === 0) pad.axes[0] = thumb;
            else if (joint === 1) pad.axes[1] = -thumb;
            else if (joint === 2) pad.buttons[left > 0 ? 12 : 13] = 1;
            // Turning back wants the shoulder button down first: one frame earlier.
            else if (left < 0 && wish !== doing) pad.buttons[4] = 1;
            else pad.buttons[turnButton[joint - 3]!] = 1;
            doing = wish;
            requestAnimationFrame(look);
          };
          look();
        }),
      { wanted: [...goal], within: within_rad },
    );
  }
}
