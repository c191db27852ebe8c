import fc from "fast-check";
import { describe, expect, test } from "vitest";
import { egmRobotWriter, egmSensorWriter, noEgmRobot, noEgmSensor, readEgmRobot, readEgmSensor } from "./index.ts";

const bytes = (text: string): Uint8Array => Uint8Array.from(text.trim().split(/\s+/), value => parseInt(value, 16));
// Written out from the description of the messages: sizes in one byte, doubles one by one. 45° is 40 46 80 …, -90° is
// C0 56 80 ….
const ROBOT = bytes(`0A 08 08 07 10 A0 9C 01 18 02
  12 38 0A 36 09 00 00 00 00 00 80 46 40 09 00 00 00 00 00 80 56 C0 09 00 00 00 00 00 00 00 00 09 00 00 00 00 00 00 00 00 09 00 00 00 00 00 00 00 00 09 00 00 00 00 00 00 F0 3F
  22 02 08 01 2A 02 08 03 30 01 42 02 08 02`);
const SENSOR = bytes(
  `0A 06 08 05 10 64 18 03 12 14 0A 12 09 00 00 00 00 00 80 46 40 09 00 00 00 00 00 80 56 C0 1A 0B 0A 09 09 00 00 00 00 00 00 F0 3F`,
);

describe("EGM against bytes written out by hand", () => {
  test("a robot's message", () => {
    const out = noEgmRobot();
    expect(readEgmRobot(ROBOT, out)).toBeNull();
    expect(out).toMatchObject({
      sequence: 7,
      time_ms: 20_000,
      axes: 6,
      motors: 1,
      state: 3,
      rapid: 2,
      converged: true,
    });
    expect([...out.joints_deg.subarray(0, 6)]).toEqual([45, -90, 0, 0, 0, 1]);
  });
  test("Cartesian values of feedback and plan: place [mm], then u0 … u3; a part of them is none", () => {
    const double = (value: number): string =>
      [...new Uint8Array(Float64Array.of(value).buffer)].map(byte => byte.toString(16).padStart(2, "0")).join(" ");
    // Inside 12 (feedback) or 1A (plan): joints 0A 09 09 <8>, Cartesian 12: place 0A 1B 09 x 11 y 19 z, orientation 12
    // 24 09 u0 11 u1 19 u2 21 u3.
    const place = (x: number, y: number, z: number): string => `0A 1B 09 ${double(x)} 11 ${double(y)} 19 ${double(z)}`;
    const turn = `12 24 09 ${double(0.5)} 11 ${double(-0.5)} 19 ${double(0.5)} 21 ${double(0.5)}`;
    const part = (key: string, cartesian: string, size: string, whole: string): string =>
      `${key} ${whole} 0A 09 09 ${double(30)} 12 ${size} ${cartesian}`;
    const head = "0A 08 08 07 10 A0 9C 01 18 02";
    const both = bytes(
      `${head} ${part("12", `${place(400, -20, 630)} ${turn}`, "43", "50")} ${part("1A", `${place(401, -21, 631)} ${turn}`, "43", "50")}`,
    );
    const out = noEgmRobot();
    expect(readEgmRobot(both, out)).toBeNull();
    expect([out.pose.known, ...out.pose.position_mm, ...out.pose.orientation]).toEqual([
      true,
      400,
      -20,
      630,
      0.5,
      -0.5,
      0.5,
      0.5,
    ]);
    expect([out.plannedPose.known, ...out.plannedPose.position_mm, out.planned_deg[0]]).toEqual([
      true,
      401,
      -21,
      631,
      30,
    ]);
    expect(readEgmRobot(bytes(`${head} ${part("12", place(400, -20, 630), "1D", "2A")}`), out)).toBeNull();
    expect([out.joints_deg[0], out.pose.known, out.plannedPose.known]).toEqual([30, false, false]);
  });
  test("a sensor's message, with speeds; doubles may be packed", () => {
    const out = noEgmSensor();
    expect(readEgmSensor(SENSOR, out)).toBeNull();
    expect(out).toMatchObject({ sequence: 5, time_ms: 100, axes: 2, hasSpeeds: true });
    expect([...out.joints_deg.subarray(0, 2), out.speeds_deg_s[0]]).toEqual([45, -90, 1]);
    const packed = bytes("0A 06 08 05 10 64 18 03 12 14 0A 12 0A 10 00 00 00 00 00 80 46 40 00 00 00 00 00 80 56 C0");
    expect(readEgmSensor(packed, out)).toBeNull();
    expect([out.axes, out.hasSpeeds, ...out.joints_deg.subarray(0, 2)]).toEqual([2, false, 45, -90]);
  });
  test("what is written is read, external axes behind the robot's own", () => {
    const robot = {
      ...noEgmRobot(),
      sequence: 300,
      time_ms: 123_456,
      axes: 7,
      joints_deg: Float64Array.of(1, 2, 3, 4, 5, 6, 7, 0, 0, 0, 0, 0),
      planned_deg: Float64Array.of(1.5, 2, 3, 4, 5, 6, 7.5, 0, 0, 0, 0, 0),
      pose: { known: true, position_mm: Float64Array.of(1, 2, 3), orientation: Float64Array.of(1, 0, 0, 0) },
      plannedPose: { known: true, position_mm: Float64Array.of(4, 5, 6), orientation: Float64Array.of(0, 1, 0, 0) },
      motors: 2,
      state: 2,
      rapid: 1,
    };
    const out = noEgmRobot();
    expect(readEgmRobot(egmRobotWriter()(robot), out)).toBeNull();
    expect(out).toEqual(robot);
    const sensor = {
      ...noEgmSensor(),
      sequence: 9,
      time_ms: 4,
      axes: 6,
      joints_deg: Float64Array.of(1, 2, 3, 4, 5, 6, 0, 0, 0, 0, 0, 0),
      hasSpeeds: true,
    };
    const back = noEgmSensor();
    expect(readEgmSensor(egmSensorWriter()(sensor), back)).toBeNull();
    expect(back).toEqual(sensor);
  });
  test("what is something else, or damaged, is one sentence; any bytes are read or named", () => {
    const robot = noEgmRobot();
    const sensor = noEgmSensor();
    expect(readEgmRobot(SENSOR, robot)).toBe("The message of EGM is not one of a robot.");
    expect(readEgmSensor(ROBOT, sensor)).toBe("The message of EGM is not one of a sensor.");
    expect(readEgmRobot(ROBOT.subarray(0, 10), robot)).toBe("The message of EGM has no joint angles.");
    const nan = ROBOT.slice();
    nan.set([0xf8, 0x7f], 21);
    expect(readEgmRobot(nan, robot)).toBe("Axis 1 of the message of EGM is no number.");
    const near = fc
      .tuple(fc.constantFrom(ROBOT, SENSOR), fc.array(fc.tuple(fc.nat(70), fc.nat(255)), { maxLength: 4 }), fc.nat(80))
      .map(([base, changes, length]) => {
        const copy = base.slice(0, length);
        for (const [at, to] of changes) if (at < copy.length) copy[at] = to;
        return copy;
      });
    fc.assert(
      fc.property(fc.oneof(fc.uint8Array({ maxLength: 300 }), near), data => {
        for (const said of [readEgmRobot(data, robot), readEgmSensor(data, sensor)])
          if (said !== null) expect(said).toMatch(/^[A-Z].*\.$/);
      }),
      { numRuns: 20_000, seed: 1 },
    );
  });
});
