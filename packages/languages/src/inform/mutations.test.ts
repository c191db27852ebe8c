import { pose, robotById } from "@twincell/core";
import { inform, informExamplePulses } from "../index.ts";
import { describeMutations, type DialectBench } from "../testing/describe-dialect.ts";

const bench: DialectBench = {
  robot: robotById("yaskawa_gp8")!,
  worldFromBase: pose([0.3, -0.2, 0.75], [0, 0, Math.sin(0.4), Math.cos(0.4)]),
  paths: ["ptp", "lin", "circ", "spline"],
};

/** Changes the numbers of every position, or of every line with that head. */
const numbers =
  (head: string, change: (list: string[]) => string[]) =>
  (text: string): string =>
    text.replace(
      new RegExp(`^(${head})(-?[0-9][0-9.,-]*)(?=\\r$)`, "gm"),
      (_, start: string, list: string) => start + change(list.split(",")).join(","),
    );
const position = (change: (list: string[]) => string[]) => numbers("C[0-9]{5}=", change);
const at =
  (i: number, change: (value: number) => number) =>
  (list: string[]): string[] =>
    list.with(i, String(change(Number(list[i]!))));
const swapped =
  (i: number, j: number) =>
  (list: string[]): string[] =>
    list.with(i, list[j]!).with(j, list[i]!);
const flag = (i: number) =>
  numbers(
    "///RCONF ",
    at(i, value => 1 - value),
  );

const COMMON: Readonly<Record<string, (text: string) => string>> = {
  "a lost motion": text => text.replace(/MOVJ [^\r]*\r\n/, ""),
  "a joint motion for a straight one": text =>
    text.replace(/MOVL (C[0-9]+) V=[0-9.]+(?: CR=[0-9.]+)?/, "MOVJ $1 VJ=10.00"),
  "a straight motion for a curve": text => text.replace(/MOVS (C[0-9]+ V=[0-9.]+ PL=[1-9])/g, "MOVL $1"),
  "an arc without its beginning": text => text.replace(/MOVC C[0-9]+ V=[0-9.]+ PL=0\r\n/, ""),
  "the points of an arc in the wrong order": text =>
    text.replace(/MOVC (C[0-9]+) (V=[0-9.]+)\r\nMOVC (C[0-9]+) /, "MOVC $3 $2\r\nMOVC $1 "),
  "a speed in metres per second": text =>
    text.replace(/MOVL (C[0-9]+) V=([0-9.]+)/, (_, c: string, v: string) => `MOVL ${c} V=${Number(v) / 1000}`),
  "a share in place of percent": text => text.replace(/VJ=([0-9.]+)/, (_, v: string) => `VJ=${Number(v) / 100}`),
  "a lost stop": text => text.replace(/(MOV[JL] C[0-9]+ [^ ]+ )PL=0(?=\r\n(?:'[^\r]*\r\n)*MOV[JL])/, "$1PL=1"),
  "a corner for all": text => text.replaceAll("PL=0", "PL=3"),
  "open for close": text => text.replace(/HAND 1 (ON|OFF)/, (_, v: string) => `HAND 1 ${v === "ON" ? "OFF" : "ON"}`),
  "a wait in milliseconds": text =>
    text.replace(/TIMER T=([0-9.]+)/, (_, s: string) => `TIMER T=${Number(s) * 1000 + 1}`),
  "a lost wait": text => text.replace(/TIMER[^\r]*\r\n/, ""),
  "a lost tool": text => text.replace(/\/\/\/TOOL [1-9]\r\n/, ""),
  "a tool with the wrong sign": text =>
    text.replace(/(\/\/TOOL 1\r\n[^\r]*\r\n)([0-9.-]+)/, (_, head: string, x: string) => head + String(-Number(x))),
  "two turns of a tool in the wrong order": text =>
    text.replace(/(\/\/TOOL [0-9]+\r\n[^\r]*\r\n[^,]*,[^,]*,[^,]*),([^,]*),([^,]*),([^\r]*)/g, "$1,$4,$3,$2"),
};

describeMutations(inform, bench, {
  ...COMMON,
  "x and y in the wrong order": position(swapped(0, 1)),
  "Rx and Rz in the wrong order": position(swapped(3, 5)),
  "Ry with the wrong sign": position(at(4, value => -value)),
  "metres for millimetres": position(at(0, value => value / 1000)),
  "heights from the foot instead of axis L": position(at(2, value => value + 330)),
  "two hundredths of a millimetre too much": position(at(2, value => value + 0.02)),
  "two thousandths of a degree too much": position(at(3, value => value + 0.002)),
  "flip for no flip": flag(0),
  "lower for upper arm": flag(1),
  "rear for front": flag(2),
  "a user frame with the wrong sign": text =>
    text.replace(/(BUSER )([0-9.-]+)/g, (_, head: string, x: string) => head + String(-Number(x) - 1)),
  "user frames mixed up": text => text.replace(/\/\/\/USER ([12])/g, (_, n: string) => `///USER ${3 - Number(n)}`),
  "a position of a user frame in base": text => text.replace(/POSTYPE USER/, "POSTYPE BASE"),
});

describeMutations(informExamplePulses, bench, {
  ...COMMON,
  "an axis with the wrong sign": position(at(2, value => -value)),
  "two axes in the wrong order": position(swapped(3, 4)),
  "the ratio of another axis": position(at(5, value => Math.round((value * 1000) / 620))),
  "degrees for pulses": position(list => list.map(value => String(Math.round(Number(value) / 1000)))),
  "a hundredth of a degree too much": position(at(0, value => value + 14)),
});
