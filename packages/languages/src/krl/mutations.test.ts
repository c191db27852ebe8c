import { pose, robotById } from "@twincell/core";
import { krl } from "../index.ts";
import { describeMutations, type DialectBench } from "../testing/describe-dialect.ts";

const bench: DialectBench = {
  robot: robotById("kuka_kr6_2")!,
  worldFromBase: pose([0.3, -0.2, 0.75], [0, 0, Math.sin(0.4), Math.cos(0.4)]),
  paths: ["ptp", "lin", "circ", "spline"],
};

/** Changes the components of every declaration of that type, `[name, value]` each. */
const declared =
  (head: string, change: (parts: [string, string][]) => [string, string][]) =>
  (text: string): string =>
    text.replace(
      new RegExp(`(DECL ${head}[A-Z0-9_]*=\\{)([^}]*)\\}`, "g"),
      (_, start: string, inside: string) =>
        `${start}${change(inside.split(",").map(part => part.split(" ") as [string, string]))
          .map(part => part.join(" "))
          .join(",")}}`,
    );
const of =
  (name: string, change: (value: string) => string) =>
  (parts: [string, string][]): [string, string][] =>
    parts.map(([key, value]) => [key, key === name ? change(value) : value]);
const swapped =
  (a: string, b: string) =>
  (parts: [string, string][]): [string, string][] => {
    const values = new Map(parts);
    return parts.map(([key, value]) => [key, key === a ? values.get(b)! : key === b ? values.get(a)! : value]);
  };
const negated = (text: string): string => (text.startsWith("-") ? text.slice(1) : `-${text}`);
const plus =
  (more: number) =>
  (text: string): string =>
    String(Number(text) + more);
const bit =
  (n: number) =>
  (text: string): string =>
    String(Number(text) ^ n);
const AXIS = "E6AXIS X";
const POS = "E6POS X";

describeMutations(krl, bench, {
  "A1 with the wrong sign": declared(AXIS, of("A1", negated)),
  "A4 with the wrong sign": declared(AXIS, of("A4", negated)),
  "A6 with the wrong sign": declared(AXIS, of("A6", negated)),
  "A2 counted from upright": declared(AXIS, of("A2", plus(90))),
  "two axes in the wrong order": declared(AXIS, swapped("A4", "A5")),
  "radians for degrees": declared(AXIS, parts =>
    parts.map(([key, value]) => [key, String((Number(value) / 180) * Math.PI)]),
  ),
  "a hundredth of a degree too much": declared(AXIS, of("A3", plus(0.01))),
  "metres for millimetres": declared(
    POS,
    of("X", value => String(Number(value) / 1000)),
  ),
  "x and y in the wrong order": declared(POS, swapped("X", "Y")),
  "A and C in the wrong order": declared(POS, swapped("A", "C")),
  "B with the wrong sign": declared(POS, of("B", negated)),
  "two hundredths of a millimetre too much": declared(POS, of("Z", plus(0.02))),
  "the shoulder bit of Status": declared(POS, of("S", bit(1))),
  "the elbow bit of Status": declared(POS, of("S", bit(2))),
  "the wrist bit of Status": declared(POS, of("S", bit(4))),
  "the sign of A4 in Turn": declared(POS, of("T", bit(8))),
  "the sign of A6 in Turn": declared(POS, of("T", bit(32))),
  "no Status and no Turn": text => text.replace(/,S [0-7](?:,T [0-9]+)?\}/g, "}"),
  "a tool with the wrong sign": declared("FRAME TOOL_", of("X", negated)),
  "a tool with two turns in the wrong order": declared("FRAME TOOL_", swapped("B", "C")),
  "a base with the wrong sign": declared("FRAME BASE_", of("Y", negated)),
  "a base from the floor": declared("FRAME BASE_", of("Z", plus(750))),
  "a lost tool": text => text.replace(/ {2}\$TOOL=TOOL_[^\r]*\r\n/, ""),
  "a lost base": text => text.replace(/ {2}\$BASE=BASE_[^\r]*\r\n/, ""),
  "a tool that is never taken off": text => text.replace(/ {2}\$TOOL=\$NULLFRAME\r\n/, ""),
  "a joint motion for a straight one": text => text.replace(/ LIN (?=X)/, " PTP "),
  "a straight motion for a joint one": text => text.replace(/ PTP (?=X\w+(?: C_DIS)?\r\n)(?=[^]*DECL E6POS)/, " LIN "),
  "a straight motion for an arc": text => text.replace(/CIRC X\w+,/, "LIN "),
  "the points of an arc in the wrong order": text => text.replace(/CIRC (X\w+),(X\w+)/, "CIRC $2,$1"),
  "a point on the way that is elsewhere": text =>
    text.replace(/(DECL E6POS X\w*_VIA=\{X )([^,]*)/g, (_, head: string, x: string) => head + String(Number(x) + 5)),
  "a lost motion": text => text.replace(/ {2}PTP X[^\r]*\r\n/, ""),
  "a motion twice": text => text.replace(/( {2}LIN X[^\r]*\r\n)/, "$1$1"),
  "a lost stop": text =>
    text.replace(/( {2}(?:PTP|LIN) X\w+)(\r\n(?: {2}(?:\$|;|BAS)[^\r]*\r\n)* {2}(?:PTP|LIN|CIRC) X)/, "$1 C_DIS$2"),
  "a speed in millimetres per second": text =>
    text.replace(/\$VEL\.CP=([0-9.]+)/, (_, v: string) => `$VEL.CP=${Number(v) * 1000}`),
  "a lost speed": text => text.replace(/ {2}\$VEL\.CP=[^\r]*\r\n/, ""),
  "a share of the axis speed that is ten times too small": text =>
    text.replace(
      /BAS\(#VEL_PTP,([0-9]+)\)/g,
      (_, v: string) => `BAS(#VEL_PTP,${Math.max(1, Math.round(Number(v) / 10))})`,
    ),
  "speed and acceleration of the axes mixed up": text => text.replace(/#VEL_PTP/g, "#ACC_PTP"),
  "open for close": text =>
    text.replace(/GRIPPER=(TRUE|FALSE)/, (_, v: string) => `GRIPPER=${v === "TRUE" ? "FALSE" : "TRUE"}`),
  "a wait in milliseconds": text =>
    text.replace(/WAIT SEC ([0-9.]+)/, (_, s: string) => `WAIT SEC ${Number(s) * 1000 + 1}`),
  "a lost wait": text => text.replace(/ {2}WAIT SEC[^\r]*\r\n/, ""),
  "a lost data list": text => text.slice(0, text.indexOf("DEFDAT")),
});
