import { expect, test } from "vitest";
import {
  handBend,
  handClosed,
  parseHandProfile,
  pose,
  profileOfHand,
  radians,
  readRawHand,
  seededRandom,
  type HandProfile,
} from "../../index.ts";

const accelerometer = { slope_mps2_per_V: 9.6, intercept_mps2: -24 };
const sweep = (flat: number, bent: number): number[] =>
  Array.from({ length: 20 }, (_, i) => Math.round(flat + ((bent - flat) * i) / 19));
const profile = (): HandProfile => {
  const answer = profileOfHand(
    "Ana",
    [1, 2, 3, 4, 5].map(n => sweep(300 + n, 3000 + 10 * n)),
    accelerometer,
  );
  if (answer.kind !== "profile") throw new Error(answer.sentence);
  return answer.profile;
};

test("M-26 M-27 M-29 a profile is one person's: range of each finger from opening and closing, kept as text and read again", () => {
  const ana = profile();
  expect(ana.fingers[2]).toEqual({ flat: 303, bent: 3030 });
  expect(parseHandProfile(JSON.stringify(ana))).toEqual(ana);
  for (const text of [
    "",
    "{}",
    "[]",
    JSON.stringify({ ...ana, fingers: ana.fingers.slice(1) }),
    JSON.stringify({ ...ana, version: 2 }),
  ])
    expect(parseHandProfile(text)).toBeNull();
  expect(profileOfHand("Ben", [[1, 2], [], [], [], []], accelerometer)).toEqual({
    kind: "incomplete",
    sentence: "Finger 1: The finger moved through 1 counts; 64 are needed. Open and close the hand fully.",
  });
});

test("M-24 M-28 closing the hand beyond 50° picks, opening it below 35° places, and nothing in between changes", () => {
  const ana = profile();
  const bent = (share: number): number =>
    handBend(
      ana.fingers.map(({ flat, bent: full }) => Math.round(flat + share * (full - flat))),
      ana,
    );
  expect(bent(0.5)).toBeCloseTo(radians(45), 3);
  expect(handClosed(bent(0.5), false)).toBe(false);
  expect(handClosed(bent(0.5), true)).toBe(true);
  expect([handClosed(bent(0.6), false), handClosed(bent(0.3), true)]).toEqual([true, false]);
  expect(handBend([NaN, -1, 5000, 1.5, Infinity], ana)).toBe(0);
});

/**
 * 50 lines a second of a hand that goes 0.25 m along its own x, a quarter turn about z in the world, and closes at the
 * end.
 */
function raw(): string {
  const V = (a: number): number => (a - accelerometer.intercept_mps2) / accelerometer.slope_mps2_per_V;
  const lines = Array.from({ length: 151 }, (_, i) => {
    const t = i / 50;
    // 1 m/s² for half a second, −1 for half a second: 0.25 m.
    const a = i < 25 ? 1 : i < 50 ? -1 : 0;
    const finger = i > 100 ? 2900 : 310;
    return [t, V(a), V(0), V(0), 0, 0, Math.SQRT1_2, Math.SQRT1_2, finger, finger, finger, finger, finger].join(",");
  });
  return `t_s,ax_V,ay_V,az_V,qx,qy,qz,qw,f1,f2,f3,f4,f5\n${lines.join("\n")}\n`;
}

test("M-30 M-31 M-32 M-34 volts at 50 samples a second become a way along the turned axis, and the fingers the grip", () => {
  const start = pose<"world", "tcp">([0.5, 0, 0.4], [1, 0, 0, 0]);
  const answer = readRawHand(raw(), profile(), start);
  if (answer.kind !== "demonstration") throw new Error(answer.sentence);
  const { times_s, worldFromTcp, closed } = answer.demonstration;
  expect([times_s.length, answer.dropped]).toEqual([151, 0]);
  const end = worldFromTcp.at(-1)!;
  expect(end.position[0]).toBeCloseTo(0.5, 9);
  expect(end.position[1]).toBeCloseTo(0.25, 9);
  expect(end.quaternion.map(v => Number(v.toFixed(9)))).toEqual([1, 0, 0, 0]);
  expect([closed[100], closed[101]]).toEqual([false, true]);
});

test("a glove that sends garbage: 2,000 texts, samples dropped and counted, no number that is none", () => {
  const random = seededRandom(7);
  const good = raw().split("\n");
  for (let n = 0; n < 2000; n++) {
    const lines = good
      .slice(0, 40)
      .map(line => (random() < 0.3 ? line.slice(0, Math.floor(random() * line.length)) + "\u0007x,9e999" : line));
    const answer = readRawHand(lines.join("\n"), profile(), pose());
    if (answer.kind === "demonstration") {
      expect(answer.dropped).toBeGreaterThan(0);
      for (const { position } of answer.demonstration.worldFromTcp) expect(position.every(Number.isFinite)).toBe(true);
    } else expect(answer.sentence).toContain("readable samples");
  }
});
