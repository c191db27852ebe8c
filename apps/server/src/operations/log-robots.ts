import type { RobotStates } from "../standards/robot-states.ts";
import type { Log } from "./log.ts";

/** Writes down what an operator asks a log for: robots that come and go, links, stops, who did what. No samples. */
export function logRobots(states: RobotStates, log: Log): () => void {
  const links = new Map<string, string>();
  return states.listen({
    opened({ id, name, virtual }) {
      log.say("info", "opened", `${name} is open.`, { robot: id, virtual });
    },
    closed({ id, name }) {
      links.delete(id);
      log.say("info", "closed", `${name} is closed.`, { robot: id });
    },
    event(event) {
      switch (event.type) {
        case "link":
          if (links.get(event.station) === event.state) return;
          links.set(event.station, event.state);
          log.say(event.state === "lost" ? "error" : "info", "link", event.sentence || `The link is ${event.state}.`, {
            robot: event.station,
            state: event.state,
          });
          return;
        case "act":
          if (event.outcome === null) return;
          log.say(
            "info",
            "act",
            event.outcome.kind === "done" ? `${event.who} ${event.action}.` : event.outcome.why.sentence,
            {
              robot: event.station,
              who: event.who,
              act: event.action,
              outcome: event.outcome.kind,
            },
          );
          return;
        case "notice":
          log.say("error", "notice", event.why.sentence, { robot: event.station, code: event.why.code });
          return;
        default:
          return;
      }
    },
  });
}
