import { angleBetween, compose, distance, flangePose, fromAxisAngle, pose, robotById, type Pose } from "@twincell/core";
import { beforeEach, describe, expect, test } from "vitest";
import { jogStore } from "../../stores/jog.ts";
import { soundStore } from "../../stores/sound.ts";
import { stopEverything } from "../../stores/stop.ts";
import { beginDrag, dragFollows, dragTcp } from "./drag.ts";
import { followPoses, showJoints, tcpNow } from "../live.ts";

const robot = robotById("staubli_rx90l")!;
const worldFromBase = pose<"world", "base">([0.1, -0.2, 0.75]);
const flangeFromTcp = pose<"flange", "tcp">([0, 0, 0.14], fromAxisAngle([0, 1, 0], 0.3));
const START = [0.2, -1.1, 2.2, 0.3, 0.7, -0.4];
const at = (x: number, y: number, z: number, from: Pose<"world", "tcp">): Pose<"world", "tcp"> =>
  pose([from.position[0] + x, from.position[1] + y, from.position[2] + z], from.quaternion);

beforeEach(() => {
  followPoses(robot, {
    flange: (q, out) => {
      flangePose(robot.arm, q, out);
    },
    tcp: (baseFromFlange, out) => {
      compose(compose(worldFromBase, baseFromFlange), flangeFromTcp, out);
    },
  });
  dragFollows(robot, worldFromBase, flangeFromTcp);
  showJoints(START);
  jogStore.setState({ blocked: null });
});

describe("dragging the tool", () => {
  test("the tool tip goes where the hand is", () => {
    const wanted = at(0.03, -0.02, 0.04, tcpNow());
    expect(dragTcp(wanted)).toEqual({ kind: "moved" });
    expect(distance(tcpNow().position, wanted.position)).toBeLessThan(1e-9);
    expect(angleBetween(tcpNow().quaternion, wanted.quaternion)).toBeLessThan(1e-8);
  });

  test("a hand that jumps moves the robot by at most 80 mm a call", () => {
    const before = tcpNow();
    expect(dragTcp(at(0, 0, -0.3, before)).kind).toBe("on-the-way");
    expect(distance(tcpNow().position, before.position)).toBeCloseTo(0.08, 9);
  });

  test("N-39 at the edge of reach one coordinate is blocked and the others stay free", () => {
    const before = tcpNow();
    for (let i = 0; i < 40; i++) dragTcp(at(5, 0, 0, before));
    const edge = tcpNow();
    const outcome = dragTcp(at(0.05, 0, 0.02, edge));
    expect(outcome.kind).toBe("blocked");
    expect(outcome.kind === "blocked" && outcome.sentence).toMatch(/^(The wrist would be|Joint \d would).* \d.*\.$/);
    const after = tcpNow();
    expect(Math.abs(after.position[0] - edge.position[0])).toBeLessThan(0.004);
    const back = dragTcp(at(-0.02, 0, 0, after));
    expect(back.kind).toBe("moved");
  });

  test("N-40 a limit is said once, with its sound and its pause, and forgotten when free", () => {
    const before = tcpNow();
    const sounds = soundStore.getState().played.limit;
    for (let i = 0; i < 40; i++) dragTcp(at(5, 0, 0, before));
    expect(jogStore.getState().blocked).not.toBeNull();
    expect(soundStore.getState().played.limit - sounds).toBe(1);
    dragTcp(at(-0.05, 0, 0, tcpNow()));
    expect(jogStore.getState().blocked).toBeNull();
  });

  test("STOP ends the drag", () => {
    let ended = 0;
    const end = beginDrag(() => {
      ended++;
    });
    stopEverything();
    expect(ended).toBe(1);
    end();
    stopEverything();
    expect(ended).toBe(1);
  });
});
