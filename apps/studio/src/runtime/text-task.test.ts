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
