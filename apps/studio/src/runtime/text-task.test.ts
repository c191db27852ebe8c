import { identity } from "@twincell/core";
import { expect, test } from "vitest";
import { textTask } from "./text-task.ts";

test("what of a text is shown and not executed is a finding at its line", () => {
  const text = [
    "def job():",
    "  thread counter():",
    "    while (True):",
    "      sync()",
    "    end",
    "  end",
    "  run counter()",
    "  movej([0.1, -1.2, 1.3, -1.6, -1.5, 0.2], a=1.4, v=1.05)",
    "end",
    "job()",
  ].join("\n");
  const answer = textTask({
    kind: "read",
    id: 1,
    language: "urscript",
    name: "job",
    files: [{ name: "job.script", text }],
    main: "job.script",
    robot: "ur10e",
    worldFromBase: identity(),
  });
  expect(answer).toMatchObject({
    kind: "read",
    read: {
      findings: [
        {
          file: 0,
          line: 2,
          verdict: "warn",
          sentence: "Thread counter is shown, not executed: it does not move the robot.",
        },
      ],
    },
  });
});

test("lines that do what only the controller knows are told apart: a called program that is in none of the files", () => {
  const text = [
    "/PROG MAIN",
    "/MN",
    "   1:  J P[1] 50% FINE ;",
    "   2:  CALL PICK ;",
    "/POS",
    "P[1]{",
    "   GP1:",
    "  UF : 0, UT : 1,",
    "  J1= 0.000 deg, J2= 0.000 deg, J3= 0.000 deg,",
    "  J4= 0.000 deg, J5= -90.000 deg, J6= 0.000 deg",
    "};",
    "/END",
    "",
  ].join("\n");
  const answer = textTask({
    kind: "read",
    id: 1,
    language: "fanuc-ls",
    name: "main",
    files: [{ name: "main.ls", text }],
    main: "main.ls",
    robot: "fanuc_lrmate200id",
    worldFromBase: identity(),
  });
  if (answer.kind !== "read") throw new Error(answer.kind);
  expect(answer.read.program?.steps).toHaveLength(1);
  expect(answer.read.assumed.map(({ line }) => line)).toContain(4);
  expect(answer.read.assumed.find(({ line }) => line === 4)!.sentence).toContain("PICK");
});
