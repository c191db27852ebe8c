import type { Vector3 } from "@twincell/core";
import type { XRDevice } from "iwer";
import type { Page } from "playwright-core";

declare global {
  interface Window {
    readonly xrDevice: XRDevice;
  }
}

export type Side = "left" | "right";
type Turn = readonly [number, number, number, number];

/**
 * A person in an emulated headset: everything is said in the z-up world, and waits for rendered frames, never for time.
 */
export class Person {
  readonly page: Page;
  constructor(page: Page) {
    this.page = page;
  }

  /**
   * Enters as a person does, with the button, and waits until the two hands are there. The emulated display is as large
   * as the emulator believes the window to be: small, since every pixel of it is drawn by the processor.
   */
  async enter(width = 400, height = 240, hands = 2): Promise<void> {
    const kept = await this.page.evaluateHandle(
      ([w, h]) => {
        const own = {
          innerWidth: Object.getOwnPropertyDescriptor(window, "innerWidth")!,
          innerHeight: Object.getOwnPropertyDescriptor(window, "innerHeight")!,
        };
        Object.defineProperties(window, {
          innerWidth: { value: w, configurable: true },
          innerHeight: { value: h, configurable: true },
        });
        return own;
      },
      [width, height] as const,
    );
    // Sent, not aimed: a page drawn in software takes long to stand still for a pointer.
    await this.page.getByRole("button", { name: "Headset" }).dispatchEvent("click");
    await this.page.waitForFunction(
      count =>
        window.twincell.stores.viewStore.getState().inHeadset &&
        window.twincellScene!.gl.xr.getSession()?.inputSources.length === count,
      hands,
      { timeout: 120_000 },
    );
    await kept.evaluate(own => {
      Object.defineProperties(window, own);
    });
    await this.page.waitForFunction(
      () => window.twincellScene!.scene.getObjectByName("wrist-panel") !== undefined,
      null,
      { timeout: 120_000 },
    );
    await this.frames(4);
  }

  /** Frames inside the headset; outside, where nothing is drawn while nothing changes, there is nothing to wait for. */
  async frames(count = 2): Promise<void> {
    const until = await this.page.evaluate(more => window.twincellScene!.frames + more, count);
    await this.page.waitForFunction(
      all => window.twincellScene!.frames >= all || !window.twincellScene!.gl.xr.isPresenting,
      until,
      { timeout: 120_000 },
    );
  }

  /** Where a point of the world is for the headset. */
  async inRoom(world: Vector3): Promise<Vector3> {
    return this.page.evaluate(([x, y, z]) => {
      const origin = window.twincellScene!.scene.getObjectByName("standing-place")!;
      origin.updateWorldMatrix(true, false);
      const { x: a, y: b, z: c } = origin.worldToLocal(origin.position.clone().set(x, z, -y));
      return [a, b, c];
    }, world);
  }
  async inWorld(room: Vector3): Promise<Vector3> {
    return this.page.evaluate(([x, y, z]) => {
      const origin = window.twincellScene!.scene.getObjectByName("standing-place")!;
      origin.updateWorldMatrix(true, false);
      const { x: a, y: b, z: c } = origin.localToWorld(origin.position.clone().set(x, y, z));
      return [a, -c, b];
    }, room);
  }

  /** What the session itself says of a hand: its grip, or the middle between thumb and index. Room coordinates. */
  async holds(side: Side): Promise<Vector3> {
    return this.page.evaluate(
      which =>
        new Promise<Vector3>((resolve, reject) => {
          const { xr } = window.twincellScene!.gl;
          const session = xr.getSession()!;
          session.requestAnimationFrame((_, frame) => {
            const source = [...session.inputSources].find(each => each.handedness === which);
            const space = xr.getReferenceSpace()!;
            if (source?.hand) {
              const a = frame.getJointPose!(source.hand.get("thumb-tip")!, space)!.transform.position;
              const b = frame.getJointPose!(source.hand.get("index-finger-tip")!, space)!.transform.position;
              resolve([(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2]);
              return;
            }
            const grip = source?.gripSpace && frame.getPose(source.gripSpace, space);
            if (!grip) {
              reject(new Error(`The ${which} hand is not tracked.`));
              return;
            }
            const { x, y, z } = grip.transform.position;
            resolve([x, y, z]);
          });
        }),
      side,
    );
  }

  /** Brings a hand so that what it holds with is at a place of the world. */
  async reach(side: Side, world: Vector3): Promise<void> {
    const [wanted, holds] = [await this.inRoom(world), await this.holds(side)];
    await this.shift(side, [wanted[0] - holds[0], wanted[1] - holds[1], wanted[2] - holds[2]]);
  }
  /** Moves a hand by a way in the room and waits until it was seen there. */
  async shift(side: Side, way: Vector3): Promise<void> {
    await this.page.evaluate(
      ([which, [x, y, z]]) => {
        const { hands, controllers, primaryInputMode } = window.xrDevice;
        const { position } = (primaryInputMode === "hand" ? hands : controllers)[which]!;
        position.set(position.x + x, position.y + y, position.z + z);
      },
      [side, way] as const,
    );
    await this.frames();
  }
  /** Carries a hand by a way in the world, in steps that a hand can make between two frames. */
  async carry(side: Side, way: Vector3, step_m = 0.08): Promise<void> {
    const [from, to] = [await this.inRoom([0, 0, 0]), await this.inRoom(way)];
    const steps = Math.max(1, Math.ceil(Math.hypot(...way) / step_m));
    for (let i = 0; i < steps; i++) await this.shift(side, [0, 1, 2].map(k => (to[k]! - from[k]!) / steps) as Vector3);
  }

  /** Nothing is pressed any more. */
  async letGo(): Promise<void> {
    await this.page.evaluate(() => {
      const { controllers, hands } = window.xrDevice;
      for (const controller of [controllers.left, controllers.right])
        for (const button of controller?.gamepadConfig.buttons ?? [])
          if (button) controller?.updateButtonValue(button.id, 0);
      for (const hand of [hands.left, hands.right]) hand?.updatePinchValue(0);
    });
    await this.frames();
  }
  async squeeze(side: Side, value: 0 | 1): Promise<void> {
    await this.button(side, "squeeze", value);
  }
  async trigger(side: Side, value: 0 | 1): Promise<void> {
    await this.button(side, "trigger", value);
  }
  async button(side: Side, name: string, value: number): Promise<void> {
    await this.page.evaluate(([which, what, how]) => window.xrDevice.controllers[which]!.updateButtonValue(what, how), [
      side,
      name,
      value,
    ] as const);
    await this.frames(3);
  }
  async pinch(side: Side, value: 0 | 1): Promise<void> {
    await this.page.evaluate(([which, how]) => window.xrDevice.hands[which]!.updatePinchValue(how), [
      side,
      value,
    ] as const);
    await this.frames(8);
  }

  /** Place and size of a key of the wrist panel, by its id. Room coordinates; size in metres. */
  async key(
    id: string,
  ): Promise<{ readonly at: Vector3; readonly normal: Vector3; readonly width_m: number; readonly height_m: number }> {
    return this.page
      .evaluate(wanted => {
        const { scene } = window.twincellScene!;
        const origin = scene.getObjectByName("standing-place")!;
        const found: typeof scene.children = [];
        scene.traverse(each => {
          if ((each as unknown as { properties?: { value?: { id?: string } } }).properties?.value?.id === wanted)
            found.push(each);
        });
        const key = found[0];
        if (!key) throw new Error(`There is no key "${wanted}".`);
        key.updateWorldMatrix(true, false);
        const place = origin.matrixWorld.clone().invert().multiply(key.matrixWorld);
        const { elements: e } = place;
        const length = (k: number): number => Math.hypot(e[k]!, e[k + 1]!, e[k + 2]!);
        const z = length(8);
        return {
          at: [e[12]!, e[13]!, e[14]!],
          normal: [e[8]! / z, e[9]! / z, e[10]! / z],
          width_m: length(0),
          height_m: length(4),
        } as const;
      }, id)
      .then(({ at, normal, ...size }) => ({ at: [...at] as Vector3, normal: [...normal] as Vector3, ...size }));
  }

  /** Place of a thing of the scene by its name, with the way along its width. Room coordinates. */
  async place(name: string): Promise<{ readonly at: Vector3; readonly normal: Vector3; readonly along: Vector3 }> {
    return this.page
      .evaluate(wanted => {
        const { scene } = window.twincellScene!;
        const thing = scene.getObjectByName(wanted);
        const origin = scene.getObjectByName("standing-place")!;
        if (!thing) throw new Error(`There is no "${wanted}" in the scene.`);
        thing.updateWorldMatrix(true, false);
        const { elements: e } = origin.matrixWorld.clone().invert().multiply(thing.matrixWorld);
        const z = Math.hypot(e[8]!, e[9]!, e[10]!);
        return {
          at: [e[12]!, e[13]!, e[14]!],
          normal: [e[8]! / z, e[9]! / z, e[10]! / z],
          along: [e[0]!, e[1]!, e[2]!],
        } as const;
      }, name)
      .then(({ at, normal, along }) => ({
        at: [...at] as Vector3,
        normal: [...normal] as Vector3,
        along: [...along] as Vector3,
      }));
  }

  /** Points the ray of a hand at a place from a hand's breadth before it. */
  async pointAt(side: Side, { at, normal }: { readonly at: Vector3; readonly normal: Vector3 }): Promise<void> {
    const from = at.map((value, k) => value + 0.25 * normal[k]!) as Vector3;
    await this.page.evaluate(
      ([which, place, turn]) => {
        const { position, quaternion } = window.xrDevice.controllers[which]!;
        position.set(...place);
        quaternion.set(turn[0], turn[1], turn[2], turn[3]);
      },
      [side, from, ahead(normal.map(value => -value) as Vector3)] as const,
    );
    await this.frames(3);
  }

  /** Points the ray of a hand at a key and pulls the trigger. */
  async press(side: Side, id: string): Promise<void> {
    await this.pointAt(side, await this.key(id));
    await this.trigger(side, 1);
    await this.trigger(side, 0);
    await this.page.evaluate(which => {
      window.xrDevice.controllers[which]!.quaternion.set(0, 0, 0, 1);
    }, side);
    await this.frames();
  }

  /** Opens a tab of the plate on the wrist, and a page of it, counted from 1. */
  async open(tab: "teach" | "check" | "run" | "cell" | "history", page = 1): Promise<void> {
    await this.press("right", `tab-${tab}`);
    for (let i = 1; i < page; i++) await this.press("right", "more");
  }

  async tcp(): Promise<Vector3> {
    return this.page.evaluate(() => {
      const [x, y, z] = window.twincell.live.now().worldFromTcp.position;
      return [x, y, z];
    });
  }
}

/** The shortest turn of −z onto a direction. */
function ahead([x, y, z]: Vector3): Turn {
  const w = 1 - z;
  const length = Math.hypot(y, -x, w);
  return length < 1e-9 ? [0, 1, 0, 0] : [y / length, -x / length, 0, w / length];
}
