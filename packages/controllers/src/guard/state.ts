/**
 * Who may move the robot, and when. Pure: `guardStep` says what follows from an event, the guard around it does it.
 * Small enough that its test walks through every state there is.
 */
export interface GuardState {
  /** Who holds the motion lease; null when nobody does. */
  readonly holder: string | null;
  /** The holder keeps the enabling switch pressed. */
  readonly pressed: boolean;
  /** "unconfirmed": back after a loss, and nobody has said yet that motion is wanted. */
  readonly link: "up" | "lost" | "unconfirmed";
  readonly motion: "at-rest" | "moving" | "stopping" | "returning";
  /**
   * "return-due": came too near to something; goes back to the last safe pose when it stands.
   * "return-wanted": the same, but it was kept from going back; a person must confirm first.
   */
  readonly trip: "none" | "return-due" | "return-wanted";
  /** Drives are off until reset. */
  readonly emergency: boolean;
  /** Somebody else moves the robot, and from here it is only looked at: nothing is sent but a person's stop. */
  readonly watching: boolean;
}
export const AT_FIRST: GuardState = {
  holder: null,
  pressed: false,
  link: "up",
  motion: "at-rest",
  trip: "none",
  emergency: false,
  watching: false,
};

export type GuardEvent =
  | { readonly type: "take" | "release" | "press" | "let-go" | "ask" | "confirm" | "reset"; readonly who: string }
  /** From now on it is only watched, or it may be commanded again. */
  | { readonly type: "watch"; readonly who: string; readonly on: boolean }
  /** Anyone may stop. */
  | { readonly type: "stop"; readonly emergency: boolean }
  /** The robot stands: the command, the braking or the way back is over. */
  | { readonly type: "ended" }
  | { readonly type: "too-near" }
  | { readonly type: "link-lost" | "link-back" };

/** What must be done at once. "forward": the asked move. "return": move to the last safe pose. */
export type GuardEffect = "forward" | "return" | "stop" | "emergency-stop";
/** Why an event was turned down. */
export type GuardDenial =
  | "lease-taken"
  | "no-lease"
  | "enabling-switch"
  | "link-lost"
  | "link-unconfirmed"
  | "emergency"
  | "return-wanted"
  | "busy"
  | "still-moving"
  | "watching";

export interface GuardAnswer {
  readonly state: GuardState;
  readonly effects: readonly GuardEffect[];
  readonly denied?: GuardDenial;
}
export interface GuardRules {
  /** Motion only while the holder keeps a switch pressed. */
  readonly deadMan: boolean;
}

/** All that motion needs. Holds in every state in which the robot is moved. */
export const mayMove = (state: GuardState, rules: GuardRules): boolean =>
  !state.watching &&
  state.holder !== null &&
  (state.pressed || !rules.deadMan) &&
  state.link === "up" &&
  !state.emergency;

/** What a step of the guard answers with, in a state. */
class Answers {
  readonly state: GuardState;
  readonly rules: GuardRules;
  readonly underWay: boolean;

  constructor(state: GuardState, rules: GuardRules) {
    this.state = state;
    this.rules = rules;
    this.underWay = state.motion === "moving" || state.motion === "returning";
  }

  /** The robot is stopped; what it had still to do on its own now needs a person. */
  halted(to: Partial<GuardState>, effects: readonly GuardEffect[]): GuardAnswer {
    const { state } = this;
    return {
      state: {
        ...state,
        ...to,
        motion: this.underWay ? "stopping" : state.motion,
        trip: state.trip === "none" ? "none" : "return-wanted",
      },
      effects,
    };
  }
  deny(denied: GuardDenial): GuardAnswer {
    return { state: this.state, effects: [], denied };
  }
  to(change: Partial<GuardState>, ...effects: GuardEffect[]): GuardAnswer {
    return { state: { ...this.state, ...change }, effects };
  }
  allowed(who: string, then: () => GuardAnswer): GuardAnswer {
    const denied = whyNot(this.state, who, this.rules);
    return denied ? this.deny(denied) : then();
  }
}

export function guardStep(state: GuardState, event: GuardEvent, rules: GuardRules): GuardAnswer {
  const answers = new Answers(state, rules);
  if (state.watching && onlyCommands(event)) return answers.deny("watching");
  switch (event.type) {
    case "watch":
      return watchStep(answers, event);
    case "take":
    case "release":
    case "press":
    case "let-go":
    case "ask":
    case "confirm":
    case "reset":
      return commandStep(answers, event);
    default:
      return robotStep(answers, event);
  }
}

type EventOf<T extends GuardEvent["type"]> = Extract<GuardEvent, { readonly type: T }>;
type Commanded = EventOf<"take" | "release" | "press" | "let-go" | "ask" | "confirm" | "reset">;

/** Only to watch from now on, or to command again. */
function watchStep(answers: Answers, event: EventOf<"watch">): GuardAnswer {
  const { state, underWay } = answers;
  if (!event.on) return answers.to({ watching: false });
  if (state.holder !== null && state.holder !== event.who) return answers.deny("lease-taken");
  return {
    ...answers.halted({}, underWay ? ["stop"] : []),
    state: { ...answers.halted({}, []).state, holder: null, pressed: false, trip: "none", watching: true },
  };
}

/** A person has looked: it may go on after its link was lost, or go back to its last safe pose. */
function confirmStep(answers: Answers, who: string): GuardAnswer {
  const { state } = answers;
  if (state.link === "lost") return answers.deny("link-lost");
  if (state.holder !== who) return answers.deny("no-lease");
  if (state.link === "unconfirmed") return answers.to({ link: "up" });
  if (state.trip !== "return-wanted") return answers.to({});
  return state.motion !== "at-rest"
    ? answers.deny("busy")
    : answers.allowed(who, () => answers.to({ motion: "returning", trip: "return-due" }, "return"));
}

/** What one who commands says. */
function commandStep(answers: Answers, event: Commanded): GuardAnswer {
  const { state, rules, underWay } = answers;
  switch (event.type) {
    case "take":
      return state.holder === null
        ? answers.to({ holder: event.who, pressed: false })
        : state.holder === event.who
          ? answers.to({})
          : answers.deny("lease-taken");
    case "release":
      return state.holder === event.who
        ? answers.halted({ holder: null, pressed: false }, underWay ? ["stop"] : [])
        : answers.deny("no-lease");
    case "press":
      return state.holder === event.who ? answers.to({ pressed: true }) : answers.deny("no-lease");
    case "let-go":
      if (state.holder !== event.who) return answers.deny("no-lease");
      return rules.deadMan
        ? answers.halted({ pressed: false }, underWay ? ["stop"] : [])
        : answers.to({ pressed: false });
    case "ask":
      return answers.allowed(event.who, () => {
        if (state.trip !== "none") return answers.deny("return-wanted");
        return state.motion === "at-rest" ? answers.to({ motion: "moving" }, "forward") : answers.deny("busy");
      });
    case "confirm":
      return confirmStep(answers, event.who);
    case "reset":
      // It turns drives on: for the one who commands alone, whoever pressed the emergency stop.
      if (state.holder !== event.who) return answers.deny(state.holder === null ? "no-lease" : "lease-taken");
      return state.motion === "at-rest" ? answers.to({ emergency: false }) : answers.deny("still-moving");
  }
}

/** What the robot and its line do, and a stop, which is anybody's. */
function robotStep(answers: Answers, event: Exclude<GuardEvent, Commanded | EventOf<"watch">>): GuardAnswer {
  const { state, rules } = answers;
  switch (event.type) {
    case "stop":
      return answers.halted({ emergency: state.emergency || event.emergency }, [
        event.emergency ? "emergency-stop" : "stop",
      ]);
    case "ended":
      if (state.motion === "stopping" && state.trip === "return-due") {
        return mayMove(state, rules)
          ? answers.to({ motion: "returning" }, "return")
          : answers.to({ motion: "at-rest", trip: "return-wanted" });
      }
      return answers.to({ motion: "at-rest", trip: state.motion === "returning" ? "none" : state.trip });
    case "too-near":
      // On the way back it is near by nature; at rest nothing needs stopping.
      return state.motion === "moving"
        ? answers.to({ motion: "stopping", trip: "return-due" }, "stop")
        : answers.to({});
    case "link-lost":
      // What is only watched was set going by others: a line that breaks here does not stop it there.
      return state.watching ? answers.to({ link: "lost" }) : answers.halted({ link: "lost" }, ["stop"]);
    case "link-back":
      return state.link === "lost" ? answers.to({ link: state.watching ? "up" : "unconfirmed" }) : answers.to({});
  }
}

/** Whether only one who commands says that. */
const onlyCommands = ({ type }: GuardEvent): boolean =>
  type === "take" ||
  type === "release" ||
  type === "press" ||
  type === "let-go" ||
  type === "ask" ||
  type === "confirm" ||
  type === "reset";

function whyNot(state: GuardState, who: string, rules: GuardRules): GuardDenial | null {
  if (state.link === "lost") return "link-lost";
  if (state.emergency) return "emergency";
  if (state.holder !== who) return state.holder === null ? "no-lease" : "lease-taken";
  if (state.link === "unconfirmed") return "link-unconfirmed";
  return rules.deadMan && !state.pressed ? "enabling-switch" : null;
}
