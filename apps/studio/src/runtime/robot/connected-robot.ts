import {
  emptyProgram,
  solveAll,
  explainReach,
  type CommandOutcome,
  type MoveStep,
  type Speed,
  type Pose,
  type Step,
  cartesianWay,
  jointWay,
  type CartesianAxis,
  type JogTargetFrame,
} from "@twincell/core";
import { hostAt } from "./station-hosts.ts";
import { holdStation, stationLive, stopStation, type StationLive } from "./stations.ts";
import { connectionStore } from "../../stores/connection.ts";
import { cellStore } from "../../stores/cell.ts";
import { programOf } from "../../stores/document.ts";
import { stationOf } from "../../stores/stations.ts";
import { words } from "../../messages/index.ts";
import { freeWay, namesOf, wayOut } from "../jog/hand-motion.ts";
import { heldJog, type HeldJog } from "./held-jog.ts";

const refused = (code: string, sentence: string, hint = ""): CommandOutcome => ({
  kind: "refused",
  why: { code, sentence, hint },
});

/**
 * Speeds of a jog at an override of 100 %: of the joint speed, and along a straight line [m/s]; at most the 0.25 m/s of
 * manual mode.
 */
const JOG_RATIO = 0.1;
const JOG_MPS = 0.1;

/**
 * Direct control of one connected robot: every command goes to its guard, which refuses or stops it; nothing here moves
 * what is drawn. Joints count from 1. Angles in rad, the flange in the robot base.
 */
export interface ConnectedRobot {
  /** The enabling switch. Letting go also stops a robot whose guard does not ask for the switch. */
  setEnabled(enabled: boolean): void;
  jointAngles(): number[];
  moveJoint(joint: number, angle_rad: number): Promise<CommandOutcome>;
  moveJoints(q_rad: readonly number[]): Promise<CommandOutcome>;
  moveToPose(baseFromFlange: Pose<"base", "flange">): Promise<CommandOutcome>;
  moveToZero(): Promise<CommandOutcome>;
  moveHome(): Promise<CommandOutcome>;
  /** By an angle; ±Infinity for as long as the key is held. */
  jogJoint(joint: number, by_rad: number): Promise<CommandOutcome>;
  /** By [m] or [rad]; ±Infinity for as long as the key is held. */
  jogCartesian(axis: CartesianAxis, by: number, frame: JogTargetFrame): Promise<CommandOutcome>;
  setGripper(closed: boolean): Promise<CommandOutcome>;
  setSignal(signal: string, value: boolean | number): Promise<CommandOutcome>;
  setOverride(percent: number): Promise<CommandOutcome>;
  /** Ends a held jog; nothing is sent when none is under way. */
  stopJog(): void;
  /** The protocol's emergency or power-off command; motion is refused until `reset`. */
  drivesOff(): void;
  reset(): Promise<CommandOutcome>;
}

/** The motion of a jog: a step of its own, without a zone. */
const jogStep = (path: "ptp" | "lin", q_rad: readonly number[], speed: Speed): MoveStep => ({
  id: "jog",
  type: "move",
  path,
  target: { q: [...q_rad] },
  speed,
  blend_m: 0,
});

/** @param id  of an open connection; commands to one that is gone are refused. */
export function connectedRobot(id: string): ConnectedRobot {
  const host = () => {
    const place = stationOf(id)?.place;
    return place && hostAt(place);
  };
  const gone = (): CommandOutcome => refused("station.none", words.stations.gone);
  const ask = (request: Parameters<NonNullable<ReturnType<typeof host>>["ask"]>[0]): Promise<CommandOutcome> =>
    host()?.ask(request) ?? Promise.resolve(gone());
  /** Commands that were sent and have not ended: what is told of the motion comes later than they begin. */
  let underWay = 0;
  const command = async (request: Parameters<typeof ask>[0]): Promise<CommandOutcome> => {
    underWay++;
    try {
      return await ask(request);
    } finally {
      underWay--;
    }
  };
  const move = (q_rad: readonly number[]): Promise<CommandOutcome> =>
    command({ type: "move", station: id, q_rad: [...q_rad] });
  /** One step as a program of its own: checked and guarded as any. */
  const step = (one: Step, despite: readonly string[] = []): Promise<CommandOutcome> => {
    const live = stationLive(id);
    if (!live) return Promise.resolve(gone());
    const program = { ...emptyProgram(live.robot.id, words.direct.title), steps: [one] };
    const signals = one.type === "set" ? (programOf(cellStore.getState().document)?.signals ?? {}) : {};
    return command({
      type: "run",
      station: id,
      program: { ...program, signals },
      asText: false,
      despite: [...despite],
    });
  };
  /** Which press of a jog key it is: what is left of one that was let go is not gone on with. */
  let press = 0;
  const jogEnd = (): CommandOutcome => refused("jog.end", words.direct.jogEnd, words.direct.jogEndHint);
  /** A step is one motion, done or not done. Held, the robot of the cell stands before what is in its way. */
  const jogged = (
    wayOf: (live: StationLive) => readonly (readonly number[])[],
    go: HeldJog["go"],
    isStep: boolean,
  ): Promise<CommandOutcome> => {
    const own = ++press;
    const wayFromHere = (): readonly (readonly number[])[] => {
      const live = stationLive(id);
      return live ? wayOf(live) : [];
    };
    if (!stationLive(id)) return Promise.resolve(gone());
    if (isStep || connectionStore.getState().station !== id) {
      const end = wayFromHere().at(-1);
      return end ? go(end, 1, []) : Promise.resolve(jogEnd());
    }
    return heldJog({
      wayFromHere,
      freeWay,
      wayOut: (way, room_m) => wayOut(stationLive(id)?.q_rad ?? [], way, room_m),
      go,
      isHeld: () => press === own,
      nowhere: jogEnd,
      blocked: met => refused("jog.contact", words.direct.inTheWay(...namesOf(met)), words.direct.inTheWayHint),
    });
  };
  /** Ends a motion by hand. A production that is held keeps its place, which a STOP would take from it. */
  const endMotion = (): void => {
    if (underWay === 0) return;
    if (stationOf(id)?.production?.state !== "held") {
      stopStation(id);
      return;
    }
    void ask({ type: "intervene", station: id }).then(({ kind }) => {
      if (kind !== "done") stopStation(id);
    });
  };
  return {
    setEnabled(enabled) {
      press++;
      if (!enabled) endMotion();
      holdStation(id, enabled);
    },
    jointAngles: () => Array.from(stationLive(id)?.q_rad ?? []),
    moveJoint(joint, angle_rad) {
      const q_rad = Array.from(stationLive(id)?.q_rad ?? []);
      if (joint < 1 || joint > q_rad.length)
        return Promise.resolve(refused("joint.number", words.direct.noJoint(joint, q_rad.length)));
      q_rad[joint - 1] = angle_rad;
      return move(q_rad);
    },
    moveJoints: move,
    async moveToPose(baseFromFlange) {
      const live = stationLive(id);
      if (!live) return gone();
      const reach = solveAll(live.robot, baseFromFlange, { near: live.q_rad });
      const first = reach.kind === "reached" ? reach.solutions[0] : undefined;
      return first ? move(Array.from(first.q_rad)) : refused("pose.unreached", explainReach(reach));
    },
    moveToZero: () => command({ type: "zero", station: id }),
    moveHome: () => move(Array.from(stationLive(id)?.robot.home_rad ?? [])),
    jogJoint: (joint, by_rad) =>
      jogged(
        live => jointWay(live.robot, live.q_rad, joint, by_rad),
        (q, share, despite) => step(jogStep("ptp", q, { ratio: JOG_RATIO * share }), despite),
        Number.isFinite(by_rad),
      ),
    jogCartesian: (axis, by, frame) =>
      jogged(
        live => cartesianWay(live.robot, live.q_rad, axis, by, frame),
        (q, share, despite) => step(jogStep("lin", q, { mps: JOG_MPS * share }), despite),
        Number.isFinite(by),
      ),
    setGripper: closed => step({ id: "gripper", type: "gripper", closed }),
    setSignal: (signal, value) => step({ id: "signal", type: "set", signal, to: value }),
    setOverride: percent => ask({ type: "speed", station: id, percent }),
    stopJog() {
      press++;
      endMotion();
    },
    drivesOff() {
      stopStation(id, true);
    },
    reset: () => ask({ type: "reset", station: id }),
  };
}
