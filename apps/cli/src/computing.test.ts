import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { afterAll, describe, expect, test } from "vitest";

const root = fileURLToPath(new URL("../../../", import.meta.url));
const folder = mkdtempSync(join(tmpdir(), "twincell-computing-"));
afterAll(() => {
  rmSync(folder, { recursive: true, force: true });
});

/** The command as users run it. */
function twincell(...args: readonly string[]) {
  const run = spawnSync(process.execPath, ["apps/cli/src/main.ts", ...args], {
    cwd: root,
    encoding: "utf8",
    maxBuffer: 1 << 28,
  });
  return { code: run.status ?? -1, out: run.stdout, err: run.stderr };
}

const DOWN = [0, -1.4, 1.5, 0, 0.9, 0];
const UP = [0.2, -1.3, 1.4, 0, 0.9, 0];
const move = (id: string, q: readonly number[]) => ({
  id,
  type: "move",
  path: "ptp",
  target: { q },
  speed: { ratio: 0.5 },
});
/** Three rounds of a counted loop, and a wait that is given up after half a second. */
const COUNTED = {
  format: "twincell.program",
  version: 2,
  name: "Counted",
  robot: "staubli_rx90l",
  signals: { part: { kind: "digital-in", address: 1003 }, lamp: { kind: "digital-out", address: 5 } },
  variables: { count: { type: "int" } },
  steps: [
    move("start", UP),
    {
      id: "wait",
      type: "wait-for",
      when: { signal: "part", is: true },
      timeout_s: 0.5,
      late: [{ id: "lamp", type: "set", signal: "lamp", to: true }],
    },
    {
      id: "loop",
      type: "while",
      when: { expression: { op: "<", of: [{ variable: "count" }, 3] } },
      steps: [
        move("down", DOWN),
        { id: "again", type: "assign", variable: "count", to: { op: "+", of: [{ variable: "count" }, 1] } },
        move("up", UP),
      ],
    },
  ],
};
function written(name: string, program: object): string {
  const path = join(folder, `${name}.json`);
  writeFileSync(path, JSON.stringify(program));
  return path;
}
/** How often joint 1 turns back towards 0 and away again. */
function rounds(out: string): number {
  let isUp = false;
  let count = 0;
  for (const line of out.trim().split("\n")) {
    const { q_rad, q } = JSON.parse(line) as { q_rad?: number[]; q?: number[] };
    const first = (q_rad ?? q)![0]!;
    if (isUp && first < 0.01) {
      isUp = false;
      count++;
    } else if (first > 0.19) isUp = true;
  }
  return count;
}

describe("programs that compute", () => {
  test("check follows the counter and says what it took for granted", () => {
    const { code, out, err } = twincell("check", written("counted", COUNTED));
    const verdict = JSON.parse(out) as { ok: boolean; assumptions: string[]; steps: { id: string; verdict: string }[] };
    expect({ code, err, ok: verdict.ok }).toEqual({ code: 0, err: "", ok: true });
    expect(verdict.steps.map(({ id }) => id)).toEqual(["start", "wait", "lamp", "loop", "down", "again", "up"]);
    expect(verdict.assumptions.join(" ")).toContain("Decisions that variables alone take were followed");
  });

  test("a loop that never ends is refused with its step", () => {
    const endless = structuredClone(COUNTED);
    (endless.steps[2] as { steps: unknown[] }).steps = [{ id: "again", type: "assign", variable: "count", to: 0 }];
    const judged = twincell("check", written("endless", endless));
    const { steps } = JSON.parse(judged.out) as { steps: { id: string; findings: { sentence: string }[] }[] };
    expect(judged.code).toBe(1);
    expect(steps.find(({ id }) => id === "loop")!.findings[0]!.sentence).toContain(
      "its loop went round 100000 times without a motion or a wait",
    );
  });

  test("a wrong expression is refused with its place", () => {
    const wrong = structuredClone(COUNTED);
    (wrong.steps[2] as { when: unknown }).when = { expression: { op: "<", of: [{ variable: "cuont" }, 3] } };
    const refused = twincell("check", written("wrong", wrong));
    expect(refused.code).not.toBe(0);
    expect(refused.err).toContain("steps[2].when.expression.of[0]");
    expect(refused.err).toContain("no variable “cuont” here");
  });

  test("simulate plans three rounds, and the posted text runs the same three", () => {
    const path = written("three", COUNTED);
    const planned = twincell("simulate", path, "--period", "0.004");
    expect(planned.code, planned.err).toBe(0);
    expect(rounds(planned.out)).toBe(3);
    const posted = twincell("post", path, "--to", "v-plus", "-o", join(folder, "post"));
    expect(posted.code, posted.err).toBe(0);
    const text = (JSON.parse(posted.out) as { files: string[] }).files.find(file => file.endsWith(".v2"))!;
    expect(readFileSync(text, "utf8")).toContain("WHILE count < 3 DO");
    const ran = twincell("run", text, "--robot", "staubli_rx90l", "--dialect", "v-plus", "--period", "0.004");
    expect(ran.code, ran.err).toBe(0);
    expect(rounds(ran.out)).toBe(3);
  });
});
