import { brakingTime_s, manualScheduler, robotById, seededRandom, type CommandOutcome } from "@twincell/core";
import {
  axisConfig, createCs7Face, createFanucFace, createKukaFace, createKukaRsiFace, createRealController, createStaubliFace, createVirtualCs7, createVirtualFanuc, createVirtualKuka, createVirtualStaubli, memoryNetwork, RSI_NAME, startLoop,
  type Face, type VirtualController,
} from "@twincell/controllers";
import { keptResults } from "./kept.ts";

/**
 * Faults between drivers and virtual controllers, on a virtual clock: in the middle of a motion one thing goes wrong; then
 * everything is put right, and the robot must stand until somebody commands it.
 * `node scripts/soak/kuka-fanuc-faults.ts [FAULTS] [WHICH…]` keeps its results in kuka-fanuc-faults.json.
 */
const SEED = 8, FAULTS = Number(process.argv[2] ?? 3000), WHICH = process.argv.slice(3), PER_CELL = 20, HOST = "127.0.0.1", TICK_S = 0.004;
const nothing = (): { kind: "not-understood"; faults: [] } => ({ kind: "not-understood", faults: [] });
type Act = readonly [act: () => void, kind: "cabinet" | "stop" | "cut" | "weather"];
interface Cell { readonly face: Face; readonly arm: VirtualController; readonly acts: Readonly<Record<string, Act>>; /** A person at the cabinet. */ readonly putRight: () => void; close(): void }
type Clock = ReturnType<typeof manualScheduler>;
type Line = ReturnType<typeof memoryNetwork>;

async function kukaCell(scheduler: Clock, network: Line, random: () => number, overRsi: boolean): Promise<Cell> {
  const robot = robotById("kuka_kr6r900sixx")!, config = axisConfig("127.0.0.2", 49_152), kuka = await createVirtualKuka({ robot, scheduler, network, host: HOST, interpret: nothing, ...(overRsi ? { rsi: { config } } : {}) });
  startLoop(kuka, overRsi ? RSI_NAME : undefined);
  const { pendant, faults } = kuka, options = { robot, scheduler, network, host: HOST };
  return {
    arm: kuka.arm, face: overRsi ? createKukaRsiFace({ ...options, config }) : createKukaFace(options), close() { kuka.close(); },
    acts: {
      "emergency stop": [() => { pendant.setEmergencyStop(true); }, "cabinet"], "gate opened": [() => { pendant.setGuardOpen(true); }, "cabinet"], "message": [() => { pendant.fail("it met something"); }, "cabinet"],
      "key to T1": [() => { pendant.setMode("T1"); }, "cabinet"], "stop key": [() => { pendant.stop(); }, "cabinet"], "off and on": [() => { kuka.reboot(); }, "cabinet"], "deselected": [() => { pendant.cancel(); }, "cabinet"],
      "no answers": [() => { faults.silent = true; }, "cut"], "variables stand still": [() => { faults.frozen = true; }, overRsi ? "weather" : "cut"], "answers late": [() => { faults.delay_s = 0.3; }, overRsi ? "weather" : "cut"], "cut after some answers": [() => { faults.dropAfter = 1 + Math.floor(5 * random()); }, "cut"],
      "answers byte by byte": [() => { faults.split = true; }, "weather"], "garbage in answers": [() => { faults.garbage = 0.2; }, "weather"],
    },
    putRight() {
      Object.assign(faults, { refusing: false, silent: false, delay_s: 0, garbage: 0, split: false, dropAfter: Infinity, frozen: false });
      pendant.setEmergencyStop(false); pendant.setGuardOpen(false); pendant.setMode("EX");
    },
  };
}
async function fanucCell(scheduler: Clock, network: Line): Promise<Cell> {
  const robot = robotById("fanuc_lrmate200id")!, started = await createVirtualFanuc({ robot, scheduler, network, host: HOST });
  if (started.kind === "taken") throw new Error(started.sentence);
  const { virtual } = started, { pendant, faults } = virtual;
  return {
    arm: virtual.arm, face: createFanucFace({ robot, scheduler, network, host: HOST }), close() { virtual.close(); },
    acts: {
      "emergency stop": [() => { pendant.setEmergencyStop(true); }, "cabinet"], "fence opened": [() => { pendant.setGuardOpen(true); }, "cabinet"], "fault": [() => { pendant.fault("SRVO-050 Collision detect"); }, "cabinet"],
      "pendant enabled": [() => { pendant.setKey("T1"); }, "cabinet"], "off and on": [() => { virtual.reboot(); }, "cabinet"],
      "no answers": [() => { faults.silent = true; }, "weather"], "clock stands still": [() => { faults.frozen = true; }, "weather"], "answers late": [() => { faults.delay_s = 0.3; }, "weather"],
    },
    putRight() { Object.assign(faults, { refusing: false, silent: false, delay_s: 0, frozen: false }); pendant.setEmergencyStop(false); pendant.setGuardOpen(false); pendant.setKey("AUTO"); },
  };
}
async function staubliCell(scheduler: Clock, network: Line, random: () => number): Promise<Cell> {
  const robot = robotById("staubli_rx160")!, started = await createVirtualStaubli({ robot, scheduler, network, host: HOST, interpret: nothing });
  if (started.kind === "taken") throw new Error(started.sentence);
  const { virtual } = started, { pendant, faults } = virtual;
  return {
    arm: virtual.arm, face: createStaubliFace({ robot, scheduler, network, host: HOST }), close() { virtual.close(); },
    acts: {
      "emergency stop": [() => { pendant.setEmergencyStop(true); }, "cabinet"], "door opened": [() => { pendant.setDoorOpen(true); }, "cabinet"], "arm fault": [() => { pendant.fail("it met something"); }, "cabinet"],
      "mode to manual": [() => { pendant.setMode("manual"); }, "cabinet"], "hold": [() => { pendant.setHold(true); }, "cabinet"], "off and on": [() => { virtual.reboot(); }, "cabinet"],
      // It has no watchdog: a motion that was sent goes on to its end.
      "no answers": [() => { faults.silent = true; }, "weather"], "states stand still": [() => { faults.frozen = true; }, "weather"], "answers late": [() => { faults.delay_s = 0.3; }, "weather"],
      "cut after some states": [() => { faults.dropAfter = 1 + Math.floor(5 * random()); }, "cut"], "byte by byte": [() => { faults.split = true; }, "weather"], "garbage in states": [() => { faults.garbage = 0.2; }, "weather"],
    },
    putRight() {
      Object.assign(faults, { refusing: false, silent: false, delay_s: 0, garbage: 0, split: false, dropAfter: Infinity, frozen: false });
      pendant.setEmergencyStop(false); pendant.setDoorOpen(false); pendant.setHold(false); pendant.setMode("remote"); pendant.acknowledge();
      // The power comes on as soon as the robot stands.
      const stop = scheduler.every(0.1, () => { if (pendant.setPower(true) === null) stop(); });
    },
  };
}
async function cs7Cell(scheduler: Clock, network: Line, random: () => number): Promise<Cell> {
  const robot = robotById("staubli_rx90l")!, started = await createVirtualCs7({ robot, scheduler, network, host: HOST, interpret: nothing });
  if (started.kind === "taken") throw new Error(started.sentence);
  const { virtual } = started, { pendant, faults } = virtual;
  return {
    arm: virtual.arm, face: createCs7Face({ robot, scheduler, network, host: HOST }), close() { virtual.close(); },
    acts: {
      "emergency stop": [() => { pendant.setEmergencyStop(true); }, "cabinet"], "gate opened": [() => { pendant.setGuardOpen(true); }, "cabinet"], "arm fault": [() => { pendant.fail(); }, "cabinet"],
      "pendant has it": [() => { pendant.setManual(true); }, "cabinet"], "off and on": [() => { virtual.reboot(); }, "cabinet"],
      // It has no watchdog: a motion that was started goes on to its end, or until the next one to connect stops it.
      "no answers": [() => { faults.silent = true; }, "weather"], "states stand still": [() => { faults.frozen = true; }, "weather"], "answers late": [() => { faults.delay_s = 0.3; }, "weather"],
      "cut after some answers": [() => { faults.dropAfter = 1 + Math.floor(5 * random()); }, "weather"], "byte by byte": [() => { faults.split = true; }, "weather"], "garbage in answers": [() => { faults.garbage = 0.2; }, "weather"],
    },
    putRight() {
      Object.assign(faults, { refusing: false, silent: false, delay_s: 0, garbage: 0, split: false, dropAfter: Infinity, frozen: false });
      pendant.setEmergencyStop(false); pendant.setGuardOpen(false); pendant.setManual(false); pendant.type("ENABLE POWER");
      const stop = scheduler.every(0.1, () => { if (virtual.isPowered) { stop(); pendant.type("CALIBRATE"); } });
    },
  };
}
const CELLS: Readonly<Record<string, (scheduler: Clock, network: Line, random: () => number) => Promise<Cell>>> = {
  "KUKA over variables": (scheduler, network, random) => kukaCell(scheduler, network, random, false),
  "KUKA over RSI": (scheduler, network, random) => kukaCell(scheduler, network, random, true),
  "FANUC over RMI": fanucCell,
  "Stäubli over simple_message": staubliCell,
  "Stäubli CS7 over its monitor": cs7Cell,
};

async function soak(make: (typeof CELLS)[string]) {
  const random = seededRandom(SEED), begun_ms = performance.now(), counts: Record<string, number> = {}, odd: Record<string, number> = {};
  const worst_s = { standsAfterCabinet: 0, standsAfterStop: 0, standsAfterCut: 0 };
  let done = 0, newMotions = 0, unended = 0, notBack = 0, braking_s = 0, within_s: number | null = null;
  for (let cell = 0; done < FAULTS; cell++) {
    const scheduler = manualScheduler(), network = memoryNetwork(scheduler, SEED + cell), made = await make(scheduler, network, random), { arm, face } = made, real = createRealController({ face, scheduler });
    braking_s = brakingTime_s(arm.robot);
    within_s = face.watchdog.kind === "robot" ? face.watchdog.within_s : null;
    const acts: Record<string, Act> = {
      ...made.acts,
      "stop": [() => { real.stop(); }, "stop"], "emergency stop from here": [() => { real.stop(true); }, "stop"],
      "cable pulled": [() => { network.weather.frozen = true; }, "cut"], "line cut": [() => { network.cut(); }, "cut"], "half open": [() => { network.cut(true); }, "cut"],
      "loss and disorder": [() => { Object.assign(network.weather, { loss: 0.1, jitter_s: 0.01, duplicates: 0.1 }); }, "weather"], "speed changed": [() => { real.setSpeed(100 * random()); }, "weather"],
    };
    const names = Object.keys(acts), until = async (so: () => boolean, most_s: number, step_s = TICK_S): Promise<number> => {
      const from_s = scheduler.now_s();
      while (!so() && scheduler.now_s() - from_s < most_s) await scheduler.elapse(step_s);
      return so() ? scheduler.now_s() - from_s : Infinity;
    };
    // The arm's own flag does not see corrections: what counts is whether a joint turns.
    let last = arm.jointAngles(), still = 0;
    arm.onSample(({ q_rad }) => { still = q_rad.every((q, i) => Math.abs(q - last[i]!) < 1e-9) ? still + 1 : 0; last = q_rad.slice(); });
    const STILL = 3, stands = (): boolean => still >= STILL;
    const target = (): number[] => arm.robot.home_rad.map((q, i) => i === 0 ? (arm.jointAngle(1) > 0 ? -1 : 1) * (1 + random()) : i === 1 ? q + 0.2 * random() : q);
    void real.connect();
    await scheduler.elapse(0.3);
    for (let trial = 0; trial < PER_CELL && done < FAULTS; trial++, done++) {
      const name = names[Math.floor(random() * names.length)]!, [act, kind] = acts[name]!;
      counts[name] = (counts[name] ?? 0) + 1;
      let outcome: CommandOutcome | null = null;
      void real.moveJoints(target()).then(is => { outcome = is; });
      await scheduler.elapse(0.05 + 0.5 * random());
      act();
      still = 0;
      const after_s = kind === "weather" ? 0 : Math.max(0, await until(stands, 8) - STILL * TICK_S);
      if (kind === "cabinet") worst_s.standsAfterCabinet = Math.max(worst_s.standsAfterCabinet, after_s);
      if (kind === "stop") worst_s.standsAfterStop = Math.max(worst_s.standsAfterStop, after_s);
      if (kind === "cut") worst_s.standsAfterCut = Math.max(worst_s.standsAfterCut, after_s);
      if (await until(() => outcome !== null, 60, 0.02) === Infinity) { unended++; odd[`${name}: no end`] = (odd[`${name}: no end`] ?? 0) + 1; }

      made.putRight();
      Object.assign(network.weather, { loss: 0, jitter_s: 0, duplicates: 0, frozen: false });
      await until(() => real.isConnected, 40, 0.1);
      await until(stands, 8);
      const rest = arm.jointAngles();
      await scheduler.elapse(1.5);
      if (!rest.every((q, i) => Math.abs(q - arm.jointAngles()[i]!) < 1e-9)) { newMotions++; odd[`${name}: moved`] = (odd[`${name}: moved`] ?? 0) + 1; }
      real.setSpeed(100);
      let again: CommandOutcome | null = null;
      for (let tries = 0; tries < 3 && (again as CommandOutcome | null)?.kind !== "done"; tries++) {
        again = null;
        real.reset();
        await scheduler.elapse(1);
        void real.moveJoint(2, arm.robot.home_rad[1]! + 0.1 * random()).then(is => { again = is; });
        await until(() => again !== null, 20, 0.02);
      }
      const end = again as CommandOutcome | null;
      if (end?.kind !== "done") { notBack++; const what = `${name}: not back, ${end?.why.code ?? "no end"}`; odd[what] = (odd[what] ?? 0) + 1; done++; break; }
    }
    real.close(); made.close(); network.close();
  }
  return { faults: done, seconds: Math.round((performance.now() - begun_ms) / 1000), brakingTime_s: braking_s, watchdog_s: within_s, newMotions, unended, notBack, worst_s, counts, odd };
}

const kept = keptResults<Awaited<ReturnType<typeof soak>>>(new URL("kuka-fanuc-faults.json", import.meta.url), {
  what: "faults in the middle of a motion; seconds until standstill at worst; motions nobody commanded; commands that never ended; robots that three resets did not bring back", seed: SEED,
});
for (const [name, make] of Object.entries(CELLS)) {
  if (WHICH.length > 0 && !WHICH.some(which => name.includes(which))) continue;
  const result = await soak(make);
  if (FAULTS >= 1000) kept.keep(name, result);
  process.stdout.write(`${name} ${JSON.stringify(result)}\n`);
}
