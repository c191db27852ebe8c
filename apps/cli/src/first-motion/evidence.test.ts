import { PassThrough } from "node:stream";
import { robotById } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { idsOf, isLoopback, verdictOf, type EvidenceStep } from "./evidence.ts";
import { nudged } from "./protocol.ts";
import { questionsOn } from "./questions.ts";

const answered = "2026-11-27T00:00:00.000Z";
const all = (answer: EvidenceStep["answer"]): EvidenceStep[] =>
  idsOf(6).map(id => ({ id, question: "", answer, answered }));

describe("evidence of a first motion", () => {
  test("passed only when every question of that arm was answered with yes; one no is enough to fail", () => {
    expect(verdictOf(all("yes"), 6)).toBe("passed");
    expect(verdictOf(all("yes"), 7)).toBe("incomplete");
    expect(verdictOf(all("yes").slice(1), 6)).toBe("incomplete");
    expect(verdictOf([...all("yes").slice(1), { id: "alone", question: "", answer: "skipped", answered }], 6)).toBe(
      "incomplete",
    );
    expect(verdictOf([...all("yes"), { id: "stop", question: "", answer: "no", answered }], 6)).toBe("failed");
  });

  test("a controller on this machine is a virtual one", () => {
    expect(["127.0.0.2", "localhost", "::1"].every(isLoopback)).toBe(true);
    expect(["192.0.2.7", "robot.example", "1270.example"].some(isLoopback)).toBe(false);
  });

  test("a joint is turned up by 2°, down where its upper limit is near; no other moves", () => {
    const robot = robotById("yaskawa_gp8")!;
    const degree = Math.PI / 180;
    const home = [...robot.home_rad];
    expect(nudged({ robot }, home, 2).map((q, i) => Math.round(((q - home[i]!) / degree) * 1e6) / 1e6)).toEqual([
      0, 0, 2, 0, 0, 0,
    ]);
    home[2] = robot.arm.joints[2]!.limits.upper_rad - degree;
    expect(nudged({ robot }, home, 2)[2]! - home[2]).toBeCloseTo(-2 * degree, 12);
  });

  test("a question is asked again until it is answered; at the end of the input the rest counts as skipped", async () => {
    const input = new PassThrough();
    const output = new PassThrough();
    const questions = questionsOn(input, output, () => answered);
    input.end("perhaps\nYES\nn\n");
    expect(await questions.ask("a", "First?", { off_deg: 0.01 })).toBe("yes");
    expect(await questions.ask("b", "Second?")).toBe("no");
    expect(questions.ended).toBe(false);
    expect(await questions.ask("c", "Third?")).toBe("skipped");
    expect(questions.ended).toBe(true);
    expect(await questions.wait("Go on")).toBe(false);
    expect(questions.asked).toEqual([
      { id: "a", question: "First?", answer: "yes", answered, measured: { off_deg: 0.01 } },
      { id: "b", question: "Second?", answer: "no", answered },
      { id: "c", question: "Third?", answer: "skipped", answered },
    ]);
    expect((output.read() as Buffer).toString().match(/yes, no or skip/g)).toHaveLength(4);
  });
});
