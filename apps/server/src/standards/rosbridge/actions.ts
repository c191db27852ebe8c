import type { CommandOutcome } from "@twincell/core";
import type { RobotState } from "../robot-states.ts";
import { topicOf } from "../ros-names.ts";
import type { StandardContext } from "../standard.ts";
import { trajectoryGoal, type RosbridgeRequestOf } from "./messages.ts";
import type { RosClient } from "./client.ts";
import { RESULT_CODES, resultOf, trajectoryProgram } from "./trajectory.ts";

/** States of a goal in `action_msgs/msg/GoalStatus`. */
const SUCCEEDED = 4;
const CANCELED = 5;
const ABORTED = 6;
const FEEDBACK_S = 0.1;
/** The robot is where the last point says within this [rad or m]. */
const TOLERANCE = 0.01;
const LEASE_S = 30;
const isLoopback = (address = ""): boolean => address === "::1" || /^(::ffff:)?127\./.test(address);

type Goal = RosbridgeRequestOf<"send_action_goal">;
export interface RosActions {
  take(client: RosClient, ask: Goal | RosbridgeRequestOf<"cancel_action_goal">): void;
}

/**
 * FollowJointTrajectory of every robot: `/ROBOT/follow_joint_trajectory`, and without the id for the robot that was
 * opened first. A goal is a program like any other: whoever sends it must be allowed to command, the lease is taken for
 * it and given back after it, the guard watches it, and it is stopped when its client is gone.
 */
export function createActions(context: StandardContext): RosActions {
  const { states, robots, scheduler, enter } = context;
  const running = new Map<RosClient, Map<string, { readonly robot: RobotState; canceled: boolean }>>();

  const robotOf = (action: string): RobotState | undefined => {
    const [first] = states.all.values();
    if (action === "/follow_joint_trajectory") return first;
    return [...states.all.values()].find(
      robot => action.startsWith(topicOf(robot, "")) && action.endsWith("/follow_joint_trajectory"),
    );
  };
  const answer = (client: RosClient, goal: Goal, status: number, values: object): void => {
    client.send({
      op: "action_result",
      action: goal.action,
      values: { ...values },
      status,
      result: status === SUCCEEDED,
      ...(goal.id === undefined ? {} : { id: goal.id }),
    });
  };
  const refuse = (client: RosClient, goal: Goal, error_code: number, error_string: string): void => {
    answer(client, goal, ABORTED, { error_code, error_string });
  };

  async function follow(client: RosClient, goal: Goal): Promise<void> {
    const robot = robotOf(goal.action);
    const entered = enter(client.request, "command");
    if (entered.kind === "out") {
      refuse(client, goal, RESULT_CODES.goal, `${entered.sentence} ${entered.hint}`);
      return;
    }
    if (!robot?.model) {
      refuse(client, goal, RESULT_CODES.goal, `No robot has the action ${goal.action}.`);
      return;
    }
    if (!robot.virtual && !isLoopback(client.request.socket.remoteAddress)) {
      const sentence = `${robot.name} is a real robot and this goal comes from another machine, whose loss would not be noticed within 80 ms.`;
      refuse(client, goal, RESULT_CODES.goal, sentence);
      return;
    }
    const parsed = trajectoryGoal.safeParse(goal.args);
    if (!parsed.success) {
      const [issue] = parsed.error.issues;
      refuse(
        client,
        goal,
        RESULT_CODES.goal,
        `The goal cannot be understood at “${issue?.path.join(".") ?? ""}”: ${issue?.message ?? ""}.`,
      );
      return;
    }
    const made = trajectoryProgram(parsed.data, robot.model, robot.q_rad);
    if (made.kind === "refused") {
      refuse(client, goal, made.code, made.sentence);
      return;
    }
    const lease = await robots.take(robot.id, client.who, LEASE_S);
    if ("kind" in lease) {
      const { error_code, error_string } = resultOf(lease);
      refuse(client, goal, error_code, error_string);
      return;
    }
    const mine = running.get(client) ?? new Map<string, { readonly robot: RobotState; canceled: boolean }>();
    running.set(client, mine);
    const entry = { robot, canceled: false };
    mine.set(goal.id ?? "", entry);
    const endFeedback = goal.feedback === true ? feedback(client, goal, robot) : null;
    let forget: () => void = () => undefined;
    const outcome: CommandOutcome = await robots.command(
      lease.token,
      robot.id,
      { type: "run", station: robot.id, program: made.program, asText: false },
      stop => {
        forget = client.onGone(stop);
      },
    );
    forget();
    endFeedback?.();
    mine.delete(goal.id ?? "");
    await robots.give(lease.token);
    const off = Math.max(...made.end_rad.map((q, i) => Math.abs(q - robot.q_rad[i]!)));
    if (outcome.kind === "done" && off > TOLERANCE)
      answer(client, goal, ABORTED, {
        error_code: RESULT_CODES.end,
        error_string: `The robot is ${off.toFixed(4)} off the last point.`,
      });
    else
      answer(
        client,
        goal,
        outcome.kind === "done" ? SUCCEEDED : entry.canceled ? CANCELED : ABORTED,
        resultOf(outcome),
      );
  }
  const feedback = (client: RosClient, goal: Goal, robot: RobotState): (() => void) =>
    scheduler.every(FEEDBACK_S, () => {
      client.send({
        op: "action_feedback",
        action: goal.action,
        values: {
          joint_names: robot.joints,
          actual: { positions: Array.from(robot.q_rad), velocities: Array.from(robot.speed_rad_s) },
        },
        ...(goal.id === undefined ? {} : { id: goal.id }),
      });
    });
  return {
    take(client, ask) {
      if (ask.op === "send_action_goal") {
        void follow(client, ask);
        return;
      }
      const entry = running.get(client)?.get(ask.id ?? "");
      if (!entry) return;
      entry.canceled = true;
      robots.stop(client.who, entry.robot.id, false);
    },
  };
}
