import { writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { createRealController, createUrFace, createVirtualUr, memoryNetwork, RUNTIME } from "@twincell/controllers";
import { manualScheduler, robotById, seededRandom, type CommandOutcome } from "@twincell/core";

/**
 * Faults by the thousand between the UR driver and its virtual controller, on a virtual clock: in the middle of a motion one
 * thing goes wrong; then everything is put right, and the robot must stand until somebody commands it.
 * `node scripts/soak/ur-faults.ts [FAULTS [keep]]` keeps its result in ur-faults.json when no number is given, or when it is asked to.
 */
const SEED = 17, FAULTS = Number(process.argv[2] ?? 10_000), PER_CELL = 25, HOST = "127.0.0.1", TICK_S = 0.002;
const robot = robotById("ur10e")!, random = seededRandom(SEED), begun_ms = performance.now();
type Kind = "silence" | "robot" | "stop" | "weather";
const worst = { programEndsAfterSilence_s: 0, standsAfterSilence_s: 0, lostAfterSilence_s: 0, standsAfterRobot_s: 0, standsAfterStop_s: 0 };
const counts: Record<string, number> = {}, outcomes: Record<string, number> = {};
const count = (where: Record<string, number>, what: string): void => { where[what] = (where[what] ?? 0) + 1; };
const inWords = (outcome: CommandOutcome | undefined): string => outcome === undefined ? "no end" : outcome.kind === "done" ? "done" : `${outcome.kind}, ${outcome.why.code}`;
const watched = (command: Promise<CommandOutcome>): { outcome: CommandOutcome | undefined } => {
  const held: { outcome: CommandOutcome | undefined } = { outcome: undefined };
  void command.then(outcome => { held.outcome = outcome; });
  return held;
};
let newMotions = 0, unended = 0, notBack = 0, tooFast = 0, done = 0, braking_s = 0;

for (let cell = 0; done < FAULTS; cell++) {
  const scheduler = manualScheduler(), network = memoryNetwork(scheduler, SEED + cell);
  const started = await createVirtualUr({ robot, scheduler, network, host: HOST, powerOn_s: 0.2, brakes_s: 0.2, interpret: () => ({ kind: "not-understood", faults: [] }) });
  if (started.kind === "taken") throw new Error(started.sentence);
  const { virtual: ur } = started, { pendant, faults } = ur, real = createRealController({ face: createUrFace({ robot, scheduler, network, host: HOST }), scheduler });
  braking_s = ur.brakingTime_s;
  const limits = robot.arm.joints.map(joint => joint.limits.speed_rad_s), last = ur.jointAngles(), now = ur.jointAngles();
  scheduler.every(TICK_S, () => {
    ur.jointAngles(now);
    for (let i = 0; i < now.length; i++) if (Math.abs(now[i]! - last[i]!) > limits[i]! * TICK_S * 1.000001) tooFast++;
    last.set(now);
  });
  /** Lets time pass until that is so; the seconds it took, or endlessly many. */
  const until = async (so: () => boolean, most_s: number, step_s = TICK_S): Promise<number> => {
    const from_s = scheduler.now_s();
    while (!so() && scheduler.now_s() - from_s < most_s) await scheduler.elapse(step_s);
    return so() ? scheduler.now_s() - from_s : Infinity;
  };
  const stands = (): boolean => !ur.state.moving, ended = (): boolean => ur.state.runtime !== RUNTIME.PLAYING;
  const acts: Readonly<Record<string, { readonly act: () => void; readonly kind: Kind }>> = {
    "cable pulled": { act() { network.weather.frozen = true; }, kind: "silence" },
    "line cut": { act() { network.cut(); }, kind: "silence" },
    "half-open line": { act() { network.cut(true); }, kind: "silence" },
    "states lost": { act() { faults.silent = true; }, kind: "robot" },
    "broken off": { act() { faults.dropAfter = 1; }, kind: "robot" },
    "emergency stop": { act() { pendant.emergencyStop(true); }, kind: "robot" },
    "protective stop": { act() { pendant.protectiveStop("A test."); }, kind: "robot" },
    "gate opened": { act() { pendant.setGuardOpen(true); }, kind: "robot" },
    "local control": { act() { pendant.setMode("manual"); }, kind: "robot" },
    "fault": { act() { pendant.fault("A test."); }, kind: "robot" },
    "off and on": { act() { ur.reboot(); }, kind: "robot" },
    "stop": { act() { real.stop(); }, kind: "stop" },
    "emergency stop from here": { act() { real.stop(true); }, kind: "stop" },
    "stop over a slow line": { act() { Object.assign(network.weather, { delay_s: 0.02, jitter_s: 0.02 }); real.stop(); }, kind: "stop" },
    "garbage": { act() { network.weather.garbage = 0.05; }, kind: "weather" },
    "single bytes": { act() { network.weather.pieces = 1; }, kind: "weather" },
    "delay and jitter": { act() { Object.assign(network.weather, { delay_s: 0.01 * random(), jitter_s: 0.02 * random() }); }, kind: "weather" },
    "some states lost": { act() { faults.loss = 0.3 * random(); }, kind: "weather" },
    "speed changed": { act() { real.setSpeed(20 + 80 * random()); }, kind: "weather" },
  };
  const names = Object.keys(acts);
  let lost_s = Infinity;
  real.onLink(({ state }) => { if (state === "lost") lost_s = Math.min(lost_s, scheduler.now_s()); });
  void real.connect();
  await until(() => real.isConnected, 5, 0.05);

  for (let trial = 0; trial < PER_CELL && done < FAULTS; trial++, done++) {
    const name = names[Math.floor(random() * names.length)]!, { act, kind } = acts[name]!;
    count(counts, name);
    const target = Float64Array.from(robot.home_rad);
    target[0] = ur.jointAngles()[0]! > 0 ? -1 - random() : 1 + random();
    const first = watched(real.moveJoints(target));
    await scheduler.elapse(0.05 + 0.7 * random());
    const from_s = scheduler.now_s();
    lost_s = Infinity;
    act();
    if (kind === "silence") {
      worst.programEndsAfterSilence_s = Math.max(worst.programEndsAfterSilence_s, await until(ended, 1));
      const stood_s = await until(stands, 5) === Infinity ? Infinity : scheduler.now_s();
      worst.standsAfterSilence_s = Math.max(worst.standsAfterSilence_s, stood_s - from_s);
      worst.lostAfterSilence_s = Math.max(worst.lostAfterSilence_s, lost_s - from_s);
    }
    if (kind === "robot" || kind === "stop") {
      const after_s = await until(stands, 5), which = kind === "robot" ? "standsAfterRobot_s" : "standsAfterStop_s";
      worst[which] = Math.max(worst[which], after_s);
    }
    if (await until(() => first.outcome !== undefined, 40, 0.05) === Infinity) unended++;
    count(outcomes, `${name}: ${inWords(first.outcome)}`);

    // Everything is put right: the robot stands until it is commanded.
    Object.assign(network.weather, { delay_s: 0, jitter_s: 0, garbage: 0, pieces: 0, frozen: false });
    Object.assign(faults, { silent: false, dropAfter: 0, loss: 0 });
    pendant.emergencyStop(false); pendant.setGuardOpen(false); pendant.setMode("remote");
    await until(stands, 10, 0.01);
    const rest = ur.jointAngles()[0]!;
    // A guard that opened holds a program, which goes on when it is closed: that is the vendor's way, and no new motion.
    await scheduler.elapse(4);
    await until(() => real.isConnected, 40, 0.1);
    if (Math.abs(ur.jointAngles()[0]! - rest) > 1e-9 && name !== "gate opened") newMotions++;
    real.setSpeed(100);
    let again = watched(Promise.resolve<CommandOutcome>({ kind: "done" }));
    for (let tries = 0; tries < 3; tries++) {
      real.reset();
      await scheduler.elapse(2);
      again = watched(real.moveJoint(2, -1 - 0.1 * random()));
      await until(() => again.outcome !== undefined, 20, 0.02);
      if (again.outcome?.kind === "done") break;
    }
    if (again.outcome?.kind !== "done") { notBack++; count(outcomes, `${name}: not back, ${inWords(again.outcome)}`); done++; break; }
  }
  real.close();
  ur.close();
  network.close();
}
const result = {
  what: "faults in the middle of a motion; at worst: how long after the driver fell silent its program on the robot had ended, until it stood (silence and braking together), until the link counted as lost, and until standstill after a stop at the robot or from here; motions nobody commanded; cycles in which a joint was too fast; commands that never ended; robots that could not be driven afterwards",
  date: new Date().toISOString().slice(0, 10), machine: `${cpus()[0]?.model ?? "unknown"}, Node ${process.versions.node}`,
  seed: SEED, faults: done, seconds: Math.round((performance.now() - begun_ms) / 1000), watchdog_s: 0.08, brakingTime_s: braking_s, newMotions, tooFast, unended, notBack, worst, counts, outcomes,
};
if (process.argv[2] === undefined || process.argv[3] === "keep") writeFileSync(new URL("ur-faults.json", import.meta.url), `${JSON.stringify(result, null, 2)}\n`);
process.stdout.write(`${JSON.stringify(result, null, 2)}\n`);
