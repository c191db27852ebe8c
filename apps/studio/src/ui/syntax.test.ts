import { LIBRARY } from "@twincell/core";
import { DIALECTS } from "@twincell/languages";
import { tracedCartonCell } from "@twincell/project";
import { expect, test } from "vitest";
import { strokes, syntaxOf } from "./syntax.ts";

const ink = (dialect: string, line: string): string =>
  strokes(line, syntaxOf(dialect))
    .filter(({ ink: colour }) => colour !== "plain")
    .map(({ ink: colour, text }) => `${colour}:${text}`)
    .join(" ");

test("words, numbers and comments of a language have their colours", () => {
  expect(ink("v-plus", "  MOVES #PPOINT(1, -2.5) ; there")).toBe(
    "word:MOVES word:#PPOINT number:1 number:-2.5 comment:; there",
  );
  expect(ink("krl", "ptp {A1 -90.5} C_PTP ; home")).toContain("word:ptp");
  expect(ink("urscript", "  movej([0.1, -1.2e-3]) # go")).toBe("word:movej number:0.1 number:-1.2e-3 comment:# go");
  expect(ink("urscript", "MOVEJ()")).toBe("");
  expect(ink("rapid", "MoveL p1, v100; ! far")).toBe("word:MoveL comment:! far");
  expect(ink("nothing known", "MOVE 1 ; 2")).toBe("number:1 number:2");
});

test("every language has colours of its own, and strokes together are the line", () => {
  const program = tracedCartonCell().programs[0]!;
  for (const dialect of DIALECTS) {
    const file = LIBRARY.map(robot => dialect.emit({ ...program, robot: robot.id, steps: [] }, robot)).find(
      emitted => emitted.kind === "emitted",
    );
    expect(syntaxOf(dialect.id).words.size, dialect.id).toBeGreaterThan(10);
    for (const line of (file?.kind === "emitted" ? file.files[0]!.text : "").split("\n"))
      expect(
        strokes(line, syntaxOf(dialect.id))
          .map(({ text }) => text)
          .join(""),
      ).toBe(line);
  }
});
