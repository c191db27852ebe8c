/** ROS programs by rosbridge: roslibpy as it is published; `npm run clients` installs it. */
import { flangePose, robotById } from "@twincell/core";
import { afterEach, expect, test } from "vitest";
import { foreignScript, isMissing, plant, type Plant, type Script } from "../testing/foreign.ts";

const missing = isMissing("roslibpy");
const robot = robotById("ur10e")!;
const joint_names = robot.arm.joints.map(joint => joint.name);
let open: Plant | undefined;
let script: Script | undefined;
afterEach(async () => {
  script?.process.kill("SIGKILL");
  await open?.close();
  open = undefined;
});
const turned = (by_rad: number): number[] => robot.home_rad.map((q, i) => (i === 0 ? q + by_rad : q));
const point = (by_rad: number, sec: number, nanosec = 0) => ({
  positions: turned(by_rad),
  time_from_start: { sec, nanosec },
});
const goal = (...points: readonly object[]) => ({ trajectory: { joint_names, points } });
interface Sample {
  /** On the robot's own clock: it goes on evenly however busy the machine is. */
  readonly time_s: number;
  readonly q_rad: number[];
  readonly moving: boolean;
}
const sampleNow = async (): Promise<Sample> =>
  ((await open!.ask("GET", "/robots/arm/state")) as { readonly sample: Sample }).sample;
/** A busy machine may have lost the link to the virtual controller: a person's word brings it back. */
async function confirmed(): Promise<void> {
  await open!.ask("DELETE", "/robots/arm/lease", undefined, await open!.lease());
}
async function until(fits: (sample: Sample) => boolean): Promise<Sample> {
  for (;;) {
    const sample = await sampleNow();
    if (fits(sample)) return sample;
  }
}

test.skipIf(missing)(
  "roslibpy reads joint states, transforms and the URDF, gets the rate it asks for, publishes to others, and is told of what is not there",
  async () => {
    open = await plant({ rosbridge: 0 });
    script = foreignScript("ros_client.py", open.port("rosbridge"));
    const read = (await script.next()) as {
      joints: { name: string[]; position: number[]; header: { stamp: object } };
      ros1: string[];
      tf: { transforms: { child_frame_id: string; transform: { translation: { x: number; y: number; z: number } } }[] };
      urdf: string;
      topics: string[];
    };
    expect(read.joints.name).toEqual(joint_names);
    expect(Object.keys(read.joints.header.stamp)).toEqual(["sec", "nanosec"]);
    expect(read.ros1).toEqual(["nsecs", "secs"]);
    const flange = read.tf.transforms.find(each => each.child_frame_id === robot.frames.tip)!.transform.translation;
    flangePose(robot.arm, read.joints.position).position.forEach((value, i) => {
      expect([flange.x, flange.y, flange.z][i]).toBeCloseTo(value, 6);
    });
    expect(read.urdf).toContain("<robot");
    expect(read.topics).toEqual([
      "/arm/joint_states",
      "/arm/robot_description",
      "/joint_states",
      "/robot_description",
      "/tf",
    ]);
    expect((await script.next())["throttled_Hz"]).toBeCloseTo(10, 0);
    expect(await script.next()).toEqual({
      heard: ["hello"],
      failed: expect.stringContaining("no service /none") as string,
    });
  },
  60_000,
);

test.skipIf(missing)(
  "a trajectory of roslibpy is followed through lease and guard in its time; what is too fast, outside of limits or of other joints is refused with a sentence; cancelling and leaving stop the robot",
  async () => {
    open = await plant({ rosbridge: 0 });
    script = foreignScript("ros_client.py", open.port("rosbridge"));
    for (let i = 0; i < 3; i++) await script.next();
    await confirmed();
    const began_s = (await sampleNow()).time_s;
    script.say({ goal: goal(point(0, 0), point(0.3, 1), point(0.6, 2, 500_000_000)) });
    expect(await script.next()).toMatchObject({ out: { result: { values: { error_code: 0 } } } });
    expect((await sampleNow()).time_s - began_s).toBeGreaterThan(2.4);
    expect((await sampleNow()).q_rad[0]).toBeCloseTo(turned(0.6)[0]!, 3);

    script.say({ goal: goal(point(3, 0, 100_000_000)) });
    const fast = await script.next();
    expect(JSON.stringify(fast)).toMatch(/error_code.*-1/);
    script.say({ goal: goal(point(40, 100)) });
    expect(JSON.stringify(await script.next())).toMatch(/error_code.*-1/);
    script.say({
      goal: { trajectory: { joint_names: ["a"], points: [{ positions: [1], time_from_start: { sec: 1 } }] } },
    });
    expect(JSON.stringify(await script.next())).toMatch(/error_code.*-2/);
    expect((await sampleNow()).q_rad[0]).toBeCloseTo(turned(0.6)[0]!, 3);

    const { lease } = await open.ask("POST", "/robots/arm/lease", { who: "somebody else" });
    script.say({ goal: goal(point(0, 5)) });
    expect(JSON.stringify(await script.next())).toContain("commanded by somebody else");
    await open.ask("DELETE", "/robots/arm/lease", undefined, String(lease));

    await confirmed();
    script.say({ goal: goal(point(-1, 20)), cancel_s: 1 });
    expect(JSON.stringify(await script.next())).toMatch(/error_code.*-4/);
    const stopped = await until(sample => !sample.moving);
    expect(Math.abs(stopped.q_rad[0]! - turned(-1)[0]!)).toBeGreaterThan(1);

    await confirmed();
    script.say({ goal: goal(point(-1, 20)), leave_s: 1 });
    await until(sample => sample.moving);
    await script.next();
    const left = await until(sample => !sample.moving);
    expect(Math.abs(left.q_rad[0]! - turned(-1)[0]!)).toBeGreaterThan(0.5);
    const { guard } = (await open.ask("GET", "/robots/arm/state")) as { guard: { holder: string | null } };
    expect(guard.holder).toBeNull();
  },
  120_000,
);
