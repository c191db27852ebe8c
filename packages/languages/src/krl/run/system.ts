import type { TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import type { Variable } from "../read/syntax.ts";
import { NULL_FRAME, type Frame } from "./frames.ts";
import { bool, component, fromFrame, real, toFrame, whole, type Structure, type Value } from "./values.ts";

/** $VEL_AXIS has twelve places: six of the robot, six of external axes. */
const PLACES = 12;
const AXES = 6;
/** What $config.dat holds on delivery; a real cell may have other numbers. */
const DELIVERED_VEL_CP = 2;
const DELIVERED_ACC_CP = 2.3;
const DELIVERED_APO_MM = 100;

const structure = (type: string, fields: Readonly<Record<string, number>>): Structure => ({
  kind: "structure",
  type,
  fields: new Map(Object.entries(fields).map(([name, value]) => [name, real(value)])),
});

function homeFields(): ReadonlyMap<string, Value> {
  return new Map<string, Value>([
    ["TOOL_NO", whole(0)],
    ["BASE_NO", whole(0)],
    ["IPO_FRAME", { kind: "enum", value: "#BASE" }],
  ]);
}

/** Variables that a program expects to find on the controller. */
const DELIVERED: Readonly<Record<string, Value>> = {
  XHOME: structure("E6AXIS", { A1: 0, A2: -90, A3: 90, A4: 0, A5: 0, A6: 0 }),
  $NULLFRAME: fromFrame(NULL_FRAME),
  DEF_VEL_PTP: whole(100),
  DEF_ACC_PTP: whole(100),
  DEF_VEL_CP: real(DELIVERED_VEL_CP),
  DEF_ACC_CP: real(DELIVERED_ACC_CP),
  PDEFAULT: structure("PDAT", { VEL: 100, ACC: 100, APO_DIST: 100 }),
  LDEFAULT: structure("LDAT", { VEL: DELIVERED_VEL_CP, ACC: 100, APO_DIST: 100 }),
  FHOME: { ...structure("FDAT", { TOOL_NO: 0, BASE_NO: 0 }), fields: homeFields() },
  // The state of a controller that runs a program by itself and that nothing stands in the way of.
  $MODE_OP: { kind: "enum", value: "#AUT" },
  $T1: bool(false),
  $T2: bool(false),
  $AUT: bool(true),
  $EXT: bool(false),
  $ON_PATH: bool(true),
  $IN_HOME: bool(true),
  $NEAR_POSRET: bool(true),
  $PRO_ACT: bool(true),
  $PRO_MOVE: bool(false),
  $ROB_STOPPED: bool(true),
  $ROB_CAL: bool(true),
  $STOPMESS: bool(false),
  $ALARM_STOP: bool(true),
  $USER_SAF: bool(true),
  $PERI_RDY: bool(true),
  $DRIVES_ON: bool(true),
  $MOVE_ENABLE: bool(true),
  $I_O_ACT: bool(true),
  $PAL_MODE: bool(false),
  $PRO_STATE: { kind: "enum", value: "#P_ACTIVE" },
  $PRO_STATE0: { kind: "enum", value: "#P_ACTIVE" },
  $PRO_STATE1: { kind: "enum", value: "#P_ACTIVE" },
  $BRAKETEST_REQ_INT: bool(false),
  $BRAKETEST_REQ_EX: bool(false),
  $PRO_MODE: { kind: "enum", value: "#GO" },
  $ADVANCE: whole(3),
  $OV_PRO: whole(100),
  $OV_ROB: whole(100),
  // Packages for welding that a controller has or has not.
  ARC10: bool(false),
  ARC20: bool(false),
  ARC50: bool(false),
  A10_OPTION: { kind: "enum", value: "#DISABLED" },
  A20_OPTION: { kind: "enum", value: "#DISABLED" },
  A50_OPTION: { kind: "enum", value: "#DISABLED" },
  $ERR: structure("ERROR_T", { NUMBER: 0 }),
  $WORLD: fromFrame(NULL_FRAME),
  $ROBROOT: fromFrame(NULL_FRAME),
};
/** Flags and timers by number: off, and at nought, until the program sets them. */
const NUMBERED: Readonly<Record<string, Value>> = {
  $FLAG: bool(false),
  $CYCFLAG: bool(false),
  $TIMER_FLAG: bool(false),
  $TIMER_STOP: bool(true),
  $TIMER: whole(0),
};
const PLACE_OF = /^(\$\w+)\[\d+\]$/;
/** What changes where the robot goes and cannot be carried out here: refused where it is set, never passed over. */
const REFUSED: Readonly<Record<string, Readonly<Record<string, string>>>> = {
  $IPO_MODE: {
    "#TCP": "With #TCP the tool stands in the cell and the robot carries the part, which is not understood here.",
  },
  $ORI_TYPE: {
    "#CONSTANT": "With #CONSTANT the orientation of the target is not taken, which is not understood here.",
    "#CONST": "With #CONST the orientation of the target is not taken, which is not understood here.",
  },
};
const TABLE = /^(?:TOOL|BASE)_DATA\[([0-9]+)\]$/;

/** A frame that was made current, under the name it was given by. */
export interface Named {
  readonly name: string;
  readonly frame: Frame;
}

/** The system variables that decide how and where the robot moves. */
export class System {
  readonly values = new Map<string, Value>();
  /** Names of what was taken as it is on delivery, with the line that asked for it. */
  readonly assumed = new Map<string, TextPlace>();
  readonly warned: { readonly at: TextPlace; readonly sentence: string }[] = [];
  tool: Named = { name: "", frame: NULL_FRAME };
  base: Named = { name: "", frame: NULL_FRAME };

  constructor() {
    this.initialize();
  }

  /** BAS(#INITMOV,0) */
  initialize(): void {
    for (let i = 1; i <= AXES; i++) {
      this.values.set(`$VEL_AXIS[${i}]`, whole(100));
      this.values.set(`$ACC_AXIS[${i}]`, whole(100));
    }
    this.values.set("$VEL", structure("CP", { CP: DELIVERED_VEL_CP }));
    this.values.set("$ACC", structure("CP", { CP: DELIVERED_ACC_CP }));
    this.values.set("$APO", structure("APO", { CDIS: DELIVERED_APO_MM, CPTP: 100 }));
    this.setFrame("$TOOL", fromFrame(NULL_FRAME), "", { line: 1, column: 1 });
    this.setFrame("$BASE", fromFrame(NULL_FRAME), "", { line: 1, column: 1 });
  }

  read(key: string, at: TextPlace): Value | undefined {
    const value = this.values.get(key);
    if (value !== undefined) return value;
    const table = TABLE.exec(key);
    const numbered = NUMBERED[PLACE_OF.exec(key)?.[1] ?? ""];
    const delivered = Object.hasOwn(DELIVERED, key)
      ? DELIVERED[key]
      : table === null
        ? numbered
        : fromFrame(NULL_FRAME);
    if (delivered !== undefined && key !== "$NULLFRAME" && table?.[1] !== "0" && !this.assumed.has(key))
      this.assumed.set(key, at);
    return delivered;
  }

  write(key: string, value: Value, at: TextPlace, source: string): void {
    const axis = /^\$(?:VEL|ACC)_AXIS(?:\[([0-9]+)\])?$/.exec(key);
    if (axis !== null) return this.setAxis(key, Number(axis[1]), value, at);
    if (key === "$TOOL" || key === "$BASE") return this.setFrame(key, value, source, at);
    const sentence = value.kind === "enum" ? REFUSED[key]?.[value.value] : undefined;
    if (sentence !== undefined) throw new TextError(at, `another value of ${key}`, sentence);
    this.values.set(key, value);
  }

  private setAxis(key: string, index: number, value: Value, at: TextPlace): void {
    if (!(index >= 1 && index <= PLACES))
      throw new TextError(at, `an axis from 1 to ${PLACES}`, `${key} is no axis of the controller.`);
    if (value.kind !== "number" || !(value.value >= 0.5 && value.value <= 100))
      throw new TextError(at, "a number from 1 to 100", `${key} takes 1 to 100 percent.`);
    if (index > AXES) this.warned.push({ at, sentence: `${key} is an external axis: the robot has ${AXES} axes.` });
    this.values.set(key, whole(Math.round(value.value)));
  }

  private setFrame(key: "$TOOL" | "$BASE", value: Value, source: string, at: TextPlace): void {
    if (value.kind !== "structure") throw new TextError(at, "a frame", `${key} takes a frame.`);
    const named = { name: source, frame: toFrame(value, undefined, at) };
    this.values.set(key, value);
    if (key === "$TOOL") this.tool = named;
    else this.base = named;
  }

  /** BAS(#TOOL,n) and BAS(#BASE,n): the frame of that number; 0 and -1 are none. */
  choose(which: "TOOL" | "BASE", index: number, at: TextPlace): void {
    const key = `${which}_DATA[${index}]`;
    if (!Number.isInteger(index) || index < -1)
      throw new TextError(at, "a number from 0", `${key} is no place of the table.`);
    const value = index <= 0 ? fromFrame(NULL_FRAME) : this.read(key, at);
    this.setFrame(`$${which}`, value!, index <= 0 ? "" : key, at);
  }

  /** Share of the axis speeds: that of the slowest axis. */
  get velocityRatio(): number {
    return this.least("$VEL_AXIS");
  }
  get accelerationRatio(): number {
    return this.least("$ACC_AXIS");
  }
  get pathSpeed_mps(): number {
    return component(this.part("$VEL"), "CP") ?? DELIVERED_VEL_CP;
  }
  /** Share of the acceleration that the controller's DEF_ACC_CP stands for. */
  get pathAccelerationRatio(): number {
    const full = this.values.get("DEF_ACC_CP");
    const full_mps2 = full?.kind === "number" ? full.value : DELIVERED_ACC_CP;
    return (component(this.part("$ACC"), "CP") ?? full_mps2) / full_mps2;
  }
  get approximation_m(): number {
    return (component(this.part("$APO"), "CDIS") ?? DELIVERED_APO_MM) / 1000;
  }
  get approximationRatio(): number {
    return (component(this.part("$APO"), "CPTP") ?? 100) / 100;
  }

  private least(name: string): number {
    let least = 100;
    for (let i = 1; i <= AXES; i++) {
      const value = this.values.get(`${name}[${i}]`);
      if (value?.kind === "number") least = Math.min(least, value.value);
    }
    return least / 100;
  }

  private part(name: string): Structure {
    const value = this.values.get(name);
    return value?.kind === "structure" ? value : structure("", {});
  }

  setAxes(name: "$VEL_AXIS" | "$ACC_AXIS", percent: number, at: TextPlace): void {
    for (let i = 1; i <= AXES; i++) this.setAxis(`${name}[${i}]`, i, real(percent), at);
  }

  setPart(name: "$VEL" | "$ACC" | "$APO", part: string, value: number): void {
    const now = this.part(name);
    this.values.set(name, { ...now, fields: new Map(now.fields).set(part, real(value)) });
  }
}

/** How a variable is spelled, for the name of a tool or a base: `TOOL_DATA[1]`. */
export const spelling = ({ parts }: Variable): string =>
  parts
    .map(
      ({ name, indices }) =>
        `${name}${indices.map(index => (index.kind === "number" ? `_${index.value}` : "")).join("")}`,
    )
    .join("_");
