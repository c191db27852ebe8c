import { readFileSync } from "node:fs";
import {
  LIBRARY,
  addCatalogue,
  catalogueRobots,
  manualScheduler,
  parseRobot,
  robotById,
  robotFromArm,
  type Dialect,
  type Robot,
} from "@twincell/core";
import { CATALOGUE } from "@twincell/core/catalogue";
import { describe, expect, test } from "vitest";
import { ALL_DRIVER_KINDS, driverKindById, openRobotConnection, robotsOf } from "./index.ts";
import { endedOn } from "./testing/index.ts";

addCatalogue(CATALOGUE);
const dialect = { interpret: () => ({ kind: "not-understood", faults: [] }) } as unknown as Dialect;

function fromFile(name: string): Robot {
  const path = new URL(`../../../fixtures/robots/${name}.json`, import.meta.url);
  const answer = parseRobot(JSON.parse(readFileSync(path, "utf8")));
  if (answer.kind !== "robot") throw new Error(answer.faults[0]!.sentence);
  return answer.robot;
}

/** The robot on its maker's virtual controller, connected over the maker's own protocol, brought to other angles. */
async function driven(robot: Robot, driver: string): Promise<void> {
  const scheduler = manualScheduler();
  const ended = endedOn(scheduler, 0.02);
  const opened = await openRobotConnection({
    id: "own",
    brand: driverKindById(driver)!,
    robot,
    scheduler,
    dialect,
    deadMan: false,
  });
  if (opened.kind === "refused") throw new Error(opened.why.sentence);
  const { station } = opened;
  const wanted = robot.home_rad.map((q, i) => q + [0.05, 0.04, -0.03, 0.06, -0.05, 0.08][i]!);
  try {
    expect(await ended(station.connect())).toEqual({ kind: "done" });
    await scheduler.elapse(0.2);
    const commander = station.commander("you");
    commander.acquireLease();
    expect(await ended(commander.robot.moveJoints(wanted))).toEqual({ kind: "done" });
    await scheduler.elapse(0.1);
    const stands = commander.robot.jointAngles();
    wanted.forEach((q, i) => expect(stands[i]).toBeCloseTo(q, 4));
  } finally {
    station.close();
  }
}

describe("robots from files, driven on their makers' virtual controllers by their vendor sections alone", () => {
  const cases = ["ur5e", "irb2400", "gp12", "kr16", "m10id", "tx2-90l"].flatMap(name => {
    const robot = fromFile(name);
    return robot.vendorSection!.drivers.map(driver => ({ name, driver, robot }));
  });
  test.each(cases)(
    "$name over $driver",
    async ({ robot, driver }) => {
      await driven(robot, driver);
    },
    60_000,
  );
});

describe("robots of the catalogue, driven on their makers' virtual controllers", () => {
  const cases = catalogueRobots().flatMap(robot => {
    const driver = robot.vendorSection?.drivers[0];
    return driver === undefined ? [] : [{ id: robot.id, driver, robot }];
  });
  test("57 of them, of six makers", () => {
    expect(cases.length).toBe(57);
    expect(new Set(cases.map(({ driver }) => driver)).size).toBe(6);
  });
  test.each(cases)(
    "$id over $driver",
    async ({ robot, driver }) => {
      await driven(robot, driver);
    },
    60_000,
  );
});

test("a driver takes the robots whose section names it, and no other", () => {
  for (const kind of ALL_DRIVER_KINDS)
    expect(
      robotsOf(kind).map(({ id }) => id),
      kind.id,
    ).toEqual(
      [...LIBRARY, ...catalogueRobots()]
        .filter(({ vendorSection }) => vendorSection?.drivers.includes(kind.id))
        .map(({ id }) => id),
    );
});

test("an arm without a section, of another make, or with another arm's section is not opened; each says why", async () => {
  const opened = async (robot: Robot, driver: string) => {
    const answer = await openRobotConnection({
      id: "own",
      brand: driverKindById(driver)!,
      robot,
      scheduler: manualScheduler(),
      dialect,
    });
    return answer.kind === "refused" ? answer.why.sentence : "opened";
  };
  const ur10e = robotById("ur10e")!;
  expect(await opened(robotFromArm(ur10e.arm, { id: "own", name: "My arm" }), "ur")).toBe(
    "My arm does not stand on a controller of Universal Robots: its file has no vendor section.",
  );
  expect(await opened(ur10e, "kuka")).toBe(
    "Universal Robots UR10e does not stand on a controller of KUKA; its drivers are ur.",
  );
  const ur5e = fromFile("ur5e");
  expect(await opened({ ...ur5e, arm: ur10e.arm, family: ur10e.family }, "ur")).toMatch(
    /The vendor section is not that of the UR5e of the cell: at Base .*° the vendor section has the flange at \(.*\) mm, that of the UR5e of the cell is at \(.*\) mm: \d+\.\d mm apart/,
  );
});
