import { createRealController, memoryNetwork, type ByteStream } from "@twincell/controllers";
import { flangePose, manualScheduler, robotById, type CommandOutcome, type Pose, type Step } from "@twincell/core";
import { readConnectionRequest, type ConnectionRequest, type ConnectionEvent } from "@twincell/protocol";
import { expect, test } from "vitest";
import { createPlugInAdapter } from "./plug-in-face.ts";

const robot = robotById("yaskawa_gp8")!;
const HOST = "127.0.0.9";
const PORT = 7077;

/** A plug-in in memory that takes every step, but those it is told to refuse, and writes down what it was asked. */
async function bench(refused: readonly string[] = []) {
  const scheduler = manualScheduler();
  const network = memoryNetwork(scheduler);
  const steps: Record<string, unknown>[] = [];
  const faults: string[] = [];
  let line: ByteStream | null = null;
  let rest = "";
  let sequence = 0;
  const tell = (message: ConnectionEvent): void => {
    line?.send(new TextEncoder().encode(`${JSON.stringify(message)}\n`));
  };
  const answer = (ask: ConnectionRequest): void => {
    if (ask.type === "ping") {
      tell({ type: "pong", sent_s: ask.sent_s, host_s: scheduler.now_s() });
      return;
    }
    if (!("id" in ask)) return;
    if (ask.type === "open")
      tell({
        type: "opened",
        id: "robot",
        name: "Taker",
        brand: "taker",
        robot: robot.id,
        virtual: false,
        watchdog: "",
      });
    const [step] = ask.type === "run" ? (ask.program as { steps: Record<string, unknown>[] }).steps : [];
    if (step) steps.push(step);
    tell({
      type: "answer",
      id: ask.id,
      outcome:
        step && refused.includes(String(step["type"]))
          ? {
              kind: "refused",
              why: { code: "taker.no", sentence: `The taker has no ${String(step["type"])}.`, hint: "" },
            }
          : { kind: "done" },
    });
  };
  await network.listen({ host: HOST, port: PORT }, stream => {
    line = stream;
    tell({ type: "hello", protocol: 2, version: "", brands: [], stations: [] });
    stream.onBytes(lent => {
      const texts = (rest + new TextDecoder().decode(lent)).split("\n");
      rest = texts.pop()!;
      for (const text of texts) {
        const heard = readConnectionRequest(text);
        if (heard.kind === "read") answer(heard.message);
        else faults.push(heard.sentence);
      }
    });
  });
  scheduler.every(0.02, () => {
    tell({
      type: "sample",
      station: "robot",
      sequence: ++sequence,
      time_s: scheduler.now_s(),
      sent_s: scheduler.now_s(),
      q_rad: [...robot.home_rad],
      moving: false,
      mode: "remote",
      safety: "normal",
      override: 1,
      gripperClosed: false,
      step: "",
      message: "",
      plan_rad: null,
      command_rad: null,
    });
  });
  const real = createRealController({
    face: createPlugInAdapter({ robot, scheduler, network, host: HOST, ports: { "plug-in": PORT } }),
    scheduler,
  });
  const messages: string[] = [];
  real.onSample(({ message }) => {
    if (message !== "" && messages.at(-1) !== message) messages.push(message);
  });
  const ended = async (command: Promise<CommandOutcome>): Promise<CommandOutcome> => {
    let outcome: CommandOutcome | undefined;
    void command.then(is => {
      outcome = is;
    });
    for (let t = 0; t < 20 && !outcome; t += 0.05) await scheduler.elapse(0.05);
    if (!outcome) throw new Error("The command took more than 20 s.");
    return outcome;
  };
  expect(await ended(real.connect())).toEqual({ kind: "done" });
  const at = flangePose(robot.arm, robot.home_rad);
  const place = (dy: number, dz: number) => ({
    pose: {
      position: [at.position[0], at.position[1] + dy, at.position[2] + dz],
      quaternion: at.quaternion,
    } as Pose as Pose<"frame", "tcp">,
    frame: "world",
    tool: "flange",
  });
  return { scheduler, real, ended, steps, faults, messages, place };
}

test("T-60 a plug-in is handed lines and arcs as poses of the flange in its base, signals, gripper and load as steps of their own", async () => {
  const { real, ended, steps, faults, place, scheduler } = await bench();
  const program: Step[] = [
    {
      id: "line",
      type: "move",
      path: "lin",
      target: place(0.1, 0),
      speed: { mps: 0.2 },
      acceleration: { ratio: 0.5 },
      blend_m: 0,
    },
    {
      id: "arc",
      type: "move",
      path: "circ",
      via: place(-0.05, 0.05),
      target: place(-0.1, 0),
      speed: { mps: 0.1 },
      blend_m: 0,
    },
    { id: "set", type: "set", signal: "weld", to: true },
    { id: "level", type: "set", signal: "flow", to: 0.25 },
    { id: "grip", type: "gripper", closed: true },
    { id: "load", type: "payload", mass_kg: 2, center_m: [0, 0, 0.05] },
  ];
  expect(await ended(real.run(program, { tools: {}, frames: {} }))).toEqual({ kind: "done" });
  await scheduler.elapse(0.5);
  expect(faults).toEqual([]);
  const near = (value: number): unknown => expect.closeTo(value, 9) as unknown;
  const pose = (dy: number, dz: number) => ({
    position: place(dy, dz).pose.position.map(near),
    quaternion: place(dy, dz).pose.quaternion.map(near),
  });
  expect(steps.map(({ type, path }) => [type, path])).toEqual([
    ["move", "lin"],
    ["move", "circ"],
    ["set", undefined],
    ["set", undefined],
    ["gripper", undefined],
    ["payload", undefined],
  ]);
  expect(steps[0]).toMatchObject({
    target: { pose: pose(0.1, 0), frame: "world", tool: "flange" },
    speed: { mps: 0.2 },
    acceleration: { ratio: 0.5 },
  });
  expect(steps[1]).toMatchObject({
    via: { pose: pose(-0.05, 0.05) },
    target: { pose: pose(-0.1, 0), frame: "world", tool: "flange" },
    speed: { mps: 0.1 },
  });
  expect(steps.slice(2)).toMatchObject([
    { signal: "weld", to: true },
    { signal: "flow", to: 0.25 },
    { closed: true },
    { mass_kg: 2, center_m: [0, 0, 0.05] },
  ]);
});

test("T-60 what a plug-in cannot is its own sentence: of a motion the answer, of a signal told with the states", async () => {
  const { real, ended, messages, place, scheduler } = await bench(["move", "set"]);
  expect(
    await ended(
      real.run([{ id: "line", type: "move", path: "lin", target: place(0.1, 0), speed: { mps: 0.2 }, blend_m: 0 }], {
        tools: {},
        frames: {},
      }),
    ),
  ).toMatchObject({ why: { sentence: "The taker has no move." } });
  await ended(real.run([{ id: "set", type: "set", signal: "weld", to: true }], { tools: {}, frames: {} }));
  await scheduler.elapse(0.5);
  expect(messages).toContain("The taker has no set.");
});
