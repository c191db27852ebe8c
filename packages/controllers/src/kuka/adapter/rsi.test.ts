import { flangePose, type CommandOutcome } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { createRealController } from "../../driver/index.ts";
import { manualScheduler } from "../../testing/index.ts";
import { memoryNetwork, type DatagramSocket } from "../../transport/index.ts";
import { readRsi, rsiNumber, type RsiConfig, type RsiElement } from "../codec/rsi.ts";
import {
  axisConfig,
  createKukaRsiAdapter,
  createVirtualKuka,
  RSI_FILE,
  RSI_NAME,
  startLoop,
  type RsiOptions,
} from "../index.ts";
import { ended, HOST, interpretMoves, KR6 } from "../testing/bench.ts";

const CONFIG = axisConfig("127.0.0.1", 49_152);
const ACCURACY_RAD = (0.001 * Math.PI) / 180;
const shifted = (by_rad: number): number[] => Array.from(KR6.home_rad, (q, i) => (i === 4 ? q - by_rad : q + by_rad));
const farthest = (a: ArrayLike<number>, b: ArrayLike<number>): number =>
  Math.max(...Array.from(a, (q, i) => Math.abs(q - b[i]!)));
const codeOf = (outcome: CommandOutcome): string => (outcome.kind === "done" ? "done" : outcome.why.code);

async function robotSide(rsi: Partial<RsiOptions> = {}, mode: "EX" | "T1" = "EX") {
  const scheduler = manualScheduler();
  const network = memoryNetwork(scheduler, 5);
  const log: string[] = [];
  const kuka = await createVirtualKuka({
    robot: KR6,
    scheduler,
    network,
    host: HOST,
    interpret: interpretMoves,
    mode,
    rsi: { config: CONFIG, ...rsi },
    log: sentence => {
      log.push(sentence);
    },
  });
  return { scheduler, network, kuka, log };
}
async function driven(rsi: Partial<RsiOptions> = {}) {
  const bench = await robotSide(rsi);
  const { scheduler, network } = bench;
  startLoop(bench.kuka, RSI_NAME);
  const real = createRealController({
    face: createKukaRsiAdapter({ robot: KR6, scheduler, network, host: HOST, config: CONFIG }),
    scheduler,
  });
  const connecting = real.connect();
  await scheduler.elapse(0.1);
  expect(await connecting).toEqual({ kind: "done" });
  return { ...bench, real };
}
/** A sensor of the test's own: answers each telegram as it is told to. */
async function sensor(
  bench: Awaited<ReturnType<typeof robotSide>>,
  config: RsiConfig,
  answer: (ipoc: number, count: number) => string | null,
) {
  const got: { ipoc: number; delay: number; a1: number; x: number; at_s: number }[] = [];
  const bound = await bench.network.bind({ host: config.ip, port: config.port });
  if (bound.kind === "taken") throw new Error(bound.sentence);
  const socket: DatagramSocket = bound.socket;
  socket.onDatagram((lent, from) => {
    const read = readRsi(String.fromCharCode(...lent), "Rob");
    if (read.kind !== "telegram") throw new Error(read.sentence);
    got.push({
      ipoc: read.ipoc,
      delay: rsiNumber(read.values, "Delay.D"),
      a1: rsiNumber(read.values, "AIPos.A1"),
      x: rsiNumber(read.values, "RIst.X"),
      at_s: bench.scheduler.now_s(),
    });
    const text = answer(read.ipoc, got.length);
    if (text !== null)
      socket.send(
        Uint8Array.from(text, sign => sign.charCodeAt(0)),
        from,
      );
  });
  expect(startLoop(bench.kuka, RSI_NAME)).toBeNull();
  return got;
}
const sen = (ipoc: number, inside: string, type = "Twincell"): string =>
  `<Sen Type="${type}">${inside}<IPOC>${ipoc}</IPOC></Sen>`;
const element = (tag: string, index: number, holdOn: 0 | 1): RsiElement => ({ tag, type: "DOUBLE", index, holdOn });

describe("the robot's side", () => {
  test("a telegram every 4 ms with its own clock, or every 12 ms; increments add up", async () => {
    for (const cycle_s of [0.004, 0.012] as const) {
      const bench = await robotSide({ cycle_s });
      const got = await sensor(bench, CONFIG, (ipoc, count) => sen(ipoc, `<AKorr A1="${count <= 10 ? 0.1 : 0}"/>`));
      await bench.scheduler.elapse(1.2);
      expect(got.length).toBeGreaterThanOrEqual(Math.floor(1.2 / cycle_s) - 1);
      expect(got.length).toBeLessThanOrEqual(Math.ceil(1.2 / cycle_s) + 1);
      expect(new Set(got.slice(1).map(({ ipoc }, i) => ipoc - got[i]!.ipoc))).toEqual(new Set([1000 * cycle_s]));
      expect(got.at(-1)).toMatchObject({ delay: 0 });
      expect(got.at(-1)!.a1).toBeCloseTo(1, 6);
    }
  });

  test("absolute corrections are offsets from where RSI began; RKorr moves the flange", async () => {
    const config = { ...CONFIG, receive: [element("RKorr.X", 1, 0), element("AKorr.A1", 2, 0)] };
    const one = await robotSide({ mode: "absolute" });
    const a = await sensor(one, CONFIG, (ipoc, count) => sen(ipoc, `<AKorr A1="${Math.min(2, count * 0.1)}"/>`));
    await one.scheduler.elapse(0.5);
    expect(a.at(-1)!.a1).toBeCloseTo(2, 6);
    const two = await robotSide({ config });
    const r = await sensor(two, config, (ipoc, count) => sen(ipoc, `<RKorr X="${count <= 20 ? 0.5 : 0}"/>`));
    const from = flangePose(KR6.arm, two.kuka.arm.jointAngles());
    await two.scheduler.elapse(0.5);
    const to = flangePose(KR6.arm, two.kuka.arm.jointAngles());
    expect(r.at(-1)!.x - r[0]!.x).toBeCloseTo(10, 3);
    expect(
      [to.position[1] - from.position[1], to.position[2] - from.position[2]].every(by => Math.abs(by) < 1e-6),
    ).toBe(true);
  });

  test("HOLDON 1 leaves the last value in force when an answer is missing, 0 takes it away; both are counted as late", async () => {
    for (const [holdOn, wanted] of [
      [1, 2],
      [0, 1],
    ] as const) {
      const config = { ...CONFIG, receive: [element("AKorr.A1", 1, holdOn)] };
      const bench = await robotSide({ config });
      const got = await sensor(bench, config, (ipoc, count) =>
        count <= 10 ? sen(ipoc, '<AKorr A1="0.1"/>') : count <= 20 ? null : sen(ipoc, '<AKorr A1="0"/>'),
      );
      await bench.scheduler.elapse(0.3);
      expect(got.at(-1)!.a1).toBeCloseTo(wanted, 6);
      expect([got.at(-1)!.delay, bench.kuka.rsiDelay]).toEqual([10, 10]);
    }
  });

  test("an answer of somebody else, of another clock, or none at all is late; above the Timeout RSI breaks off and the robot stops", async () => {
    for (const wrong of [
      (ipoc: number) => sen(ipoc, '<AKorr A1="0.1"/>', "Somebody"),
      (ipoc: number) => sen(ipoc + 4, '<AKorr A1="0.1"/>'),
      () => "garbage <",
      () => null,
    ]) {
      const bench = await robotSide({ timeout: 20 });
      const got = await sensor(bench, CONFIG, wrong);
      await bench.scheduler.elapse(0.5);
      expect(got.length).toBe(21);
      expect(got.at(-1)).toMatchObject({ delay: 20, a1: 0 });
      expect(bench.kuka.messages.at(-1)?.text).toBe("RSI: 21 telegrams were late or wrong; 20 may be");
      expect([bench.kuka.program.state, bench.log.length <= 1]).toEqual(["STOP", true]);
    }
  });

  test("what goes beyond the limits of the corrections, of an axis, of its speed or of T1 ends RSI with the number", async () => {
    const after = async (
      rsi: Partial<RsiOptions>,
      inside: (count: number) => string,
      mode: "EX" | "T1" = "EX",
    ): Promise<string> => {
      const bench = await robotSide(rsi, mode);
      if (mode === "T1") bench.kuka.pendant.setEnabling(true);
      await sensor(bench, rsi.config ?? CONFIG, (ipoc, count) => sen(ipoc, inside(count)));
      await bench.scheduler.elapse(4);
      return bench.kuka.messages.at(-1)?.text ?? "";
    };
    expect(
      await after({ limits: { axes_deg: 5, position_mm: 5, rotation_deg: 5 } }, () => '<AKorr A1="-0.1"/>'),
    ).toMatch(/^RSI: the correction of A1 is -5\.\d+°; its limit is 5°$/);
    expect(await after({}, () => '<AKorr A2="1.0"/>')).toMatch(
      /^RSI: Joint 2 would turn to 4[56]\.\d°; its limit is 45\.0°/,
    );
    expect(await after({}, () => '<AKorr A2="2"/>')).toBe("RSI: A2 would turn at 500°/s; its limit is 300°/s");
    expect(await after({}, () => '<AKorr A1="0.5"/>', "T1")).toBe("RSI: faster than T1 allows");
    const config = { ...CONFIG, receive: [element("RKorr.X", 1, 0)] };
    expect(await after({ config }, () => '<RKorr X="4"/>')).toMatch(
      /RSI: (the corrected place is out of reach|A\d would turn)/,
    );
  });

  test("ONLYSEND: nothing is expected and nothing taken", async () => {
    const config = { ...CONFIG, onlySend: true };
    const bench = await robotSide({ config, timeout: 5 });
    const got = await sensor(bench, config, ipoc => sen(ipoc, '<AKorr A1="0.1"/>'));
    await bench.scheduler.elapse(0.5);
    expect(got.at(-1)).toMatchObject({ delay: 0, a1: 0 });
    expect(got.length).toBeGreaterThan(100);
  });

  test("the program for the controller: blocks closed, RSI on and off", () => {
    const lines = RSI_FILE.text.split("\r\n");
    expect(lines.filter(line => line.startsWith("DEF "))).toHaveLength(lines.filter(line => line === "END").length);
    for (const call of ["RSI_CREATE(", "RSI_ON(#RELATIVE)", "RSI_MOVECORR(", "RSI_OFF("])
      expect(RSI_FILE.text).toContain(call);
  });
});

describe("the driver over RSI", () => {
  test("T-23 KUKA: 250 states a second, commanded and measured angles agree to 0.001°", async () => {
    const bench = await driven();
    const { real, kuka, scheduler } = bench;
    await scheduler.elapse(2);
    expect(real.link.rate_Hz).toBe(250);
    for (const by of [0.4, -0.2, 0.1234567]) {
      expect(await ended(bench, real.moveJoints(shifted(by)))).toEqual({ kind: "done" });
      expect(farthest(kuka.arm.jointAngles(), shifted(by))).toBeLessThanOrEqual(ACCURACY_RAD);
      expect(farthest(real.jointAngles(), shifted(by))).toBeLessThanOrEqual(ACCURACY_RAD);
    }
    expect(kuka.rsiDelay).toBe(0);
  });

  test("one of twenty telegrams lost, some twice, some overtaken: the target is reached all the same", async () => {
    const bench = await driven({ timeout: 10_000 });
    const { real, kuka, network } = bench;
    Object.assign(network.weather, { loss: 0.05, duplicates: 0.05, jitter_s: 0.001 });
    expect(await ended(bench, real.moveJoints(shifted(0.5)))).toEqual({ kind: "done" });
    expect(farthest(kuka.arm.jointAngles(), shifted(0.5))).toBeLessThanOrEqual(ACCURACY_RAD);
    expect(kuka.rsiDelay).toBeGreaterThan(5);
    expect(real.link.missing).toBeGreaterThan(5);
  });

  test("X-41 KUKA over RSI: the line dies without a word: the robot stands within two cycles, RSI ends by its Timeout, nothing goes on afterwards", async () => {
    const bench = await driven();
    const { real, kuka, network, scheduler } = bench;
    const moving = real.moveJoints(shifted(0.6));
    expect(real.watchdog).toEqual({ kind: "robot", within_s: 0.4 });
    await scheduler.elapse(0.2);
    network.weather.frozen = true;
    await scheduler.elapse(0.012);
    const rest = kuka.arm.jointAngles();
    await scheduler.elapse(0.2);
    expect((await moving).kind).toBe("stopped");
    await scheduler.elapse(0.4);
    expect([kuka.arm.jointAngles(), kuka.program.state]).toEqual([rest, "STOP"]);
    network.weather.frozen = false;
    await scheduler.elapse(3);
    expect([real.isConnected, kuka.arm.jointAngles()]).toEqual([true, rest]);
    expect(codeOf(await real.moveToZero())).toBe("safety.protective-stop");
    void real.reset();
    await scheduler.elapse(0.3);
    expect(await ended(bench, real.moveJoints(shifted(0.1)))).toEqual({ kind: "done" });
  });

  test("T-27 KUKA over RSI: the gate ends the motion and says why; a stop brakes along the path", async () => {
    const bench = await driven();
    const { real, kuka, scheduler } = bench;
    const first = real.moveJoints(shifted(0.6));
    await scheduler.elapse(0.2);
    real.stop();
    expect((await ended(bench, first)).kind).toBe("stopped");
    const second = real.moveJoints(shifted(-0.3));
    await scheduler.elapse(0.2);
    kuka.pendant.setGuardOpen(true);
    expect((await ended(bench, second)).kind).toBe("stopped");
    await scheduler.elapse(0.2);
    expect(codeOf(await real.moveToZero())).toBe("safety.guard-stop");
    expect(farthest(real.jointAngles(), kuka.arm.jointAngles())).toBeLessThanOrEqual(ACCURACY_RAD);
  });

  test("X-41 KUKA over RSI: a stop reaches a text that the controller runs", async () => {
    const bench = await driven();
    const { real, kuka, scheduler } = bench;
    const running = real.runText!([
      { name: "JOB.src", text: "DEF JOB( )\nPTP 60 -90 90 0 0 0\nPTP -60 -90 90 0 0 0\nEND\n", lines: [] },
    ]);
    await scheduler.elapse(0.6);
    expect(kuka.arm.isMoving()).toBe(true);
    real.stop();
    await scheduler.elapse(kuka.arm.brakingTime_s + 0.06);
    expect(kuka.arm.isMoving()).toBe(false);
    expect((await ended(bench, running)).kind).toBe("stopped");
  });
});
