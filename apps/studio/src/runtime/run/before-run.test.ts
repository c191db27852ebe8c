import type { Verdict } from "@twincell/core";
import { beforeEach, expect, test } from "vitest";
import { playStore } from "../../stores/play.ts";
import { answerToRun, runQuestionStore } from "../../stores/run-question.ts";
import { stopEverything } from "../../stores/stop.ts";
import { checkState, mayRun } from "./before-run.ts";

const asked = { robots: ["UR10e"], real: false, otherModels: [] };
const finding = (code: string) =>
  ({ code, value: 1, limit: 0, unit: "m", at_s: 0, sentence: code, repairs: [] }) as const;
const verdict = (ok: boolean, ...codes: string[]): Verdict => ({
  ok,
  steps: codes.map((code, i) => ({
    id: `s${i}`,
    verdict: "bad",
    findings: [finding(code)],
  })) as unknown as Verdict["steps"],
  duration_s: 1,
  clearance_m: null,
  torque: { kind: "unknown" } as unknown as Verdict["torque"],
  assumptions: [],
});

beforeEach(() => {
  answerToRun(false);
  playStore.setState({ verdict: verdict(true), current: true, checking: null, trouble: null });
});

test("a program whose check is green as it is now runs unasked", async () => {
  expect(await mayRun(asked)).toBe(true);
  expect(runQuestionStore.getState().question).toBeNull();
});

test("a red check asks first, the worst finding first, and the answer decides", async () => {
  playStore.setState({ verdict: verdict(false, "speed.joint", "collision.contact", "reach.too-far") });
  const state = checkState(playStore.getState());
  expect(state.kind === "red" && state.findings.map(each => each.finding.code)).toEqual([
    "collision.contact",
    "reach.too-far",
    "speed.joint",
  ]);
  const no = mayRun(asked);
  expect(runQuestionStore.getState().question).toEqual(asked);
  answerToRun(false);
  expect(await no).toBe(false);
  const yes = mayRun(asked);
  answerToRun(true);
  expect(await yes).toBe(true);
});

test("not checked, checked before the last edit, under way, in trouble and made for another model are not green", () => {
  for (const change of [{ verdict: null }, { current: false }, { checking: 0.4 }, { trouble: "It broke." }]) {
    playStore.setState({ verdict: verdict(true), current: true, checking: null, trouble: null, ...change });
    expect(checkState(playStore.getState()).kind).not.toBe("green");
    void mayRun(asked);
    expect(runQuestionStore.getState().question).toEqual(asked);
    answerToRun(false);
  }
  playStore.setState({ verdict: verdict(true), current: true, checking: null, trouble: null });
  const other = { ...asked, otherModels: ["GP8"] };
  void mayRun(other);
  expect(runQuestionStore.getState().question).toEqual(other);
});

test("STOP answers the question with no", async () => {
  playStore.setState({ current: false });
  const run = mayRun(asked);
  stopEverything();
  expect(await run).toBe(false);
});
