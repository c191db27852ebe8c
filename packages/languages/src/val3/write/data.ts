import { toVal3, type Pose } from "@twincell/core";
import { Names, fixed } from "../../emitter/index.ts";

/** A tenth of a micrometre, a hundred-thousandth of a degree. */
const MM = 4;
const DEG = 5;
/** Names that every version of the controller takes. */
const NAME_LENGTH = 15;
export const RESERVED: ReadonlySet<string> = new Set([
  "begin",
  "end",
  "if",
  "else",
  "elseif",
  "endif",
  "while",
  "endwhile",
  "for",
  "to",
  "step",
  "endfor",
  "do",
  "until",
  "switch",
  "case",
  "default",
  "break",
  "endswitch",
  "call",
  "return",
  "and",
  "or",
  "xor",
  "not",
  "true",
  "false",
  "start",
  "stop",
  "world",
  "flange",
  "gripper",
  "num",
  "bool",
  "string",
  "dio",
  "aio",
  "sio",
  "frame",
  "tool",
  "point",
  "joint",
  "trsf",
  "mdesc",
  "config",
  "pi",
  "x",
  "y",
  "z",
  "rx",
  "ry",
  "rz",
  "open",
  "close",
  "delay",
  "wait",
  "watch",
  "here",
  "appro",
  "compose",
  "movej",
  "movel",
  "movec",
  "abs",
  "sqrt",
  "sin",
  "cos",
  "tan",
  "min",
  "max",
  "size",
  "put",
  "putln",
  "cls",
]);

export const attributes = (pairs: readonly (readonly [string, string])[]): string =>
  pairs.map(([name, value]) => ` ${name}="${value}"`).join("");
const NAMES = ["x", "y", "z", "rx", "ry", "rz"] as const;

/** x, y, z [mm], rx, ry, rz [deg], R = Rx(rx)·Ry(ry)·Rz(rz). */
export function sixOf({ position, quaternion }: Pose): readonly string[] {
  return [
    ...position.map(v => fixed(v * 1000, MM)),
    ...toVal3(quaternion).map(angle => {
      const text = fixed(angle, DEG);
      return text === "-180" ? "180" : text;
    }),
  ];
}
export const trsfAttributes = (pose: Pose): string => attributes(sixOf(pose).map((text, i) => [NAMES[i]!, text]));
/** Axis values [°] as the controller shows them. */
export const jointAttributes = (axes_deg: readonly number[]): string =>
  attributes(axes_deg.map((value, i): [string, string] => [`j${i + 1}`, fixed(value, DEG)]));

interface DataDeclaration {
  readonly name: string;
  readonly type: string;
  readonly value: string;
  readonly step: string;
}

/** The data of an application, in the order in which the program first needs them. */
export class DataList {
  readonly names = new Names({ most: NAME_LENGTH, reserved: RESERVED, first: "n_", foldsCase: true });
  private readonly data = new Map<string, DataDeclaration>();

  add(name: string, type: string, value: string, step: string): string {
    if (!this.data.has(name)) this.data.set(name, { name, type, value, step });
    return name;
  }
  get all(): readonly DataDeclaration[] {
    return [...this.data.values()];
  }
}
