import type { ConnectionRequest, PendantAct } from "./ask.ts";
import type { EventOf } from "./tell.ts";

/**
 * What a person did, in words for a history: the act, and with what; a command to the robot, and where to, or something
 * done beside it.
 */
export interface AuditEntryState {
  readonly action: string;
  readonly detail: string;
  readonly command: boolean;
  readonly target: readonly number[];
}

/**
 * An ask that is an act at one station. Signs of life, looking, and questions for the time are none; starting together
 * is an act at each of the members.
 */
export type AuditEntry =
  | Exclude<
      ConnectionRequest,
      { readonly type: "alive" | "ping" | "open" | "visit" | "look-ahead" | "preview" | "takes" | "together" }
    >
  | {
      readonly type: "together";
      readonly program: unknown;
      readonly asText: boolean;
      readonly despite?: readonly string[];
      readonly members: number;
    };

const AS_TEXT = " as text of the controller's own language";
const inSpiteOf = (codes: readonly string[] = []): string =>
  codes.length > 0 ? `, in spite of ${codes.join(", ")}` : "";
const degrees = (q_rad: readonly number[]): string => q_rad.map(q => `${((q * 180) / Math.PI).toFixed(2)}°`).join(", ");

export function auditEntryState(act: AuditEntry): AuditEntryState {
  const plain = (action: string, detail = ""): AuditEntryState => ({ action, detail, command: false, target: [] });
  const command = (action: string, detail = "", target: readonly number[] = []): AuditEntryState => ({
    action,
    detail,
    command: true,
    target,
  });
  switch (act.type) {
    case "connect":
      return plain("connects the controller");
    case "disconnect":
      return plain("disconnects the controller");
    case "close":
      return plain("closes the station");
    case "take":
      return plain("takes the lease");
    case "release":
      return plain("gives the lease back");
    case "confirm":
      return plain("confirms that motion is wanted");
    case "cell":
      return plain("gives it the cell");
    case "reset":
      return command("resets the robot");
    case "hold":
      return plain(act.pressed ? "presses the enabling switch" : "lets the enabling switch go");
    case "speed":
      return command("sets the speed", `${act.percent} %`);
    case "move":
      return command("moves the joints", `to ${degrees(act.q_rad)}`, act.q_rad);
    case "zero":
      return command("moves all joints to zero");
    case "run":
      return command("runs a program", `${nameOf(act.program)}${act.asText ? AS_TEXT : ""}${inSpiteOf(act.despite)}`);
    case "produce":
      return command(
        "begins a production",
        `${nameOf(act.program)}, ${act.cycles === null ? "until it is ended" : `${act.cycles} cycles`}${act.asText ? AS_TEXT : ""}${inSpiteOf(act.despite)}`,
      );
    case "replace":
      return command("gives the next cycle another program", `${nameOf(act.program)}${inSpiteOf(act.despite)}`);
    case "intervene":
      return command("holds the production to take over by hand");
    case "resume":
      return command("hands back to the production", act.from === "cycle" ? "from the beginning of a cycle" : "");
    case "single-step":
      return command("lets the production do one step");
    case "breakpoints":
      return plain("holds the production before steps", act.steps.join(", "));
    case "together":
      return command(
        `starts a program together with ${act.members - 1} more`,
        `${nameOf(act.program)}${act.asText ? AS_TEXT : ""}${inSpiteOf(act.despite)}`,
      );
    case "watch":
      return plain(act.on ? "only watches from now on" : "may command again");
    case "stop":
      return command(act.emergency ? "presses the emergency stop" : "stops the robot");
    case "pendant":
      return pendantWords(act.act);
    case "plug":
      return plain(act.pulled ? "pulls the plug" : "puts the plug back");
  }
}
/** What was asked of the robot and what was done beside it, as histories keep them. */
export type AuditNote =
  | {
      readonly kind: "command";
      readonly note: {
        readonly name: string;
        readonly by: string;
        readonly outcome: "sent" | "done" | "refused" | "stopped";
        readonly sentence: string;
        readonly target: readonly number[];
      };
    }
  | {
      readonly kind: "operator";
      readonly note: { readonly who: string; readonly action: string; readonly detail: string };
    };

/** Commands are noted when they are sent and when they end, all else once, with what became of it; null before that. */
export function auditNote({ who, action, detail, command, target, outcome }: EventOf<"act">): AuditNote | null {
  const became = outcome === null ? "sent" : outcome.kind;
  const sentence = outcome === null || outcome.kind === "done" ? detail : outcome.why.sentence;
  if (command) return { kind: "command", note: { name: action, by: who, outcome: became, sentence, target } };
  return outcome === null
    ? null
    : {
        kind: "operator",
        note: { who, action: became === "done" ? action : `${action}: ${became}`, detail: sentence },
      };
}
function pendantWords(act: PendantAct): AuditEntryState {
  const at = (detail: string): AuditEntryState => ({ action: "at the pendant", detail, command: false, target: [] });
  switch (act.do) {
    case "mode":
      return at(`mode ${act.mode}`);
    case "key":
      return at(`key to ${act.position}`);
    case "enable":
      return at(act.pressed ? "enabling switch held" : "enabling switch let go");
    case "jog":
      return at(
        act.direction === 0
          ? `stops to jog joint ${act.joint}`
          : `jogs joint ${act.joint} ${act.direction > 0 ? "up" : "down"}`,
      );
    case "servo":
      return at(act.on ? "drives on" : "drives off");
    case "override":
      return at(`override ${act.percent} %`);
    case "reset":
      return at("reset");
    case "near":
      return at(act.somebody ? "somebody is near the robot" : "nobody is near the robot");
    case "trouble":
      return at(
        `trouble on the line: ${Object.entries(act)
          .flatMap(([name, value]) => (name === "do" ? [] : [`${name.replace(/_s$/, " [s]")} ${String(value)}`]))
          .join(", ")}`,
      );
    case "emergency-stop":
      return at(act.pressed ? "emergency stop pressed" : "emergency stop turned out");
    case "guard":
      return at(act.open ? "guard opened" : "guard closed");
    case "protective-stop":
      return at(`protective stop: ${act.because}`);
    case "input":
      return at(`input ${act.signal} is ${String(act.value)}`);
    case "reboot":
      return at("off and on again");
  }
}
/** A program comes unread; a name is what looks like one. */
function nameOf(program: unknown): string {
  const name = typeof program === "object" && program !== null && "name" in program ? program.name : undefined;
  return typeof name === "string" && name !== "" ? `“${name.slice(0, 200)}”` : "without a name";
}
