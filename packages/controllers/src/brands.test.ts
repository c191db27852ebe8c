import {
  emptyProgram,
  LIBRARY,
  manualScheduler,
  type CommandOutcome,
  type Dialect,
  type Program,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import {
  DRIVER_KINDS,
  createRealController,
  memoryNetwork,
  openRobotConnection,
  robotsOf,
  type DriverKind,
} from "./index.ts";
import { endedOn } from "./testing/index.ts";

const HOST = "127.0.0.9";
/** Where the wire cannot switch drives on and start a program: a person does it at the cabinet, with the key. */
const AT_THE_CABINET: ReadonlySet<string> = new Set(["staubli", "staubli-cs7"]);
/** A brand's virtual controller with a robot of the library, and its driver, as apps start them. */
async function bench(brand: DriverKind) {
  const robot = robotsOf(brand).find(({ arm }) => arm.joints.length === 6)!;
  const scheduler = manualScheduler();
  const network = memoryNetwork(scheduler);
  const started = await brand.virtual({
    robot,
    scheduler,
    network,
    host: HOST,
    interpret: () => ({ kind: "not-understood", faults: [] }),
  });
  if (started.kind === "taken") throw new Error(started.sentence);
  const { virtual } = started;
  const real = createRealController({ face: brand.face({ robot, scheduler, network, host: HOST }), scheduler });
  const ended = endedOn(scheduler, 0.05);
  expect(await ended(real.connect())).toEqual({ kind: "done" });
  await scheduler.elapse(0.2);
  const near = (by_rad: number): number[] => robot.home_rad.map((q, i) => (i < 3 ? q + by_rad : q));
  /** A person's reset, as often as it takes, then a move. */
  const goesAgain = async (): Promise<CommandOutcome> => {
    let outcome: CommandOutcome = { kind: "done" };
    for (let i = 0; i < 10; i++) {
      if (AT_THE_CABINET.has(brand.id)) {
        virtual.pendant.setMode("manual");
        virtual.pendant.setMode("remote");
      } else void real.reset();
      await scheduler.elapse(1);
      outcome = await ended(real.moveJoints(near(i % 2 === 0 ? 0.05 : -0.05)));
      if (outcome.kind === "done") break;
    }
    return outcome;
  };
  return { robot, scheduler, network, virtual, real, ended, near, goesAgain };
}
const farthest = (a: ArrayLike<number>, b: ArrayLike<number>): number =>
  Math.max(...Array.from(a, (q, i) => Math.abs(q - b[i]!)));

describe.each(DRIVER_KINDS.map(brand => [brand.id, brand] as const))(
  "the cabinet and the pendant of %s",
  (_, brand) => {
    test("T-26 by hand and back: jogged at the pendant, refused from here, then reset and moved from here", async () => {
      const { scheduler, virtual, real, ended, near, goesAgain } = await bench(brand);
      virtual.pendant.setMode("manual");
      await scheduler.elapse(1);
      expect((await real.moveJoints(near(0.05))).kind).toBe("refused");
      expect((await ended(virtual.pendant.jog(near(0.03)))).kind).toBe("done");
      virtual.pendant.setMode("remote");
      await scheduler.elapse(1);
      expect(await goesAgain()).toEqual({ kind: "done" });
    });

    test("T-27 every way to stop it at the robot ends a motion, starts none when it is taken back, and gives way to a person's reset", async () => {
      for (const [name, stop, release] of [
        ["emergency stop", true, true],
        ["guard", false, true],
        ["protective stop", false, false],
      ] as const) {
        const { scheduler, virtual, real, ended, near, goesAgain } = await bench(brand);
        const moving = real.moveJoints(near(0.6));
        await scheduler.elapse(0.3);
        if (stop) virtual.pendant.emergencyStop(true);
        else if (release) virtual.pendant.setGuardOpen(true);
        else virtual.pendant.protectiveStop("it met something");
        expect((await ended(moving)).kind, name).toBe("stopped");
        await scheduler.elapse(1);
        const rest = virtual.jointAngles().slice();
        if (stop) virtual.pendant.emergencyStop(false);
        else if (release) virtual.pendant.setGuardOpen(false);
        await scheduler.elapse(6);
        expect(farthest(virtual.jointAngles(), rest), name).toBe(0);
        expect(await goesAgain(), name).toEqual({ kind: "done" });
      }
    });

    test("off and on again: the link comes back, the motion does not, a person's reset brings it up", async () => {
      const { scheduler, virtual, real, ended, near, goesAgain } = await bench(brand);
      const moving = real.moveJoints(near(0.6));
      await scheduler.elapse(0.3);
      virtual.reboot();
      expect((await ended(moving)).kind).toBe("stopped");
      await scheduler.elapse(12);
      expect(real.isConnected).toBe(true);
      const rest = virtual.jointAngles().slice();
      await scheduler.elapse(2);
      expect(farthest(virtual.jointAngles(), rest)).toBe(0);
      expect(await goesAgain()).toEqual({ kind: "done" });
    });
  },
);

test("what a person says of a controller reaches its driver: pulses per degree of a Yaskawa, one a joint", async () => {
  const brand = DRIVER_KINDS.find(({ id }) => id === "yaskawa")!;
  const [datum] = brand.data!;
  const joints = 6;
  const connected = async (numbers: readonly number[]): Promise<CommandOutcome> => {
    const scheduler = manualScheduler();
    const network = memoryNetwork(scheduler);
    const robot = LIBRARY.find(({ vendor }) => vendor === brand.vendor)!;
    const started = await brand.virtual({
      robot,
      scheduler,
      network,
      host: HOST,
      interpret: () => ({ kind: "not-understood", faults: [] }),
    });
    if (started.kind === "taken") throw new Error(started.sentence);
    const connecting = createRealController({
      face: brand.face({ robot, scheduler, network, host: HOST, data: { [datum!.id]: numbers } }),
      scheduler,
    }).connect();
    await scheduler.elapse(2);
    return connecting;
  };
  expect(await connected(new Array<number>(joints).fill(1000))).toEqual({ kind: "done" });
  expect(await connected([1000, 1000])).toMatchObject({ kind: "refused", why: { code: "yaskawa.pulses" } });
});

test("the lines of a program reach a station by the numbers they have on the controller, though nobody told its driver their names", async () => {
  const brand = DRIVER_KINDS.find(({ id }) => id === "yaskawa")!;
  const scheduler = manualScheduler();
  const robot = LIBRARY.find(({ vendor }) => vendor === brand.vendor)!;
  const dialect = { interpret: () => ({ kind: "not-understood", faults: [] }) } as unknown as Dialect;
  const opened = await openRobotConnection({ id: "s", brand, robot, scheduler, dialect, deadMan: false });
  if (opened.kind === "refused") throw new Error(opened.why.sentence);
  const { station } = opened;
  const connecting = station.connect();
  const seat = station.commander("you");
  await scheduler.elapse(1);
  expect(await connecting).toEqual({ kind: "done" });
  seat.acquireLease();
  const program: Program = {
    ...emptyProgram(robot.id),
    signals: { lamp: { kind: "digital-out", address: 12 }, part: { kind: "digital-in", address: 5 } },
    steps: [
      { id: "a", type: "wait-for", when: { signal: "part", is: true }, timeout_s: 20 },
      { id: "b", type: "set", signal: "lamp", to: true },
    ],
  };
  const running = station.run(seat, program, false);
  await scheduler.elapse(1);
  expect(station.controller.signals!.read("OT#(12)")).toBe(false);
  await station.pendant!.act("you", { do: "input", signal: "in_5", value: true });
  await scheduler.elapse(2);
  expect(await running).toEqual({ kind: "done" });
  expect(station.controller.signals!.read("OT#(12)")).toBe(true);
  station.close();
});
