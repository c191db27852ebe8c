import { readConnectionEvent, type RobotServer } from "@twincell/protocol";
import type { AuditLog } from "./audit-log.ts";

/**
 * Writes every act at the robots of a host into the log: when it was asked for where it is a command, and what became
 * of it.
 */
export function auditHost(host: RobotServer, log: AuditLog, onTrouble: (sentence: string) => void): () => void {
  const listener = host.join("audit", {
    send(text) {
      if (!text.startsWith('{"type":"act"')) return;
      const heard = readConnectionEvent(text);
      if (heard.kind === "fault" || heard.message.type !== "act") return;
      const { who, action, detail, station, command, outcome } = heard.message;
      if (outcome === null && !command) return;
      const why = outcome === null || outcome.kind === "done" ? "" : outcome.why.sentence;
      try {
        log.write({
          who,
          action,
          robot: station,
          detail: [detail, why].filter(each => each !== "").join(": "),
          outcome: outcome === null ? "asked" : outcome.kind,
        });
      } catch (problem) {
        // A full disk must not keep a stop or a command from anybody: it is said instead.
        onTrouble(`The audit log cannot be written: ${problem instanceof Error ? problem.message : String(problem)}.`);
      }
    },
    close: () => undefined,
  });
  return () => {
    listener.leave();
  };
}
