import { pose, robotById } from "@twincell/core";
import { describeMutations, type DialectBench } from "../testing/describe-dialect.ts";
import { fanucLs } from "./index.ts";

const bench: DialectBench = {
  robot: robotById("fanuc_lrmate200id")!,
  worldFromBase: pose([0.3, -0.2, 0.75], [0, 0, Math.sin(0.4), Math.cos(0.4)]),
  paths: ["ptp", "lin", "circ"],
};

/** Changes a number of every position, by its name. */
const field =
  (name: string, change: (value: number) => number) =>
  (text: string): string =>
    text.replace(
      new RegExp(`(\\t${name} ?= +)(-?[0-9.]+)`, "g"),
      (_, head: string, value: string) => head + change(Number(value)).toFixed(3),
    );
const fields =
  (names: readonly string[], change: (value: number) => number) =>
  (text: string): string =>
    names.reduce((all, name) => field(name, change)(all), text);
const exchanged =
  (a: string, b: string) =>
  (text: string): string =>
    text
      .replace(new RegExp(`\\t${a} =`, "g"), "\t? =")
      .replace(new RegExp(`\\t${b} =`, "g"), `\t${a} =`)
      .replaceAll("\t? =", `\t${b} =`);
const config =
  (change: (flags: string) => string) =>
  (text: string): string =>
    text.replace(/(CONFIG : ')([^']*)/g, (_, head: string, flags: string) => head + change(flags));
const register =
  (first: number, last: number, element: number, change: (value: number) => number) =>
  (text: string): string =>
    text.replace(
      new RegExp(`(PR\\[([0-9]+),${element}\\]=)\\(?(-?[0-9.]+)\\)?`, "g"),
      (whole, head: string, n: string, value: string) =>
        Number(n) >= first && Number(n) <= last ? `${head}(${change(Number(value))})` : whole,
    );
const negated = (value: number): number => -value;
const once =
  (pattern: RegExp, by: string) =>
  (text: string): string =>
    text.replace(pattern, by);

describeMutations(fanucLs, bench, {
  "J1 with the wrong sign": field("J1", negated),
  "J3 against the upper arm": text =>
    text.replace(
      /(J2 = +)(-?[0-9.]+)( deg,\tJ3 = +)(-?[0-9.]+)/g,
      (_, a: string, j2: string, b: string, j3: string) => `${a}${j2}${b}${(Number(j3) + Number(j2)).toFixed(3)}`,
    ),
  "J3 with the coupling twice": text =>
    text.replace(
      /(J2 = +)(-?[0-9.]+)( deg,\tJ3 = +)(-?[0-9.]+)/g,
      (_, a: string, j2: string, b: string, j3: string) => `${a}${j2}${b}${(Number(j3) - Number(j2)).toFixed(3)}`,
    ),
  "J4 with the wrong sign": field("J4", negated),
  "J6 with the wrong sign": field("J6", negated),
  "J4 and J5 in the wrong order": exchanged("J4", "J5"),
  "radians for degrees": fields(["J1", "J2", "J3", "J4", "J5", "J6"], value => (value / 180) * Math.PI),
  "a hundredth of a degree too much": field("J2", value => value + 0.01),
  "metres for millimetres": field("X", value => value / 1000),
  "heights from the floor": field("Z", value => value + 330),
  "X and Y in the wrong order": exchanged("X", "Y"),
  "W and R in the wrong order": exchanged("W", "R"),
  "P with the wrong sign": field("P", negated),
  "R with the wrong sign": field("R", negated),
  "a tenth of a millimetre too much": field("Y", value => value + 0.1),
  "a wrist turned over": config(flags => flags.replace(/^[FN]/, flag => (flag === "F" ? "N" : "F"))),
  "an elbow turned over": config(flags => flags.replace(/[UD]/, flag => (flag === "U" ? "D" : "U"))),
  "a shoulder turned over": config(flags => flags.replace(/[TB]/, flag => (flag === "T" ? "B" : "T"))),
  "no configuration": text => text.replace(/CONFIG : '[^']*',/g, ""),
  "a tool with the wrong sign": register(1, 10, 1, negated),
  "a tool in metres": register(1, 10, 3, value => value / 1000),
  "a tool turned the wrong way": register(1, 10, 6, negated),
  "a frame with the wrong sign": register(11, 19, 2, negated),
  "a frame from the floor": register(11, 19, 3, value => value + 330),
  "a frame turned the wrong way": register(11, 19, 6, negated),
  "another tool": text => text.replace(/UTOOL_NUM=([0-9])/, (_, n: string) => `UTOOL_NUM=${n === "1" ? 2 : 1}`),
  "another frame in the position": text => text.replace(/UF : 1,/g, "UF : 2,"),
  "another tool in the position": text => text.replace(/UT : 1,/g, "UT : 2,"),
  "a lost tool": once(/ +[0-9]+: {2}UTOOL\[[0-9]\]=PR\[[0-9]+:(?:torch|long)[^\r]*\r\n/, ""),
  "a lost frame": once(/ +[0-9]+: {2}UFRAME\[1\]=[^\r]*\r\n/, ""),
  "a joint motion for a straight one": once(/:L (P\[[0-9]+\]) [0-9]+mm\/sec/, ":J $1 50%"),
  "a straight motion for a joint one": once(/:J (P\[[0-9]+\]) [0-9]+%/, ":L $1 100mm/sec"),
  "a straight motion for an arc": once(/:C P\[[0-9]+\][^\r]*\r\n {4}: {2}/, ":L "),
  "the points of an arc in the wrong order": once(/:C (P\[[0-9]+\])([^\r]*\r\n {4}: {2})(P\[[0-9]+\])/, ":C $3$2$1"),
  "a lost motion": once(/ +[0-9]+:[JL] P[^\r]*\r\n/, ""),
  "a motion twice": once(/( +[0-9]+:[JL] P[^\r]*\r\n)/, "$1$1"),
  "another position": once(/(:[JL] P\[)([0-9]+)/, "$199"),
  "a lost stop": text =>
    text
      .replace(/FINE(?= {4};\r\n +[0-9]+: {2}WAIT)/g, "CNT100")
      .replace(/:([JL]) (P\[[0-9]+\] [^ ]+) FINE/g, ":$1 $2 CNT100"),
  "a speed in centimetres a minute": once(/mm\/sec/, "cm/min"),
  "a speed of its own": once(/ ([0-9]+)mm\/sec/, " 7mm/sec"),
  "per mille for per cent": text =>
    text.replace(
      /(:J P\[[0-9]+\]) ([0-9]+)%/,
      (_, head: string, percent: string) =>
        `${head} ${Math.max(1, Math.round(Number(percent) / 10)) === Number(percent) ? 50 : Math.max(1, Math.round(Number(percent) / 10))}%`,
    ),
  "half the acceleration": once(/(:J P\[[0-9]+\] [^ ]+ [A-Z0-9]+)( {4};)/, "$1 ACC50$2"),
  "an offset that is not there": once(/(:L P\[[0-9]+\] [^ ]+ [A-Z0-9]+)( {4};)/, "$1 Offset,PR[90]$2"),
  "open for close": text =>
    text.replace(/RO\[1\]=(ON|OFF)/, (_, state: string) => `RO[1]=${state === "ON" ? "OFF" : "ON"}`),
  "another output": once(/RO\[1\]=/, "RO[2]="),
  "a wait in milliseconds": text =>
    text.replace(/WAIT +([0-9.]+)\(sec\)/, (_, s: string) => `WAIT ${Number(s) * 1000 + 1}(sec)`),
  "a lost wait": once(/ +[0-9]+: {2}WAIT[^\r]*\r\n/, ""),
  "a program that ends too early": text =>
    text.replace(/( +[0-9]+:[JL] P[^\r]*\r\n)(?=[^]*:[JL] P)/, "$1      END ;\r\n"),
});
