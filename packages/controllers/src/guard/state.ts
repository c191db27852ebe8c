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

export function guardStep(state: GuardState, event: GuardEvent, rules: GuardRules): GuardAnswer {
  const underWay = state.motion === "moving" || state.motion === "returning";
  /** The robot is stopped; what it had still to do on its own now needs a person. */
  const halted = (to: Partial<GuardState>, effects: readonly GuardEffect[]): GuardAnswer => ({
    state: {
      ...state,
      ...to,
      motion: underWay ? "stopping" : state.motion,
      trip: state.trip === "none" ? "none" : "return-wanted",
    },
    effects,
  });
  const deny = (denied: GuardDenial): GuardAnswer => ({ state, effects: [], denied });
  const to = (change: Partial<GuardState>, ...effects: GuardEffect[]): GuardAnswer => ({
    state: { ...state, ...change },
    effects,
  });

  if (state.watching && onlyCommands(event)) return deny("watching");
  switch (event.type) {
    case "watch":
      if (!event.on) return to({ watching: false });
      if (state.holder !== null && state.holder !== event.who) return deny("lease-taken");
      return {
        ...halted({}, underWay ? ["stop"] : []),
        state: { ...halted({}, []).state, holder: null, pressed: false, trip: "none", watching: true },
      };
    case "take":
      return state.holder === null
        ? to({ holder: event.who, pressed: false })
        : state.holder === event.who
          ? to({})
          : deny("lease-taken");
    case "release":
      return state.holder === event.who
        ? halted({ holder: null, pressed: false }, underWay ? ["stop"] : [])
        : deny("no-lease");
    case "press":
      return state.holder === event.who ? to({ pressed: true }) : deny("no-lease");
    case "let-go":
      if (state.holder !== event.who) return deny("no-lease");
      return rules.deadMan ? halted({ pressed: false }, underWay ? ["stop"] : []) : to({ pressed: false });
    case "ask":
      return allowed(event.who, () => {
        if (state.trip !== "none") return deny("return-wanted");
        return state.motion === "at-rest" ? to({ motion: "moving" }, "forward") : deny("busy");
      });
    case "confirm":
      if (state.link === "lost") return deny("link-lost");
      if (state.holder !== event.who) return deny("no-lease");
      if (state.link === "unconfirmed") return to({ link: "up" });
      if (state.trip !== "return-wanted") return to({});
      return state.motion !== "at-rest"
        ? deny("busy")
        : allowed(event.who, () => to({ motion: "returning", trip: "return-due" }, "return"));
    case "stop":
      return halted({ emergency: state.emergency || event.emergency }, [event.emergency ? "emergency-stop" : "stop"]);
    case "reset":
      // It turns drives on: for the one who commands alone, whoever pressed the emergency stop.
      if (state.holder !== event.who) return deny(state.holder === null ? "no-lease" : "lease-taken");
      return state.motion === "at-rest" ? to({ emergency: false }) : deny("still-moving");
    case "ended":
      if (state.motion === "stopping" && state.trip === "return-due") {
        return mayMove(state, rules)
          ? to({ motion: "returning" }, "return")
          : to({ motion: "at-rest", trip: "return-wanted" });
      }
      return to({ motion: "at-rest", trip: state.motion === "returning" ? "none" : state.trip });
    case "too-near":
      // On the way back it is near by nature; at rest nothing needs stopping.
      return state.motion === "moving" ? to({ motion: "stopping", trip: "return-due" }, "stop") : to({});
    case "link-lost":
      // What is only watched was set going by others: a line that breaks here does not stop it there.
      return state.watching ? to({ link: "lost" }) : halted({ link: "lost" }, ["stop"]);
    case "link-back":
      return state.link === "lost" ? to({ link: state.watching ? "up" : "unconfirmed" }) : to({});
  }

  function allowed(who: string, then: () => GuardAnswer): GuardAnswer {
    const denied = whyNot(state, who, rules);
    return denied ? deny(denied) : then();
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
