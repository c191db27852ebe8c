/** What is recorded beside joints, state and events. Every kind has a channel and a JSON schema of its own. */
export interface Notes {
  /** The lines in and out, all of them, whenever one changes. */
  readonly io: { readonly signals: Readonly<Record<string, boolean | number>> };
  /** What was asked of the robot, by whom, and what became of it. */
  readonly command: {
    readonly name: string;
    readonly by: string;
    readonly outcome: "sent" | "done" | "refused" | "stopped";
    readonly sentence: string;
    readonly target: readonly number[];
  };
  /** Something that stands until it is cleared. */
  readonly alarm: { readonly code: string; readonly active: boolean; readonly sentence: string; readonly hint: string };
  /** What a person did: a button, a mode switch, a change of the program. */
  readonly operator: { readonly who: string; readonly action: string; readonly detail: string };
  /** One stage of the link over the time since the last such message [ms]. */
  readonly latency: {
    readonly stage: string;
    readonly direction: "from-robot" | "to-robot" | "round-trip";
    readonly samples: number;
    readonly median_ms: number;
    readonly p99_ms: number;
    readonly worst_ms: number;
  };
  /** What the joints carry, as far as the source says: an empty list is “not reported”. */
  readonly load: {
    readonly torque_Nm: readonly number[];
    readonly current_A: readonly number[];
    readonly temperature_C: readonly number[];
  };
  /** Which cell this was: its name, and a number that changes with every change of it. */
  readonly cell: { readonly name: string; readonly version: string };
}
export type NoteKind = keyof Notes;
export type Note = { readonly [K in NoteKind]: { readonly at_s: number; readonly kind: K } & Notes[K] }[NoteKind];

const string = { type: "string" };
const boolean = { type: "boolean" };
const number = { type: "number" };
const numbers = { type: "array", items: number };
const schema = (name: string, properties: Readonly<Record<string, unknown>>) =>
  ({
    name: `twincell.${name}`,
    encoding: "jsonschema",
    text: JSON.stringify({
      $schema: "https://json-schema.org/draft/2020-12/schema",
      title: `twincell.${name}`,
      type: "object",
      properties,
      required: Object.keys(properties),
    }),
  }) as const;

export const NOTE_SCHEMAS: Readonly<
  Record<NoteKind, { readonly name: string; readonly encoding: string; readonly text: string }>
> = {
  io: schema("Io", { signals: { type: "object", additionalProperties: { anyOf: [boolean, number] } } }),
  command: schema("Command", {
    name: string,
    by: string,
    outcome: { type: "string", enum: ["sent", "done", "refused", "stopped"] },
    sentence: string,
    target: numbers,
  }),
  alarm: schema("Alarm", { code: string, active: boolean, sentence: string, hint: string }),
  operator: schema("OperatorAction", { who: string, action: string, detail: string }),
  latency: schema("Latency", {
    stage: string,
    direction: { type: "string", enum: ["from-robot", "to-robot", "round-trip"] },
    samples: { type: "integer", minimum: 0 },
    median_ms: number,
    p99_ms: number,
    worst_ms: number,
  }),
  load: schema("JointLoad", { torque_Nm: numbers, current_A: numbers, temperature_C: numbers }),
  cell: schema("Cell", { name: string, version: string }),
};

const textOf = (value: unknown): string => (typeof value === "string" ? value : "");
const numberOf = (value: unknown): number => (typeof value === "number" && Number.isFinite(value) ? value : 0);
const numbersOf = (value: unknown): number[] => (Array.isArray(value) ? value.map(numberOf) : []);
const oneOf = <T extends string>(value: unknown, all: readonly T[], otherwise: T): T =>
  all.find(known => known === value) ?? otherwise;
const recordOf = (value: unknown): Record<string, unknown> =>
  typeof value === "object" && value !== null && !Array.isArray(value) ? { ...value } : {};

/** A note from a file; what is missing or strange reads as its quiet default. */
export function noteFrom(kind: NoteKind, json: unknown, at_s: number): Note {
  const of = recordOf(json);
  switch (kind) {
    case "io":
      return {
        at_s,
        kind,
        signals: Object.fromEntries(
          Object.entries(recordOf(of["signals"])).filter(
            (entry): entry is [string, boolean | number] =>
              typeof entry[1] === "boolean" || typeof entry[1] === "number",
          ),
        ),
      };
    case "command":
      return {
        at_s,
        kind,
        name: textOf(of["name"]),
        by: textOf(of["by"]),
        outcome: oneOf(of["outcome"], ["sent", "done", "refused", "stopped"], "sent"),
        sentence: textOf(of["sentence"]),
        target: numbersOf(of["target"]),
      };
    case "alarm":
      return {
        at_s,
        kind,
        code: textOf(of["code"]),
        active: of["active"] !== false,
        sentence: textOf(of["sentence"]),
        hint: textOf(of["hint"]),
      };
    case "operator":
      return { at_s, kind, who: textOf(of["who"]), action: textOf(of["action"]), detail: textOf(of["detail"]) };
    case "latency":
      return {
        at_s,
        kind,
        stage: textOf(of["stage"]),
        direction: oneOf(of["direction"], ["from-robot", "to-robot", "round-trip"], "from-robot"),
        samples: numberOf(of["samples"]),
        median_ms: numberOf(of["median_ms"]),
        p99_ms: numberOf(of["p99_ms"]),
        worst_ms: numberOf(of["worst_ms"]),
      };
    case "load":
      return {
        at_s,
        kind,
        torque_Nm: numbersOf(of["torque_Nm"]),
        current_A: numbersOf(of["current_A"]),
        temperature_C: numbersOf(of["temperature_C"]),
      };
    case "cell":
      return { at_s, kind, name: textOf(of["name"]), version: textOf(of["version"]) };
  }
}
