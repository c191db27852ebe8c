import { createHmac, randomUUID } from "node:crypto";
import type { ConnectionEvent } from "@twincell/protocol";
import type { RobotState } from "../robot-states.ts";
import { causeOf, type StandardContext, type StartedStandard } from "../standard.ts";
import { readHooks, type Hook, type HookEvent } from "./hooks-file.ts";

/** Pauses before a request that was not taken is sent again [s]; after the last it is given up and said. */
const PAUSES_S = [1, 5, 30, 120];
const PATIENCE_MS = 10_000;
/** So much waits for one address; of more the oldest is given up. */
const MOST_WAITING = 1000;

interface Told {
  readonly id: string;
  readonly event: HookEvent;
  readonly robot: string;
  readonly body: string;
}

/** Tells addresses of other programs by POST what happens at robots, in order, each until it was taken. */
export function startWebhooks(context: StandardContext, path: string): StartedStandard {
  const hooks = readHooks(path);
  const { states, now_ms } = context;
  const senders = hooks.map(hook => createSender(hook, context.say));
  const tell = (event: HookEvent, robot: string, more: object): void => {
    const id = randomUUID();
    const body = JSON.stringify({ id, time: new Date(now_ms()).toISOString(), event, robot, ...more });
    for (const sender of senders) sender({ id, event, robot, body });
  };
  const safety = new Map<RobotState, string>();
  const links = new Map<string, string>();
  let listening = false;
  const heard = (message: ConnectionEvent): void => {
    if (message.type === "notice") tell("notice", message.station, { why: message.why });
    else if (message.type === "act" && message.outcome !== null && message.command) {
      const { station, who, action, detail, outcome } = message;
      const why = outcome.kind === "done" ? {} : { why: outcome.why };
      tell(outcome.kind, station, { who, action, detail, ...why });
    } else if (message.type === "link" && links.get(message.station) !== message.state) {
      links.set(message.station, message.state);
      tell("link", message.station, { state: message.state, sentence: message.sentence });
    }
  };
  const forget = states.listen({
    opened(robot) {
      // Those that were open before are no news.
      if (listening) tell("opened", robot.id, { name: robot.name, model: robot.model?.id ?? "" });
    },
    closed(robot) {
      safety.delete(robot);
      links.delete(robot.id);
      tell("closed", robot.id, {});
    },
    sample(robot) {
      const now = robot.sample!.safety;
      const before = safety.get(robot);
      if (now === before) return;
      safety.set(robot, now);
      if (before !== undefined || now !== "normal")
        tell("safety", robot.id, { safety: now, message: robot.sample!.message });
    },
    event: heard,
  });
  listening = true;
  return {
    address: `Webhooks: ${hooks.length} of ${path}`,
    close() {
      forget();
      for (const sender of senders) sender(null);
    },
  };
}

/** Takes what is to be told, or null to end. */
function createSender(hook: Hook, say: (sentence: string) => void): (told: Told | null) => void {
  const waiting: Told[] = [];
  const ended = new AbortController();
  let busy = false;
  const { host } = new URL(hook.url);
  const post = async ({ id, event, body }: Told): Promise<string | null> => {
    const signature = hook.secret === undefined ? null : createHmac("sha256", hook.secret).update(body).digest("hex");
    try {
      const response = await fetch(hook.url, {
        method: "POST",
        body,
        redirect: "error",
        signal: AbortSignal.any([ended.signal, AbortSignal.timeout(PATIENCE_MS)]),
        headers: {
          "content-type": "application/json",
          "twincell-event": event,
          "twincell-delivery": id,
          ...(signature === null ? {} : { "twincell-signature": `sha256=${signature}` }),
        },
      });
      await response.body?.cancel();
      return response.ok ? null : `it answered ${response.status}`;
    } catch (problem) {
      return causeOf(problem instanceof Error && problem.cause !== undefined ? problem.cause : problem);
    }
  };
  const pause = (seconds: number): Promise<void> =>
    new Promise(resolve => {
      const end = (): void => {
        clearTimeout(timer);
        resolve();
      };
      const timer = setTimeout(() => {
        ended.signal.removeEventListener("abort", end);
        resolve();
      }, seconds * 1000);
      timer.unref();
      ended.signal.addEventListener("abort", end, { once: true });
    });
  async function deliver(told: Told): Promise<void> {
    for (let tries = 0; ; tries++) {
      const why = await post(told);
      if (why === null || ended.signal.aborted) return;
      const wait_s = PAUSES_S[tries];
      if (wait_s === undefined) {
        say(`The webhook at ${host} was not told that ${told.robot} is ${told.event}: ${why}.`);
        return;
      }
      await pause(wait_s);
    }
  }
  async function drain(): Promise<void> {
    if (busy) return;
    busy = true;
    for (let told = waiting.shift(); told && !ended.signal.aborted; told = waiting.shift()) await deliver(told);
    busy = false;
  }
  return told => {
    if (told === null) {
      ended.abort();
      return;
    }
    if (hook.robot !== undefined && hook.robot !== told.robot) return;
    if (hook.events && !hook.events.includes(told.event)) return;
    if (waiting.length >= MOST_WAITING) {
      waiting.shift();
      say(`The webhook at ${host} is behind by ${MOST_WAITING} events: the oldest was given up.`);
    }
    waiting.push(told);
    void drain();
  };
}
