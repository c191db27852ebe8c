import { writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { brakingTime_s, manualScheduler, robotById, seededRandom, type CommandOutcome } from "@twincell/core";
import { createRealController, createVirtualYaskawa, memoryNetwork, yaskawaFace, YASKAWA_EXAMPLE_SCALE } from "@twincell/controllers";

/**
 * Faults by the thousand between the Yaskawa driver and its virtual controller, on a virtual clock: in the middle of a
 * motion one thing goes wrong; then everything is put right, and the robot must stand until somebody commands it.
 * `node scripts/soak/yaskawa-faults.ts [FAULTS]` keeps its result in yaskawa-faults.json.
 */
const SEED = 6, FAULTS = Number(process.argv[2] ?? 10_000), PER_CELL = 25, HOST = "127.0.0.1", TICK_S = 0.004;
const robot = robotById("yaskawa_gp8")!, random = seededRandom(SEED), begun_ms = performance.now();
const braking_s = brakingTime_s(robot) + 2 * TICK_S;
const worst = { lostAfter_s: 0, standsAfterCabinet_s: 0, standsAfterStop_s: 0, standsAfterSilence_s: 0 };
const counts: Record<string, number> = {}, outcomes: Record<string, number> = {};
const count = (where: Record<string, number>, what: string): void => { where[what] = (where[what] ?? 0) + 1; };
const inWords = (outcome: CommandOutcome | undefined): string => outcome === undefined ? "no end" : outcome.kind === "done" ? "done" : `${outcome.kind}, ${outcome.why.code}`;
const watched = (command: Promise<CommandOutcome>): { outcome: CommandOutcome | undefined } => {
  const held: { outcome: CommandOutcome | undefined } = { outcome: undefined };
  void command.then(outcome => { held.outcome = outcome; });
  return held;
};
let newMotions = 0, unended = 0, notBack = 0, done = 0;

for (let cell = 0; done < FAULTS; cell++) {
  const scheduler = manualScheduler(), network = memoryNetwork(scheduler, SEED + cell);
  const started = await createVirtualYaskawa({ robot, scheduler, network, host: HOST, servoOn_s: 0.1, seed: SEED + cell });
  if (started.kind === "taken") throw new Error(started.sentence);
  const { controller: virtual } = started, { neutral, pendant, faults } = virtual;
  const real = createRealController({ face: yaskawaFace({ robot, scheduler, network, host: HOST, scale: YASKAWA_EXAMPLE_SCALE }), scheduler });
  /** Lets time pass until that is so; the seconds it took, or -1. */
  const until = async (so: () => boolean, most_s: number, step_s = TICK_S): Promise<number> => {
    const from_s = scheduler.now_s();
    while (!so() && scheduler.now_s() - from_s < most_s) await scheduler.elapse(step_s);
    return so() ? scheduler.now_s() - from_s : -1;
  };
  const stands = (): boolean => !neutral.isMoving();
  const acts: Readonly<Record<string, { readonly act: () => void; readonly kind: "cabinet" | "stop" | "silence" | "cut" | "weather" }>> = {
    "emergency stop": { act() { pendant.emergencyStop(true); }, kind: "cabinet" },
    "gate opened": { act() { pendant.setGuardOpen(true); }, kind: "cabinet" },
    "alarm": { act() { pendant.raiseAlarm(4320, "OVERLOAD"); }, kind: "cabinet" },
    "key to TEACH": { act() { pendant.setMode("teach"); }, kind: "cabinet" },
    "hold at the pendant": { act() { pendant.hold(true); }, kind: "cabinet" },
    "off and on": { act() { virtual.reboot(0.5 + random()); }, kind: "cabinet" },
    "stop": { act() { real.stop(); }, kind: "stop" },
    "emergency stop from here": { act() { real.stop(true); }, kind: "stop" },
    "stop over a bad line": { act() { Object.assign(network.weather, { loss: 0.3, jitter_s: 0.02, duplicates: 0.2 }); real.stop(); }, kind: "stop" },
    "answers lost": { act() { faults.refusing = true; }, kind: "silence" },
    "answers with wrong ids": { act() { faults.wrongId = 1; }, kind: "silence" },
    "answers a second late": { act() { faults.delay_s = 1; }, kind: "silence" },
    "cable pulled": { act() { network.weather.frozen = true; }, kind: "cut" },
    "server hangs": { act() { faults.frozen = true; }, kind: "cut" },
    "loss": { act() { network.weather.loss = 0.05 + 0.2 * random(); }, kind: "weather" },
    "reorder and duplicates": { act() { Object.assign(network.weather, { jitter_s: 0.03, duplicates: 0.3 }); }, kind: "weather" },
    "garbage": { act() { network.weather.garbage = 0.05; }, kind: "weather" },
    "speed changed": { act() { real.setSpeed(5 + 95 * random()); }, kind: "weather" },
  };
  const names = Object.keys(acts);
  void real.connect();
  await scheduler.elapse(0.2);

  for (let trial = 0; trial < PER_CELL && done < FAULTS; trial++, done++) {
    const name = names[Math.floor(random() * names.length)]!, { act, kind } = acts[name]!;
    count(counts, name);
    const target = Float64Array.from(robot.home_rad);
    target[0] = neutral.jointAngle(1) > 0 ? -1 - 1.8 * random() : 1 + 1.8 * random();
    const first = watched(real.moveJoints(target));
    await scheduler.elapse(0.6 * random());
    act();
    if (kind === "silence" || kind === "cut") worst.lostAfter_s = Math.max(worst.lostAfter_s, await until(() => !real.isConnected, 1, 0.002));
    // With the line cut both ways nothing stops the robot before its target; that it has no watchdog is said by the driver.
    const after_s = kind === "weather" ? 0 : await until(stands, 5);
    if (kind === "cabinet") worst.standsAfterCabinet_s = Math.max(worst.standsAfterCabinet_s, after_s < 0 ? Infinity : after_s);
    if (kind === "stop") worst.standsAfterStop_s = Math.max(worst.standsAfterStop_s, after_s < 0 ? Infinity : after_s);
    if (kind === "silence") worst.standsAfterSilence_s = Math.max(worst.standsAfterSilence_s, after_s < 0 ? Infinity : after_s);
    if (await until(() => first.outcome !== undefined, 40, 0.02) < 0) unended++;
    count(outcomes, `${name}: ${inWords(first.outcome)}`);

    // Everything is put right: the robot stands until it is commanded.
    Object.assign(network.weather, { loss: 0, jitter_s: 0, duplicates: 0, garbage: 0, frozen: false });
    Object.assign(faults, { refusing: false, wrongId: 0, delay_s: 0, frozen: false });
    pendant.emergencyStop(false); pendant.setGuardOpen(false); pendant.hold(false); pendant.setMode("remote");
    // A silence that has just begun is noticed first.
    await scheduler.elapse(0.2);
    await until(() => real.isConnected, 40, 0.1);
    await until(stands, 5);
    const rest = neutral.jointAngle(1);
    await scheduler.elapse(1.2);
    if (Math.abs(neutral.jointAngle(1) - rest) > 1e-9) newMotions++;
    real.setSpeed(100);
    real.reset();
    await scheduler.elapse(0.4);
    const again = watched(real.moveJoint(2, 0.1 * random()));
    await until(() => again.outcome !== undefined, 20, 0.02);
    if (again.outcome?.kind !== "done") { notBack++; count(outcomes, `${name}: not back, ${inWords(again.outcome)}`); break; }
  }
  real.close();
  virtual.close();
  network.close();
}
const result = {
  what: "faults in the middle of a motion; how long until the link counts as lost and until standstill at worst; motions nobody commanded; commands that never ended; robots that could not be driven afterwards",
  date: new Date().toISOString().slice(0, 10), machine: `${cpus()[0]?.model ?? "unknown"}, Node ${process.versions.node}`,
  seed: SEED, faults: done, seconds: Math.round((performance.now() - begun_ms) / 1000), brakingTime_s: braking_s, newMotions, unended, notBack, worst, counts, outcomes,
};
writeFileSync(new URL("yaskawa-faults.json", import.meta.url), `${JSON.stringify(result, null, 2)}\n`);
process.stdout.write(`${JSON.stringify(result, null, 2)}\n`);
