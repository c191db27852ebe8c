import { pose, robotById } from "@twincell/core";
import { kawasakiAs } from "./index.ts";
import { linesOf } from "../testing/lines.ts";
import { describeStructure } from "../testing/describe-structure.ts";
import { describeDialect, describeMutations, type DialectBench } from "../testing/describe-dialect.ts";

const bench: DialectBench = {
  robot: robotById("kawasaki_rs007l")!,
  worldFromBase: pose([0.3, -0.2, 0.75], [0, 0, Math.sin(0.4), Math.cos(0.4)]),
  paths: ["ptp", "lin", "circ"],
  structured: true,
  signals: linesOf("kawasaki-as"),
};

describeDialect(kawasakiAs, bench);
describeStructure(kawasakiAs, bench);

/** Changes the numbers of the first location that matches. */
const numbers =
  (head: RegExp, change: (list: string[]) => string[]) =>
  (text: string): string =>
    text.replace(
      head,
      (_, before: string, list: string, end: string) => `${before}${change(list.split(",")).join(",")}${end}`,
    );
const joints = (change: (list: string[]) => string[]): ((text: string) => string) =>
  numbers(/(JMOVE #\[)([^\]]*)(\])/, change);
const place = (change: (list: string[]) => string[]): ((text: string) => string) =>
  numbers(/([JL]MOVE (?:\w+\+)?TRANS\()([^)]*)(\))/, change);
const negated = (text: string): string => (text.startsWith("-") ? text.slice(1) : `-${text}`);
const plus =
  (i: number, by: number) =>
  (list: string[]): string[] =>
    list.with(i, String(Number(list[i]) + by));
const swapped =
  (i: number, j: number) =>
  (list: string[]): string[] =>
    list.with(i, list[j]!).with(j, list[i]!);
const other =
  (a: string, b: string) =>
  (text: string): string =>
    text.replace(new RegExp(`^ *(?:${a}|${b})\\r$`, "m"), word =>
      word.includes(a) ? word.replace(a, b) : word.replace(b, a),
    );

describeMutations(kawasakiAs, bench, {
  "a joint with the wrong sign": joints(list => list.with(1, negated(list[1]!))),
  "two joints in the wrong order": joints(swapped(3, 4)),
  "radians for degrees": joints(list => list.map(x => String((Number(x) / 180) * Math.PI))),
  "a joint turned by a hundredth of a degree": joints(plus(0, 0.01)),
  "a whole turn too much": joints(plus(5, 360)),
  "metres for millimetres": place(list => list.map((x, i) => (i < 3 ? String(Number(x) / 1000) : x))),
  "x and y in the wrong order": place(swapped(0, 1)),
  "O and T in the wrong order": place(swapped(3, 5)),
  "T with the wrong sign": place(list => list.with(5, negated(list[5]!))),
  "A with the wrong sign": place(list => list.with(4, negated(list[4]!))),
  "yaw, pitch and roll for O, A and T": place(list => [...list.slice(0, 3), list[5]!, list[4]!, list[3]!]),
  "heights from the shoulder instead of the floor": place(plus(2, -360)),
  "two hundredths of a millimetre too much": place(plus(0, 0.02)),
  "a joint motion for a straight one": text => text.replace("LMOVE TRANS", "JMOVE TRANS"),
  "the middle of an arc and its end in the wrong order": text =>
    text.replace(/C1MOVE ([^\r]*)\r\n *C2MOVE ([^\r]*)/, "C1MOVE $2\r\n  C2MOVE $1"),
  "a lost stop": text =>
    text.replace(/ {2}BREAK\r\n(?=(?: {2}(?!TWAIT|OPENI|CLOSEI|TOOL)[^\r]*\r\n)*? {2}[JLC]1?MOVE)/, ""),
  "a lost tool": text => text.replace(/ {2}TOOL (?!NULL)[^\r]*\r\n/, ""),
  "a tool with the wrong sign": text =>
    text.replace(/(POINT torch = TRANS\()([^,]*)/, (_, head: string, x: string) => head + negated(x)),
  "a frame with the wrong sign": text =>
    text.replace(/(POINT carton = TRANS\()([^,]*)/, (_, head: string, x: string) => head + negated(x)),
  "a place that does not count from its frame": text => text.replace(/MOVE \w+\+TRANS/, "MOVE TRANS"),
  "a lost motion": text => text.replace(/ {2}[JL]MOVE[^\r]*\r\n/, ""),
  "open for close": text => text.replace(/OPENI|CLOSEI/, word => (word === "OPENI" ? "CLOSEI" : "OPENI")),
  "a wait in milliseconds": text => text.replace(/TWAIT ([0-9.]+)/, (_, s: string) => `TWAIT ${Number(s) * 1000}`),
  "a speed in metres per second": text =>
    text.replace(/SPEED ([0-9.]+) MM/, (_, v: string) => `SPEED ${Number(v) / 1000} MM`),
  "a percentage for millimetres per second": text => text.replace(" MM/S", ""),
  "a minute for a second": text => text.replace("MM/S", "MM/MIN"),
  "the wrong arm": other("LEFTY", "RIGHTY"),
  "the wrong elbow": other("ABOVE", "BELOW"),
  "the wrong wrist": other("UWRIST", "DWRIST"),
});
