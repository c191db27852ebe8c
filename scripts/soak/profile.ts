import { writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { canBeLeft, canBeReached, JerkMotion, JerkPlanner, seededRandom } from "@twincell/core";

/**
 * 10,000 jerk-limited motions between seeded states of seeded limits, each looked at in 100,000 instants: how far
 * speed, acceleration and jerk are over their limits at worst. `node scripts/soak/profile.ts` takes about a minute and
 * keeps its result in profile.json.
 */
const SEED = 71;
const MOTIONS = 10_000;
const INSTANTS = 100_000;
const random = seededRandom(SEED);
const q = new Float64Array(1);
const v = new Float64Array(1);
const a = new Float64Array(1);
const worst = { speed: 0, acceleration: 0, jerk: 0, end: 0 };
const begun_ms = performance.now();
for (let k = 0; k < MOTIONS; k++) {
  const speed = 0.2 + random() * 5;
  const acceleration = 0.5 + random() * 20;
  const jerk = 5 + random() * 200;
  const state = (fits: typeof canBeLeft): readonly [number, number] => {
    for (;;) {
      const s = (random() * 2 - 1) * speed;
      const b = random() < 0.3 ? 0 : (random() * 2 - 1) * acceleration;
      if (fits(s, b, speed, acceleration, jerk)) return [s, b];
    }
  };
  const [v0, a0] = state(canBeLeft);
  const [v1, a1] = state(canBeReached);
  const from = random() * 6 - 3;
  const to = random() * 6 - 3;
  const motion = new JerkMotion(1);
  const answer = new JerkPlanner([{ speed, acceleration, jerk }]).plan(
    { place: [from], speed: [v0], acceleration: [a0] },
    { place: [to], speed: [v1], acceleration: [a1] },
    motion,
  );
  if (answer.kind !== "planned") throw new Error(`Motion ${k}: ${answer.kind}.`);
  const h = (motion.duration_s * (1 - 1e-15)) / (INSTANTS - 1);
  let before = a0;
  for (let i = 0; i < INSTANTS; i++) {
    motion.sample(h * i, q, v, a);
    worst.speed = Math.max(worst.speed, Math.abs(v[0]!) / speed - 1);
    worst.acceleration = Math.max(worst.acceleration, Math.abs(a[0]!) / acceleration - 1);
    // Differences of accelerations lose digits where h is small: 1e-15 of the acceleration over h.
    if (i > 0 && h > 0)
      worst.jerk = Math.max(worst.jerk, (Math.abs(a[0]! - before) - 4e-15 * acceleration) / (h * jerk) - 1);
    before = a[0]!;
  }
  worst.end = Math.max(worst.end, Math.abs(q[0]! - to), Math.abs(v[0]! - v1), Math.abs(a[0]! - a1));
}
const result = {
  what: "share by which a limit is exceeded at worst; end: distance from the end state asked for, just before it is reached",
  date: new Date().toISOString().slice(0, 10),
  machine: `${cpus()[0]?.model ?? "unknown"}, Node ${process.versions.node}`,
  seed: SEED,
  motions: MOTIONS,
  instants: INSTANTS,
  seconds: Math.round((performance.now() - begun_ms) / 1000),
  worst,
};
writeFileSync(new URL("profile.json", import.meta.url), `${JSON.stringify(result, null, 2)}\n`);
process.stdout.write(`${JSON.stringify(result)}\n`);
