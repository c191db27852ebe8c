import { planProgram, unrolled, type CommandOutcome, type Dialect, type OperatingMode, type Pose, type Program, type Refusal, type Robot, type Scheduler, type Signals, type Step } from "@twincell/core";
import { createRealController, type Brand, type BrandVirtual, type ControllerData, type PortNumbers } from "../real/index.ts";
import { memoryNetwork, type Network } from "../transport/index.ts";
import { withLines } from "../runner/index.ts";
import type { Seat } from "../guard/index.ts";
import { createStation, type Station } from "./station.ts";

export interface OpenOptions {
  readonly id: string;
  readonly brand: Brand;
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  /** The language its controllers run. */
  readonly dialect: Dialect;
  readonly name?: string;
  readonly worldFromBase?: Pose<"world", "base">;
  /** Where the controller is. Left out, a virtual one is started beside its driver, in memory. */
  readonly at?: { readonly network: Network; readonly host: string; readonly ports?: PortNumbers; readonly data?: ControllerData };
  readonly deadMan?: boolean;
  readonly heartbeat_s?: number;
}

/** What a person does before a virtual cabinet. */
export type CabinetAct =
  | { readonly do: "mode"; readonly mode: OperatingMode }
  | { readonly do: "jog"; readonly q_rad: readonly number[] }
  | { readonly do: "emergency-stop"; readonly pressed: boolean }
  | { readonly do: "guard"; readonly open: boolean }
  | { readonly do: "protective-stop"; readonly because: string }
  | { readonly do: "input"; readonly signal: string; readonly value: boolean | number }
  | { readonly do: "reboot" };

/** A station of a brand, and what a person can do at its cabinet where that is virtual. */
export interface BrandStation extends Station {
  /** What is said of it. */
  readonly words: { readonly id: string; readonly name: string; readonly brand: string; readonly robot: string; readonly virtual: boolean; readonly watchdog: string };
  /** null where a person stands before a real one. */
  readonly pendant: ((act: CabinetAct) => Promise<CommandOutcome>) | null;
  /** Pulls the plug of the wire to a virtual controller, or puts it back. */
  readonly plug: ((pulled: boolean) => void) | null;
  /** Runs a program from that seat, compared with its plan all the way; as text where wanted and taken. */
  run(seat: Seat, program: Program, asText: boolean): Promise<CommandOutcome>;
  stop(emergency: boolean): void;
}
export type OpenedBrand = { readonly kind: "opened"; readonly station: BrandStation } | { readonly kind: "refused"; readonly why: Refusal };

/** Opens a station of that brand. It is not connected yet. */
export async function openStation(options: OpenOptions): Promise<OpenedBrand> {
  const { brand, robot, scheduler, dialect, worldFromBase } = options;
  if (robot.vendor !== brand.vendor) {
    return { kind: "refused", why: { code: "station.other-brand", sentence: `${robot.name} is a robot of ${robot.vendor}; controllers of ${brand.name} drive those of ${brand.vendor}.`, hint: "Choose a robot of that brand." } };
  }
  const near = options.at === undefined ? memoryNetwork(scheduler) : null, network = options.at?.network ?? near!, host = options.at?.host ?? "127.0.0.1";
  let virtual: BrandVirtual | null = null;
  if (near) {
    const started = await brand.virtual({ robot, scheduler, network, host, interpret: text => dialect.interpret(text, robot, worldFromBase) });
    if (started.kind === "taken") { near.close(); return { kind: "refused", why: { code: "station.taken", sentence: started.sentence, hint: "Try it again." } }; }
    virtual = started.virtual;
  }
  const ports = options.at?.ports ?? virtual?.ports, name = options.name ?? `${near ? "Virtual " : ""}${robot.name}`;
  const face = brand.face({ robot, scheduler, network, host, ...(ports ? { ports } : {}), ...(options.at?.data ? { data: options.at.data } : {}) });
  const controller = createRealController({ face, scheduler, name, ...(worldFromBase ? { worldFromBase } : {}) });
  const station = createStation({
    controller, scheduler, name, silence_s: face.stale_s,
    ...(worldFromBase ? { worldFromBase } : {}), ...(virtual ? { brakingTime_s: virtual.brakingTime_s } : {}),
    ...(options.heartbeat_s === undefined ? {} : { heartbeat_s: options.heartbeat_s }),
    deadMan: options.deadMan ?? near === null,
  });
  return {
    kind: "opened",
    station: {
      ...station,
      words: {
        id: options.id, name, brand: brand.id, robot: robot.id, virtual: virtual !== null,
        watchdog: face.watchdog.kind === "robot" ? `The robot stops by itself within ${Math.round(face.watchdog.within_s * 1000)} ms.` : `The robot does not stop by itself: ${face.watchdog.because}`,
      },
      pendant: virtual && (act => atCabinet(virtual, act)),
      plug: near && (pulled => { near.weather.frozen = pulled; }),
      stop(emergency) { station.guard.stop(emergency); },
      run(seat, program, asText) {
        const answer = planProgram(program, robot, { start_rad: controller.jointAngles(), ...(worldFromBase ? { worldFromBase } : {}) });
        return station.carryOut(seat, {
          program, steps: () => atTerminals(program, brand, controller.signals),
          ...(asText ? { dialect } : {}), ...(answer.kind === "planned" ? { plan: answer.plan } : {}),
        });
      },
      close() {
        station.close();
        virtual?.close();
        near?.close();
      },
    },
  };
}

/** The steps of a program as the wire takes them: lines with a number by the controller's own names for those, decisions too. */
function* atTerminals(program: Program, brand: Brand, signals?: Signals): Generator<Step> {
  const terminal = (name: string): string => {
    const line = program.signals[name];
    return (line?.address === undefined ? undefined : brand.terminal?.({ ...line, address: line.address })) ?? name;
  };
  const read = signals && { read: (name: string) => signals.read(terminal(name)), write: (name: string, value: boolean | number) => { signals.write(terminal(name), value); } };
  for (const step of unrolled(program, read)) yield withLines(step, terminal);
}

async function atCabinet({ pendant, reboot }: BrandVirtual, act: CabinetAct): Promise<CommandOutcome> {
  switch (act.do) {
    case "mode": pendant.setMode(act.mode); break;
    case "jog": return pendant.jog(act.q_rad);
    case "emergency-stop": pendant.emergencyStop(act.pressed); break;
    case "guard": pendant.setGuardOpen(act.open); break;
    case "protective-stop": pendant.protectiveStop(act.because); break;
    case "input": pendant.setInput(act.signal, act.value); break;
    case "reboot": reboot(); break;
  }
  return { kind: "done" };
}
