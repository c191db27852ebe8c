import { degrees, isSlide, radians, type CommandOutcome, type MoveStep } from "@twincell/core";
import type { Request } from "@twincell/protocol";
import type { RobotAt } from "../io/at.ts";
import { oneStepProgram } from "../io/one-step.ts";
import type { Questions } from "./questions.ts";

/** Override of every motion of the protocol [%]. */
export const SPEED_PERCENT = 10;
/** Share of a joint's speed that the motions ask for; the override comes on top. */
const RATIO = 0.5;
/** How far each joint is turned [rad], or pushed [m]. */
const STEP_RAD = radians(2);
const STEP_M = 0.005;
/** How far joint 1 was to go when it is stopped, and after how much of it [rad]. */
const LONG_RAD = radians(10);
const BEGUN_RAD = radians(1);
/** Room that is left to a limit [rad or m]. */
const LIMIT_ROOM = 1e-3;
const STANDS_S = 5;

type Ask = (request: Request) => Promise<CommandOutcome>;
const DONE: CommandOutcome = { kind: "done" };

/** Before anything is commanded: the joint angles as the controller tells them [° or mm]. */
export function anglesText({ robot, sample }: Pick<RobotAt, "robot" | "sample">): string {
  return robot.arm.joints
    .map((joint, i) => {
      const q = sample?.q_rad[i] ?? Number.NaN;
      const value = isSlide(joint) ? `${(q * 1000).toFixed(1)} mm` : `${degrees(q).toFixed(1)}°`;
      return `  ${i + 1} ${joint.name}: ${value}`;
    })
    .join("\n");
}

/** Where a joint is turned to: a little up, or down where the upper limit is near. */
export function nudged(at: Pick<RobotAt, "robot">, q_rad: readonly number[], j: number): readonly number[] {
  const joint = at.robot.arm.joints[j]!;
  const step = isSlide(joint) ? STEP_M : STEP_RAD;
  const up = q_rad[j]! + step <= joint.limits.upper_rad - LIMIT_ROOM;
  return q_rad.map((q, i) => (i === j ? q + (up ? step : -step) : q));
}

/**
 * Turns every joint a little and back, asks after each, and stops joint 1 on its way. The enabling switch is held only
 * while the arm moves.
 *
 * @returns the first outcome that was not done, or done.
 */
export async function moveFirst(at: RobotAt, ask: Ask, questions: Questions): Promise<CommandOutcome> {
  const station = at.info.id;
  const slow = await ask({ type: "speed", station, percent: SPEED_PERCENT });
  if (slow.kind !== "done") return slow;
  const from = at.sample!.q_rad;
  for (let j = 0; j < at.robot.arm.joints.length; j++) {
    const outcome = await turnJoint(at, ask, questions, from, j);
    if (outcome.kind !== "done") return outcome;
  }
  return stopOnTheWay(at, ask, questions, from);
}

async function turnJoint(
  at: RobotAt,
  ask: Ask,
  questions: Questions,
  from: readonly number[],
  j: number,
): Promise<CommandOutcome> {
  const target = nudged(at, from, j);
  const outcome = await moveTo(at, ask, target);
  if (outcome.kind !== "done") return outcome;
  const joint = at.robot.arm.joints[j]!;
  const stood = await standing(at);
  const off = Math.max(...stood.map((q, i) => Math.abs(q - target[i]!)));
  const way = target[j]! > from[j]! ? "plus" : "minus";
  const far = isSlide(joint) ? `${STEP_M * 1000} mm` : `${degrees(STEP_RAD).toFixed(0)}°`;
  const answer = await questions.ask(
    `joint-${j + 1}`,
    `Joint ${j + 1} (${joint.name}) was moved by ${far} to ${way}. Did it alone go to what the pendant calls ${way}?`,
    isSlide(joint) ? { off_mm: 1000 * off } : { off_deg: degrees(off) },
  );
  if (answer === "no") return notAsMeant(`joint ${j + 1}`);
  if (questions.ended) return NOBODY;
  return moveTo(at, ask, from);
}

async function stopOnTheWay(
  at: RobotAt,
  ask: Ask,
  questions: Questions,
  from: readonly number[],
): Promise<CommandOutcome> {
  const sign = from[0]! + LONG_RAD <= at.robot.arm.joints[0]!.limits.upper_rad - LIMIT_ROOM ? 1 : -1;
  const target = from.map((q, i) => (i === 0 ? q + sign * LONG_RAD : q));
  const moving = moveTo(at, ask, target);
  const begun = await at.until(({ q_rad }) => Math.abs(q_rad[0]! - from[0]!) > BEGUN_RAD);
  const told_s = performance.now() / 1000;
  const atTold_rad = at.sample!.q_rad[0]!;
  at.client.stop(at.info.id);
  const outcome = await moving;
  const stands = await at.until(({ moving: still }) => !still, STANDS_S);
  const took_ms = 1000 * (performance.now() / 1000 - told_s);
  const travel_deg = degrees(Math.abs(at.sample!.q_rad[0]! - atTold_rad));
  if (!begun) return outcome.kind === "done" ? notAsMeant("joint 1") : outcome;
  const answer = await questions.ask(
    "stop",
    stands
      ? "Joint 1 was told to stop on its way, and the controller says that it stands. Does it?"
      : "Joint 1 was told to stop on its way, and still moves. USE THE RED BUTTON. Does it stand now?",
    { took_ms, travel_deg },
  );
  if (answer === "no") return notAsMeant("the stop");
  return questions.ended ? NOBODY : moveTo(at, ask, from);
}

/**
 * A slow motion during which a person pulls the cable.
 *
 * @returns done whatever became of the motion, since a lost link ends it: the question after it says whether the arm
 *   stood. Stopped where nobody answers any more.
 */
export async function pullCable(at: RobotAt, ask: Ask, questions: Questions): Promise<CommandOutcome> {
  const went = await questions.wait(
    "Last: joint 1 turns slowly to and fro. Pull the controller's network cable while it moves, and plug it in again " +
      "after it stands.",
  );
  if (!went) return NOBODY;
  const from = at.sample!.q_rad;
  const target = nudged(at, from, 0);
  let outcome: CommandOutcome = DONE;
  for (let i = 0; i < 20 && outcome.kind === "done"; i++) outcome = await moveTo(at, ask, i % 2 === 0 ? target : from);
  await questions.ask(
    "cable",
    outcome.kind === "done"
      ? "The link was never lost: was the cable pulled while the arm moved, and did it stand at once?"
      : `The motion ended: ${outcome.why.sentence} Did the arm stand at once?`,
  );
  return DONE;
}

async function moveTo(at: RobotAt, ask: Ask, q_rad: readonly number[]): Promise<CommandOutcome> {
  const station = at.info.id;
  const step: MoveStep = {
    id: "first-motion",
    type: "move",
    path: "ptp",
    target: { q: [...q_rad] },
    speed: { ratio: RATIO },
    blend_m: 0,
  };
  const held = await ask({ type: "hold", station, pressed: true });
  if (held.kind !== "done") return held;
  const program = oneStepProgram(at.robot, "First motion", step);
  const outcome = await ask({ type: "run", station, program, asText: false });
  await ask({ type: "hold", station, pressed: false });
  return outcome;
}

/** Joint angles of the first sample that says that the robot stands. */
async function standing(at: RobotAt): Promise<readonly number[]> {
  await at.until(({ moving }) => !moving, STANDS_S);
  return at.sample!.q_rad;
}

/** An arm is not moved on when whoever stands beside it does not answer. */
const NOBODY: CommandOutcome = {
  kind: "stopped",
  why: {
    code: "first-motion.nobody",
    sentence: "Nobody answers any more: nothing more is commanded.",
    hint: "Begin again, and answer each question.",
  },
};

const notAsMeant = (what: string): CommandOutcome => ({
  kind: "stopped",
  why: {
    code: "first-motion.not-as-meant",
    sentence: `You said that ${what} did not do what was meant: nothing more is commanded.`,
    hint: "Send the file back with a word on what you saw; do not use this driver on this robot before that is mended.",
  },
});
