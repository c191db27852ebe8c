import { LIBRARY, identity, type Dialect, type EmittedFile, type Resolution, type Robot } from "@twincell/core";
import { skippingDialect } from "../parser/index.ts";
import { CANNOT, IDIOMS, emitInform } from "./emit.ts";
import { interpretInform } from "./interpret.ts";
import { LINES } from "./lines.ts";
import { parseInform } from "./parse.ts";
import { pulsesOf, type PulseData } from "./pulses.ts";

export interface InformOptions {
  /**
   * Takes made-up pulses per degree too, as the vendor section of the GP8 has them: for virtual controllers. Left out,
   * jobs in pulses are understood for robots whose section has those of their own controller.
   */
  readonly examplePulses?: boolean;
  /** How positions are written: in X, Y, Z, or in pulses, which is refused for a robot without them. */
  readonly positions?: "rectan" | "pulse";
}

/** Half a step of VJ=, V= and TIMER, and where V= ends. TIMER is at least 0.01 s. */
const STEPS: Resolution = {
  ratio: 0.5e-4,
  leastRatio: 1e-4,
  leastAcceleration: 0.2,
  mps: 0.5e-4,
  mostMps: 1.5,
  wait_s: 0.01,
  anglesAsPoses: true,
  posesAsAngles: true,
};
/** Longest lever of an axis of the hand that is reckoned with [m]. */
const HAND_M = 0.4;
const DEG = Math.PI / 180;

/** What half a pulse of every axis at once does to the tool at most, over the robots that are known. */
function pulseResolution(): Resolution {
  let angle_rad = 0;
  let position_m = 0;
  for (const { pulsesPerDegree } of LIBRARY.flatMap(robot => pulsesOf(robot, true) ?? [])) {
    const half = pulsesPerDegree.map(value => (0.5 / Math.abs(value)) * DEG);
    const sum = half.reduce((a, b) => a + b, 0);
    angle_rad = Math.max(angle_rad, sum);
    position_m = Math.max(
      position_m,
      half.reduce((total, value, i) => total + value * (i < 3 ? 1 + HAND_M : HAND_M), 0),
    );
  }
  return { ...STEPS, anglesAsPoses: false, angle_rad, position_m };
}

/** INFORM of Yaskawa controllers from the NX100 on. */
export function informDialect({ examplePulses = false, positions = "rectan" }: InformOptions = {}): Dialect {
  const of = (robot: Robot): PulseData | undefined => pulsesOf(robot, examplePulses);
  const inPulses = positions === "pulse";
  return skippingDialect({
    id: inPulses ? "inform-pulse" : "inform",
    brand: "Yaskawa",
    name: inPulses ? "INFORM (pulses)" : "INFORM",
    extensions: [".jbi"],
    // Position levels and TOOL.CND are recalled, not read off a controller.
    maturity: "experimental",
    cannot: inPulses
      ? [
          ...CANNOT,
          {
            what: "pallet",
            because: "The places of a pallet are shifts in X, Y, Z, and positions in pulses are not shifted.",
          },
        ]
      : CANNOT,
    idioms: IDIOMS,
    resolution: inPulses ? pulseResolution() : STEPS,
    runnable: asOne,
    emit(program, robot, worldFromBase = identity()) {
      const data = of(robot);
      if (inPulses && data === undefined) {
        return {
          kind: "cannot",
          step: "",
          sentence: `The pulses per degree of this ${robot.name} are not known.`,
          hint: "Take them from the parameter file (ALL.PRM) of its controller, or export positions in X, Y, Z.",
        };
      }
      return emitInform(inPulses ? data : undefined)(program, robot, worldFromBase);
    },
    parse: (text, robot, worldFromBase = identity()) => parseInform(text, robot, worldFromBase, of(robot)),
    interpret: (text, robot, worldFromBase = identity()) => interpretInform(text, robot, worldFromBase, of(robot)),
    lines: LINES,
  });
}

/** The jobs and what they mean by numbers, one behind the other. */
function asOne(files: readonly EmittedFile[]): EmittedFile {
  return {
    name: files[0]!.name,
    text: files.map(({ text }) => text).join(""),
    lines: files.flatMap(({ lines }) => lines),
  };
}

/** With positions in X, Y, Z: needs nothing of the controller. */
export const inform: Dialect = informDialect();

/** With positions in pulses, for virtual controllers: its numbers are examples. */
export const informExamplePulses: Dialect = informDialect({ examplePulses: true, positions: "pulse" });
