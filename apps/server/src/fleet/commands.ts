import type { CommandOutcome } from "@twincell/core";
import { refused } from "@twincell/protocol";
import { z } from "zod";
import type { StandardContext } from "../standards/standard.ts";
import { mayUse } from "../people/tokens.ts";
import { again, subjectOf, type Cluster } from "./nats.ts";

/** A command as it goes through the cluster; its id makes it one, however often it comes. */
export const fleetCommand = z.object({
  id: z.string().regex(/^[\w-]{8,100}$/),
  /** Of `twincell token add` at the server that has the robot. */
  token: z.string().max(200),
  robot: z.string().max(200),
  act: z.discriminatedUnion("type", [
    z.object({ type: z.literal("stop"), emergency: z.boolean() }),
    z.object({ type: z.literal("move"), q_rad: z.array(z.number()).min(1).max(16) }),
    z.object({ type: z.literal("run"), program: z.unknown() }),
  ]),
});
export type FleetCommand = z.infer<typeof fleetCommand>;
const BEGUN = "begun";
const LEASE_S = 30;

/**
 * Carries out commands that come through the cluster, each once: whoever is the first to write its id there does it,
 * and everybody else is told what became of it. A server that ended in the middle leaves it begun, and it is not begun
 * again.
 */
export function answerCommands(context: StandardContext, cluster: Cluster, site: string): () => void {
  const { robots, states, tokens } = context;
  const subscription = cluster.connection.subscribe(subjectOf("command", site), {
    callback(problem, message) {
      if (problem) return;
      void answer(message.string()).then(outcome => message.respond(JSON.stringify(outcome)));
    },
  });
  async function answer(text: string): Promise<CommandOutcome> {
    const parsed = fleetCommand.safeParse(jsonOf(text));
    if (!parsed.success)
      return refused("fleet.command", "This command cannot be understood.", "docs/scale.md says what one is.");
    const command = parsed.data;
    const answered = tokens(command.token);
    const kind = command.act.type === "stop" ? "stop" : "command";
    if (answered.kind !== "known" || !mayUse(answered.role, kind))
      return refused("fleet.token", "The token of this command may not do it here.", "Ask whoever runs that server.");
    const robot = states.all.get(command.robot);
    if (!robot) return refused("robot.none", `There is no robot “${command.robot}” at ${site}.`, "Look at the fleet.");
    if (command.act.type !== "stop" && !robot.virtual)
      return refused(
        "motion.remote",
        `${robot.name} is a real robot and this command comes from another machine, whose loss would not be noticed within 80 ms.`,
        "Command it over the socket /stations with signs of life, or from its server.",
      );
    // A stop is never asked whether it was there before: stopping twice is stopping.
    if (command.act.type === "stop") {
      robots.stop(answered.name, robot.id, command.act.emergency);
      return { kind: "done" };
    }
    let revision: number;
    try {
      revision = await cluster.commands.create(command.id, BEGUN);
    } catch {
      return told(command.id);
    }
    const outcome = await carryOut(command, answered.name);
    await again(() => cluster.commands.update(command.id, JSON.stringify(outcome), revision));
    return outcome;
  }
  async function told(id: string): Promise<CommandOutcome> {
    const entry = await again(() => cluster.commands.get(id));
    const kept = entry?.string() ?? BEGUN;
    return kept === BEGUN
      ? refused("fleet.begun", "This command was begun already.", "Ask again for what became of it, with the same id.")
      : (JSON.parse(kept) as CommandOutcome);
  }
  async function carryOut({ act, robot }: FleetCommand, who: string): Promise<CommandOutcome> {
    const lease = await robots.take(robot, who, LEASE_S);
    if ("kind" in lease) return lease;
    const outcome = await robots.command(
      lease.token,
      robot,
      act.type === "move"
        ? { type: "move", station: robot, q_rad: act.q_rad }
        : { type: "run", station: robot, program: act.type === "run" ? act.program : null, asText: false },
    );
    await robots.give(lease.token);
    return outcome;
  }
  return () => {
    subscription.unsubscribe();
  };
}
function jsonOf(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    return null;
  }
}
