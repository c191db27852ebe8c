import {
  emptyProgram,
  LIBRARY,
  type Capability,
  type Dialect,
  type Emitted,
  type Program,
  type SignalLine,
  type Step,
} from "@twincell/core";
import fc from "fast-check";
import { describe, expect, test } from "vitest";
import { DIALECTS } from "./index.ts";

type Kind = SignalLine["kind"];
type Ranges = Partial<Record<Kind, readonly (readonly [number, number])[]>>;

/** Numbers of lines by controller; null where the language names its lines and the numbers are the configuration's. */
const RANGES: Readonly<Record<string, Ranges | null>> = {
  "v-plus": {
    "digital-in": [
      [1001, 1512],
      [2001, 2512],
    ],
    "digital-out": [
      [1, 512],
      [2001, 2512],
    ],
  },
  krl: { "digital-in": [[1, 4096]], "digital-out": [[1, 4096]], "analogue-in": [[1, 32]], "analogue-out": [[1, 32]] },
  inform: { "digital-in": [[1, 4096]], "digital-out": [[1, 4096]], "analogue-out": [[1, 40]] },
  urscript: { "digital-in": [[0, 17]], "digital-out": [[0, 17]], "analogue-in": [[0, 3]], "analogue-out": [[0, 1]] },
  rapid: null,
  "fanuc-ls": {
    "digital-in": [[1, 2048]],
    "digital-out": [[1, 2048]],
    "analogue-in": [[1, 64]],
    "analogue-out": [[1, 64]],
  },
  val3: null,
  "kawasaki-as": { "digital-in": [[1001, 1960]], "digital-out": [[1, 960]] },
  spel: { "digital-in": [[0, 511]], "digital-out": [[0, 511]] },
  "melfa-basic": { "digital-in": [[0, 32767]], "digital-out": [[0, 32767]] },
  pacscript: { "digital-in": [[0, 511]], "digital-out": [[0, 511]] },
  "l-irl": null,
};
const NEEDS: Readonly<Record<Kind, Capability>> = {
  "digital-in": "wait-for",
  "digital-out": "set-digital",
  "analogue-in": "read-analogue",
  "analogue-out": "set-analogue",
};

function using(kind: Kind, address: number, robot: string): Program {
  const signal = "part_line";
  const step: Step =
    kind === "digital-out"
      ? { id: "s1", type: "set", signal, to: true }
      : kind === "analogue-out"
        ? { id: "s1", type: "set", signal, to: 1 }
        : { id: "s1", type: "wait-for", when: kind === "digital-in" ? { signal, is: true } : { signal, above: 1 } };
  return { ...emptyProgram(robot, "Lines"), signals: { [signal]: { kind, address } }, steps: [step] };
}

function emitted(dialect: Dialect, kind: Kind, address: number): Emitted {
  const robot = LIBRARY.find(each => dialect.emit(emptyProgram(each.id), each).kind === "emitted")!;
  return dialect.emit(using(kind, address, robot.id), robot);
}

test("every language is in the table of line numbers", () => {
  expect(Object.keys(RANGES).sort()).toEqual(DIALECTS.map(dialect => dialect.id).sort());
});

describe.each(DIALECTS.map(dialect => [dialect.id, dialect] as const))("line numbers of %s", (id, dialect) => {
  const ranges = RANGES[id];
  const kinds = (Object.keys(NEEDS) as Kind[]).filter(kind => !dialect.cannot.some(({ what }) => what === NEEDS[kind]));
  if (!ranges || kinds.length === 0) {
    test("lines have names, and no number stands in the text", () => {
      for (const kind of kinds) {
        const answer = emitted(dialect, kind, 4321);
        expect(answer.kind).toBe("emitted");
        if (answer.kind === "emitted") for (const { text } of answer.files) expect(text).not.toContain("4321");
      }
    });
    return;
  }
  test.each(kinds.filter(kind => ranges[kind] !== undefined))(
    "%s: each number of the controller is written, every other is refused with the number and the range",
    kind => {
      const allowed = ranges[kind]!;
      const edges = allowed.flatMap(([first, last]) => [first - 1, first, last, last + 1]);
      const number = fc.oneof(
        fc.constantFrom(...edges, 0, 3, 1003, 0.5, -1, 1e6),
        fc.integer({ min: -5, max: 70_000 }),
      );
      fc.assert(
        fc.property(number, address => {
          const answer = emitted(dialect, kind, address);
          const inside =
            Number.isInteger(address) && allowed.some(([first, last]) => address >= first && address <= last);
          // The gripper's own output is the one number of the range that is taken.
          if (answer.kind === "cannot" && inside) expect(answer.sentence).toMatch(/gripper/);
          else expect(answer.kind, `${kind} ${address}`).toBe(inside ? "emitted" : "cannot");
          if (answer.kind !== "cannot") return;
          expect(answer.step).toBe("s1");
          expect(answer.sentence).toContain(String(address));
          if (!inside) for (const edge of allowed.flat()) expect(answer.sentence).toMatch(new RegExp(`\\b${edge}\\b`));
        }),
        { seed: 5, numRuns: 400 },
      );
    },
  );
});

test("an input of V+ with the number 3 is refused, not written as the output 3", () => {
  const vPlus = DIALECTS.find(dialect => dialect.id === "v-plus")!;
  expect(emitted(vPlus, "digital-in", 3)).toEqual({
    kind: "cannot",
    step: "s1",
    sentence: 'Step s1 uses the signal "part_line" with the number 3; inputs of V+ are 1001 to 1512 or 2001 to 2512.',
    hint: "Give the signal a number from 1001 to 1512 or 2001 to 2512.",
  });
});
