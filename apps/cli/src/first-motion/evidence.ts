/** What a person said to a question; `skipped` where nothing was said or `skip` was. */
export type Answer = "yes" | "no" | "skipped";

/** One thing of the protocol that was asked or measured. */
export interface EvidenceStep {
  readonly id: string;
  /** What was asked, as it was shown. */
  readonly question: string;
  readonly answer: Answer;
  /** ISO 8601. */
  readonly answered: string;
  /** Numbers with the unit in their names. */
  readonly measured?: Readonly<Record<string, number | readonly number[]>>;
}

/**
 * The file that the owner of a robot sends back. It names no address of the plant.
 *
 * `passed`: every question was answered with yes. `failed`: one with no. Else `incomplete`.
 */
export interface Evidence {
  readonly format: "twincell.first-motion";
  readonly version: 1;
  readonly twincell: string;
  readonly by: string;
  readonly made: string;
  readonly driver: string;
  readonly model: string;
  /** True where the controller is on this machine, and so a virtual one: such a file says nothing about a real one. */
  readonly virtual: boolean;
  readonly watchdog: string;
  readonly verdict: "passed" | "failed" | "incomplete";
  readonly steps: readonly EvidenceStep[];
}

/** Every question of the protocol for an arm with so many joints, in its order: none may be missing. */
export const idsOf = (joints: number): readonly string[] => [
  "alone",
  "angles",
  ...Array.from({ length: joints }, (_, i) => `joint-${i + 1}`),
  "stop",
  "cable",
];

/** The verdict over what was answered, for an arm with so many joints. */
export function verdictOf(steps: readonly EvidenceStep[], joints: number): Evidence["verdict"] {
  if (steps.some(({ answer }) => answer === "no")) return "failed";
  const confirmed = new Set(steps.filter(({ answer }) => answer === "yes").map(({ id }) => id));
  return idsOf(joints).every(id => confirmed.has(id)) ? "passed" : "incomplete";
}

/** Whether an address is this machine's own. */
export const isLoopback = (host: string): boolean => /^(127\.|localhost$|::1$)/.test(host);
