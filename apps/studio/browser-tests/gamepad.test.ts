import {
  orientationPresetAxis,
  compose,
  conjugate,
  degrees,
  distance,
  dot,
  flangePose,
  multiply,
  radians,
  robotById,
  rotate,
  type Quaternion,
  type Vector3,
} from "@twincell/core";
import { proveText, vPlus } from "@twincell/languages";
import { edgeTraceCell } from "@twincell/project";
import { readFile } from "node:fs/promises";
import { afterAll, beforeAll, beforeEach, describe, expect, test } from "vitest";
import { Pad, PAD_SCRIPT } from "./support/pad.ts";
import { picture, Studio, type StudioPage } from "./support/studio.ts";

const cell = edgeTraceCell();
const robot = robotById(cell.robot.id)!;
const { flangeFromTcp } = cell.tools[0]!;
const carton = cell.objects.find(object => object.id === "carton")!.worldFromObject;
/** Above the carton's right far corner, the torch leaning in from the far side: away from limits and singularities. */
const WORK_RAD = [-8, 0, 135, -5, 86, 85].map(radians);
/** How near to a wanted place a thumb steers. */
const BY_HAND_M = 0.0003;
/** A small picture has many frames a second where the processor draws it. */
const SMALL = { width: 920, height: 420 };
/** Counts the tones a page starts, behind the sound store. */
const EARS =
  "{const start=OscillatorNode.prototype.start;window.tonesStarted=0;OscillatorNode.prototype.start=function(when){window.tonesStarted++;return start.call(this,when)}}";
declare global {
  interface Window {
    tonesStarted: number;
  }
}

let studio: Studio;
let open: StudioPage;
let pad: Pad;
beforeAll(async () => {
  studio = await Studio.start();
  open = await studio.open({ ...SMALL, script: PAD_SCRIPT + EARS });
  await open.page.waitForFunction(
    () => window.twincell?.stores.cellStore.getState().document !== null && window.twincellScene !== undefined,
  );
  pad = new Pad(open.page);
  await pad.plug();
});
afterAll(async () => {
  await studio?.stop();
});
beforeEach(async () => {
  await pad.letGo();
  await open.page.evaluate(q => {
    window.twincell.stores.jogStore.setState({ frame: "world", manner: "hold", speed: 0.5, aid: null, blocked: null });
    window.twincell.live.showJoints(q);
  }, WORK_RAD);
});

interface Tip {
  readonly position: Vector3;
  readonly quaternion: Quaternion;
}
const tipNow = (): Promise<Tip> =>
  open.page.evaluate(() => {
    const { position, quaternion } = window.twincell.live.now().worldFromTcp;
    return { position: [...position], quaternion: [...quaternion] } as Tip;
  });
/** Metres along x y z of the world and radians about them from one pose to the other. */
function moved(from: Tip, to: Tip): number[] {
  const turn = multiply(to.quaternion, conjugate(from.quaternion));
  const side = Math.sign(turn[3]) || 1;
  return [0, 1, 2].map(i => to.position[i]! - from.position[i]!).concat([0, 1, 2].map(i => 2 * side * turn[i]!));
}

describe("what each control of the pad does", () => {
  interface Row {
    readonly name: string;
    readonly first?: number;
    readonly button?: number;
    readonly stick?: readonly [axis: number, value: number];
    readonly coordinate: number;
    readonly sign: 1 | -1;
  }
  const rows: readonly Row[] = [
    { name: "N-25 button 0 turns about +Y", button: 0, coordinate: 4, sign: 1 },
    { name: "N-26 button 1 turns about +X", button: 1, coordinate: 3, sign: 1 },
    { name: "N-27 button 2 turns about +Z", button: 2, coordinate: 5, sign: 1 },
    { name: "N-28 button 4, then 0, turns about −Y", first: 4, button: 0, coordinate: 4, sign: -1 },
    { name: "N-29 button 4, then 1, turns about −X", first: 4, button: 1, coordinate: 3, sign: -1 },
    { name: "N-30 button 4, then 2, turns about −Z", first: 4, button: 2, coordinate: 5, sign: -1 },
    { name: "N-37 left stick to the right moves along +X", stick: [0, 0.8], coordinate: 0, sign: 1 },
    { name: "N-37 left stick to the left moves along −X", stick: [0, -0.8], coordinate: 0, sign: -1 },
    { name: "N-37 left stick up moves along +Y", stick: [1, -0.8], coordinate: 1, sign: 1 },
    { name: "N-37 left stick down moves along −Y", stick: [1, 0.8], coordinate: 1, sign: -1 },
    { name: "N-37 D-pad up moves along +Z", button: 12, coordinate: 2, sign: 1 },
    { name: "N-37 D-pad down moves along −Z", button: 13, coordinate: 2, sign: -1 },
  ];
  test.each(rows)("$name", async ({ first, button, stick, coordinate, sign }) => {
    const before = await tipNow();
    if (first !== undefined) await pad.button(first, 1);
    if (button !== undefined) await pad.button(button, 1);
    if (stick) await pad.stick(...stick);
    await pad.letGo();
    const change = moved(before, await tipNow());
    for (const [i, by] of change.entries()) {
      if (i === coordinate) expect(sign * by, `coordinate ${i}`).toBeGreaterThan(0.0005);
      else expect(Math.abs(by), `coordinate ${i}`).toBeLessThan(1e-6);
    }
  });

  test("N-28 a turning button that was down before button 4 goes on as it was", async () => {
    await pad.button(0, 1);
    await pad.button(4, 1);
    const before = await tipNow();
    await pad.frames(3);
    expect(moved(before, await tipNow())[4]).toBeGreaterThan(0.0005);
  });

  test("N-38 a resting stick does not creep, and a number that is none moves nothing", async () => {
    const before = await tipNow();
    await pad.stick(0, 0.12);
    await pad.stick(1, Number.NaN);
    await pad.frames(3);
    expect(await tipNow()).toEqual(before);
  });

  test("N-31, N-35 buttons 3 and 8 cycle the orientation aids forwards and backwards", async () => {
    const aid = (): Promise<number | null> => open.page.evaluate(() => window.twincell.stores.jogStore.getState().aid);
    const leaning = (index: number): Promise<unknown> =>
      open.page.waitForFunction(
        ([x, y, z]) => {
          const [qx, qy, qz, qw] = window.twincell.live.now().worldFromTcp.quaternion;
          return (
            2 * (qx * qz + qw * qy) * x + 2 * (qy * qz - qw * qx) * y + (1 - 2 * (qx * qx + qy * qy)) * z >
            Math.cos(0.001)
          );
        },
        orientationPresetAxis(carton, index),
      );
    for (const [button, index] of [
      [3, 0],
      [3, 1],
      [8, 0],
      [8, 3],
      [3, 0],
    ] as const) {
      await pad.press(button);
      expect(await aid()).toBe(index);
      await leaning(index);
    }
  });

  test("N-32 button 5 records the joints as they are, and the V+ text says them", async () => {
    await pad.press(5);
    const q = await open.page.evaluate(() => [...window.twincell.live.now().q_rad]);
    const steps = await open.page.evaluate(
      () =>
        window.twincell.stores.cellStore
          .getState()
          .document!.programs.filter(program => program.format === "twincell.program")[0]!.steps,
    );
    expect(steps.at(-1)).toMatchObject({ type: "move", path: "ptp", target: { q, tool: "torch" } });
    await open.page.evaluate(() => window.twincell.document.undo());
  });

  test("N-34 button 9 is Do Ready", async () => {
    await pad.press(9);
    await open.page.waitForFunction(
      home => home.every((angle, i) => Math.abs(angle - window.twincell.live.now().q_rad[i]!) < 1e-9),
      [...robot.home_rad],
    );
  });

  /** Where the close camera of the last frame stands seen from the TCP, in the world [m]. */
  const closeFromTcp = (): Promise<readonly [number, number, number]> =>
    open.page.evaluate(async () => {
      await new Promise(resolve => requestAnimationFrame(() => requestAnimationFrame(resolve)));
      const { x, y, z } = window.twincellScene!.closeCamera.position;
      const [px, py, pz] = window.twincell.live.now().worldFromTcp.position;
      return [x - px, -z - py, y - pz] as const;
    });

  test("N-36, N-42, N-45 button 11 changes to the close camera, at the height of the TCP or 0.5, 0.5, 0.1 m from it, and back", async () => {
    const fromTip = (): Promise<number> =>
      open.page.evaluate(() => {
        const { x, y, z } = window.twincellScene!.camera.position;
        const [px, py, pz] = window.twincell.live.now().worldFromTcp.position;
        return Math.hypot(x - px, -z - py, y - pz);
      });
    const away = await fromTip();
    await pad.press(11);
    expect(await open.page.evaluate(() => window.twincell.stores.viewStore.getState().camera)).toBe("close");
    await expect.poll(async () => Math.abs((await closeFromTcp())[2])).toBeLessThan(1e-9);
    await open.page.evaluate(() => window.twincell.run("view.closePlacement"));
    await expect
      .poll(async () => (await closeFromTcp()).map(each => Math.round(Math.abs(each) * 1e9) / 1e9))
      .toEqual([0.5, 0.5, 0.1]);
    await open.page.evaluate(() => window.twincell.run("view.closePlacement"));
    await pad.press(11);
    expect(await open.page.evaluate(() => window.twincell.stores.viewStore.getState().camera)).toBe("main");
    expect(Math.abs((await fromTip()) - away)).toBeLessThan(1e-6);
  });

  test("N-33, N-44 trigger 7 tilts the view of the close camera from 0 to 90°", async () => {
    const tilt = async (): Promise<number> => {
      const [x, y, z] = await closeFromTcp();
      return Math.atan2(z, Math.hypot(x, y));
    };
    for (const [pressed, deg] of [
      [0.5, 45],
      [1, 90],
      [0.25, 22.5],
      [0, 0],
    ] as const) {
      await pad.button(7, pressed);
      await expect.poll(async () => Math.round(degrees(await tilt()) * 1e6) / 1e6).toBe(deg);
    }
  });
});

describe("the edge of reach", () => {
  interface Frame {
    readonly now_ms: number;
    readonly q: readonly number[];
    readonly until_ms: number;
    readonly sounds: number;
  }
  /**
   * Holds a stick until a limit is met, pulls it back at once, and watches every frame until the lock is over and a few
   * more.
   */
  const watch = (axis: number, value: number): Promise<{ readonly frames: readonly Frame[]; readonly drawn: number }> =>
    open.page.evaluate(
      ([stick, push]) =>
        new Promise((resolve, reject) => {
          const frames: Frame[] = [];
          const { jogStore, soundStore } = window.twincell.stores;
          const drawn = window.twincellScene!.frames;
          let after = 0;
          const look = (now_ms: number): void => {
            const until_ms = jogStore.getState().blocked?.until_ms ?? 0;
            frames.push({
              now_ms,
              q: [...window.twincell.live.now().q_rad],
              until_ms,
              sounds: soundStore.getState().played.limit,
            });
            window.testPad.axes[stick] = until_ms > 0 || after > 0 ? -push : push;
            if (frames.some(frame => frame.until_ms > 0 && now_ms > frame.until_ms)) after++;
            if (after > 4) {
              window.testPad.axes[stick] = 0;
              resolve({ frames, drawn: window.twincellScene!.frames - drawn });
              return;
            }
            if (frames.length > 3000) {
              reject(new Error("No limit was met."));
              return;
            }
            requestAnimationFrame(look);
          };
          requestAnimationFrame(look);
        }),
      [axis, value] as const,
    );

  test("N-39, N-40 at a joint limit: that joint stops, a sound, 500 ms to let go while frames go on, and the panel says which", async () => {
    const start = WORK_RAD.with(0, radians(158.5));
    await open.page.evaluate(q => {
      window.twincell.stores.jogStore.setState({ frame: "joint" });
      window.twincell.live.showJoints(q);
    }, start);
    const tones = await open.page.evaluate(() => window.tonesStarted);
    const sounds = await open.page.evaluate(() => window.twincell.stores.soundStore.getState().played.limit);
    const panel = open.page
      .locator(".pendant-blocked")
      .waitFor()
      .then(() => open.page.locator(".pendant-blocked").textContent());
    const { frames, drawn } = await watch(0, 1);
    expect(await panel).toMatch(/joint 1.*160(\.0+)?°/i);
    const met = frames.findIndex(frame => frame.until_ms > 0);
    const first = frames[met]!;
    expect(degrees(first.q[0]!)).toBeLessThanOrEqual(160 + 1e-6);
    expect(degrees(first.q[0]!)).toBeGreaterThan(159.9);
    expect(first.sounds).toBe(sounds + 1);
    expect(await open.page.evaluate(() => window.tonesStarted)).toBeGreaterThan(tones);
    const locked = frames.filter(frame => frame.now_ms >= first.now_ms && frame.now_ms < first.until_ms);
    // The jogger may have met the limit in the same frame or in the one before this observer saw it.
    const since = frames[met - 1]!.now_ms;
    expect(first.until_ms - since).toBeGreaterThanOrEqual(500 - 20);
    expect(first.until_ms - first.now_ms).toBeLessThanOrEqual(500 + 20);
    expect(locked.length).toBeGreaterThan(1);
    expect(drawn).toBeGreaterThan(1);
    for (const frame of locked) expect(frame.q).toEqual(first.q);
    expect(frames.at(-1)!.q[0]!).toBeLessThan(first.q[0]!);
    expect(frames.at(-1)!.sounds).toBe(sounds + 1);
  });

  test("N-39 where the reach ends one coordinate is blocked and the other goes on", async () => {
    await open.page.evaluate(() => window.twincell.stores.jogStore.setState({ speed: 1 }));
    await pad.stick(0, 1);
    await open.page.waitForFunction(() => {
      const { blocked } = window.twincell.stores.jogStore.getState();
      return blocked !== null && performance.now() > blocked.until_ms;
    });
    expect(await open.page.locator(".pendant-blocked").textContent()).toMatch(/\d.*\.$/);
    const before = await tipNow();
    await pad.frames(4);
    // What did not fit was the step of one longest frame, 0.1 s at 250 mm/s: no more than that may be left.
    const held = moved(before, await tipNow());
    expect(held[0]).toBeLessThan(0.025);
    expect(Math.hypot(held[1]!, held[2]!)).toBeLessThan(1e-6);
    // Back towards the middle there is room.
    const side = Math.sign(before.position[1]);
    const at = await tipNow();
    await pad.stick(1, side);
    await pad.frames(3);
    expect(-side * moved(at, await tipNow())[1]!).toBeGreaterThan(0.0005);
  });
});

test("N-24 a pad that is pulled while it moves the robot stops it, says so once, and the page lives on", async () => {
  await pad.stick(0, 0.6);
  const before = await tipNow();
  await pad.frames(3);
  expect(moved(before, await tipNow())[0]).toBeGreaterThan(0.0005);
  await pad.pull();
  await pad.frames(2);
  const stopped = await tipNow();
  await pad.frames(5);
  expect(await tipNow()).toEqual(stopped);
  expect(
    await open.page.evaluate(() =>
      window.twincell.stores.noticeStore
        .getState()
        .notices.filter(notice => notice.tone === "warn")
        .map(notice => notice.sentence),
    ),
  ).toEqual(["The gamepad was disconnected; the robot was stopped."]);
  await open.page.keyboard.press("Control+k");
  await open.page.getByRole("dialog").waitFor();
  await open.page.keyboard.press("Escape");
  await open.page.evaluate(() => window.testPad.axes.fill(0));
  await pad.plug();
  await pad.stick(0, -0.6);
  await pad.frames(3);
  expect(moved(stopped, await tipNow())[0]).toBeLessThan(-0.0005);
  expect(open.problems).toEqual([]);
});

test("N-53 N-54 N-55 the four top edges of the carton at 45° by pad, as V+ text that lies on them", async () => {
  const { page, problems } = await studio.open({ ...SMALL, script: PAD_SCRIPT });
  await page.waitForFunction(() => window.twincell?.stores.cellStore.getState().document !== null);
  const hands = new Pad(page);
  await hands.plug();
  const {
    position: [cx, cy, cz],
  } = carton;
  const corner = (x: 1 | -1, y: 1 | -1): Vector3 => [cx + x * 0.15, cy + y * 0.2, cz + 0.1];
  const corners = [corner(1, -1), corner(1, 1), corner(-1, 1), corner(-1, -1)];
  const jog = (change: { readonly frame?: "joint" | "world"; readonly speed?: number }): Promise<void> =>
    page.evaluate(next => window.twincell.stores.jogStore.setState(next), change);

  await hands.press(9);
  await jog({ frame: "joint", speed: 1 });
  await page.waitForFunction(
    home => home.every((angle, i) => Math.abs(angle - window.twincell.live.now().q_rad[i]!) < 1e-9),
    [...robot.home_rad],
  );
  await hands.steerJoints(WORK_RAD, radians(4));
  await jog({ frame: "world" });

  const taught: { readonly from: Vector3; readonly to: Vector3; readonly outwards: number }[] = [];
  for (const [edge, from] of corners.entries()) {
    const to = corners[(edge + 1) % 4]!;
    await hands.press(3);
    await page.waitForFunction(
      ([[x, y, z], index]) => {
        const [qx, qy, qz, qw] = window.twincell.live.now().worldFromTcp.quaternion;
        return (
          window.twincell.stores.jogStore.getState().aid === index &&
          2 * (qx * qz + qw * qy) * x + 2 * (qy * qz - qw * qx) * y + (1 - 2 * (qx * qx + qy * qy)) * z >
            Math.cos(0.0005)
        );
      },
      [orientationPresetAxis(carton, edge), edge] as const,
    );
    await hands.frames(3);
    await hands.steerTip({ x: from[0], y: from[1] }, BY_HAND_M);
    // The D-pad knows only on and off: the last millimetres want a slower pendant.
    for (const [speed, near] of [
      [0.5, 0.013],
      [0.1, 0.0027],
      [0.01, BY_HAND_M],
    ] as const) {
      await jog({ speed });
      await hands.steerTip({ z: from[2] }, near);
    }
    await jog({ speed: 1 });
    await hands.press(5);
    await hands.steerTip({ x: to[0], y: to[1] }, BY_HAND_M);
    await hands.press(5);
    taught.push({ from, to, outwards: edge }, { from, to, outwards: edge });
  }

  await page.setViewportSize({ width: 1280, height: 800 });
  await hands.frames(4);
  await page.screenshot({ path: picture("gamepad-four-edges") });
  await page.keyboard.press("Control+e");
  const saved = page.waitForEvent("download", download => download.suggestedFilename().endsWith(".v2"));
  await page.getByRole("button", { name: "Single files" }).click();
  const text = await readFile(await (await saved).path(), "utf8");
  const program = await page.evaluate(
    () =>
      window.twincell.stores.cellStore
        .getState()
        .document!.programs.filter(program => program.format === "twincell.program")[0]!,
  );
  expect(program.steps).toHaveLength(8);
  expect(proveText(vPlus, { name: "edges.v2", text }, program, robot, cell.robot.worldFromBase)).toMatchObject({
    kind: "proven",
  });

  const interpreted = vPlus.interpret(text, robot, cell.robot.worldFromBase);
  if (interpreted.kind !== "ready") throw new Error(interpreted.faults[0]?.sentence);
  const said: readonly number[][] = [...{ [Symbol.iterator]: interpreted.run }].flatMap(({ step }) =>
    step?.type === "move" && "q" in step.target ? [[...step.target.q]] : [],
  );
  expect(said).toHaveLength(8);
  for (const [i, q] of said.entries()) {
    const { from, to, outwards } = taught[i]!;
    const tip = compose(compose(cell.robot.worldFromBase, flangePose(robot.arm, q)), flangeFromTcp);
    expect(offEdge(tip.position, from, to), `point ${i + 1} from its edge`).toBeLessThan(0.0005);
    expect(distance(tip.position, i % 2 === 0 ? from : to), `point ${i + 1} from its corner`).toBeLessThan(0.001);
    expect(
      degrees(Math.acos(Math.min(1, dot(rotate(tip.quaternion, [0, 0, 1]), orientationPresetAxis(carton, outwards))))),
      `point ${i + 1} leans`,
    ).toBeLessThan(0.1);
  }
  expect(problems).toEqual([]);
  await page.context().close();
});

/** Distance of a point from the straight line through two others [m]. */
function offEdge(point: Vector3, from: Vector3, to: Vector3): number {
  const length = distance(from, to);
  const along = [0, 1, 2].reduce((sum, i) => sum + (point[i]! - from[i]!) * (to[i]! - from[i]!), 0) / length;
  return Math.sqrt(Math.max(0, distance(point, from) ** 2 - along ** 2));
}
