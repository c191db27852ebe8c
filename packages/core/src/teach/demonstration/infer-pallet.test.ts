import { describe, expect, test } from "vitest";
import {
  inferPallet,
  palletSlots,
  parseProgram,
  seededRandom,
  type Demonstration,
  type InferOptions,
} from "../../index.ts";
import { linesOf, placesMet, randomPallet, type HandNoise } from "./testing/random-pallets.ts";

const WITHIN_M = 0.002;
const WITHIN_RAD = (0.5 * Math.PI) / 180;
const PALLETS = 500;

/** How many of 500 random pallets come out with nine of nine places right, and the longest program of those. */
function right(noise: HandNoise, places: number | undefined): { readonly count: number; readonly lines: number } {
  const random = seededRandom(54);
  let count = 0;
  let lines = 0;
  for (let n = 0; n < PALLETS; n++) {
    const shown = randomPallet(random, noise, places);
    const answer = inferPallet(shown.demonstration, shown.options);
    if (answer.kind !== "program" || placesMet(answer, shown, WITHIN_M, WITHIN_RAD) < 9) continue;
    count++;
    lines = Math.max(lines, linesOf(answer.program.steps));
  }
  return { count, lines };
}

describe("M-54 two of nine placements, drawn at random, become a program for all nine", () => {
  const hasty: HandNoise = { misses_m: 0.005, tremor_m: 0.0015, turns_rad: 0.05 };
  const trembling: HandNoise = { misses_m: 0, tremor_m: 0.005, turns_rad: 0.05 };
  test.each([
    ["a hand that misses every place and part by up to 5 mm", hasty],
    ["a hand whose samples tremble by 5 mm", trembling],
  ])("%s: nine of nine within 2 mm and 0.5° in 95 % of 500 seeded pallets, in at most 12 lines", (_name, noise) => {
    const { count, lines } = right(noise, 9);
    expect(count).toBeGreaterThanOrEqual(0.95 * PALLETS);
    expect(lines).toBeLessThanOrEqual(12);
  });
});

describe("what is understood, and what is refused", () => {
  const still: HandNoise = { misses_m: 0, tremor_m: 0, turns_rad: 0 };
  const shown = randomPallet(seededRandom(3), still, 9);
  const { demonstration, options } = shown;
  const why = (other: Partial<Demonstration>, changed: Partial<InferOptions> = {}): string => {
    const answer = inferPallet({ ...demonstration, ...other }, { ...options, ...changed });
    return answer.kind === "refused" ? answer.why : answer.kind;
  };

  test("a steady hand is understood exactly: rule, grasp, the place it began at and the way in; the program is a valid file", () => {
    const answer = inferPallet(demonstration, options);
    if (answer.kind !== "program") throw new Error(answer.why);
    expect(answer.rules).toEqual(shown.rules);
    expect(answer.grasp).toBe("middle");
    expect(answer.places).toBe(9);
    expect(Math.max(...answer.off_m)).toBeLessThan(1e-9);
    expect(placesMet(answer, shown, 1e-9, 1e-6)).toBe(9);
    expect(parseProgram(JSON.parse(JSON.stringify(answer.program))).kind).toBe("program");
    expect(palletSlots(answer.pallet)).toHaveLength(9);
    expect(answer.program.steps[0]).toMatchObject({
      type: "pallet",
      steps: [
        { path: "ptp", target: { frame: "world" } },
        { path: "lin" },
        { closed: true },
        { path: "lin" },
        { path: "ptp", target: { frame: "Surface places" } },
        { path: "lin" },
        { closed: false },
        { path: "lin" },
      ],
    });
  });

  test("one placement is enough where the number of places is said", () => {
    const end = demonstration.closed.findIndex((is, i) => i > 0 && !is && demonstration.closed[i - 1] === true) + 20;
    const once = {
      times_s: demonstration.times_s.slice(0, end),
      worldFromTcp: demonstration.worldFromTcp.slice(0, end),
      closed: demonstration.closed.slice(0, end),
    };
    const answer = inferPallet(once, options);
    expect(answer).toMatchObject({ kind: "program", places: 9 });
  });

  test("each reason has its own name, and nothing throws", () => {
    const none = demonstration.closed.map(() => false);
    expect(why({ closed: none })).toBe("no-cycle");
    expect(why({ times_s: [0], worldFromTcp: [demonstration.worldFromTcp[0]!], closed: [false] })).toBe("no-cycle");
    expect(why({}, { parts: [] })).toBe("no-part");
    expect(why({}, { surfaces: [] })).toBe("no-surface");
    expect(why({}, { places: 7 * 11 })).toBe("no-grid");
    const far = demonstration.worldFromTcp.map((pose, i) =>
      i > demonstration.worldFromTcp.length / 2
        ? {
            ...pose,
            position: [pose.position[0], pose.position[1] + 0.1, pose.position[2]] as [number, number, number],
          }
        : pose,
    );
    expect(why({ worldFromTcp: far })).toBe("several-feeders");
    const small = options.surfaces.map(box => ({ ...box, size_m: [0.01, 0.01, 0.1] as [number, number, number] }));
    expect(why({}, { surfaces: small })).toBe("no-surface");
  });
});
