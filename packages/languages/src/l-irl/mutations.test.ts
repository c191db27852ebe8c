import { pose, robotById } from "@twincell/core";
import { poseList } from "../index.ts";
import { describeMutations, type DialectBench } from "../testing/describe-dialect.ts";

const bench: DialectBench = {
  robot: robotById("staubli_rx90l")!,
  worldFromBase: pose([0.3, -0.2, 0.75], [0, 0, Math.sin(0.4), Math.cos(0.4)]),
  paths: ["ptp", "lin", "circ", "spline"],
};

/** Changes the six numbers behind the first such head. */
const six =
  (head: string, change: (numbers: string[]) => string[]) =>
  (text: string): string =>
    text.replace(
      new RegExp(`(${head} )((?:-?[0-9.]+ ){5}-?[0-9.]+)`),
      (_, start: string, numbers: string) => start + change(numbers.split(" ")).join(" "),
    );
const negated = (text: string): string => (text.startsWith("-") ? text.slice(1) : `-${text}`);
const swapped =
  (i: number, j: number) =>
  (list: string[]): string[] =>
    list.with(i, list[j]!).with(j, list[i]!);
const plus =
  (i: number, more: number) =>
  (list: string[]): string[] =>
    list.with(i, String(Number(list[i]) + more));
const POSE = "MOVE (?:LIN|SPLINE|PTP) POSE";
const JOINTS = "MOVE PTP JOINTS";

describeMutations(poseList, bench, {
  "a joint with the wrong sign": six(JOINTS, list => list.with(1, negated(list[1]!))),
  "two joints in the wrong order": six(JOINTS, swapped(3, 4)),
  "radians for degrees": six(JOINTS, list => list.map(x => String((Number(x) / 180) * Math.PI))),
  "a hundredth of a degree too much": six(JOINTS, plus(0, 0.01)),
  "metres for millimetres": six(POSE, list => list.map((x, i) => (i < 3 ? String(Number(x) / 1000) : x))),
  "x and y in the wrong order": six(POSE, swapped(0, 1)),
  "A and C in the wrong order": six(POSE, swapped(3, 5)),
  "B with the wrong sign": six(POSE, list => list.with(4, negated(list[4]!))),
  "two hundredths of a millimetre too much": six(POSE, plus(0, 0.02)),
  "turns in another order": text => text.replace(" ZYX ", " XYZ "),
  "lengths in metres": text => text.replace(" MM DEG ", " M DEG "),
  "angles in radians": text => text.replace(" MM DEG ", " MM RAD "),
  "poses from the world": text => text.replace(" ZYX BASE", " ZYX WORLD"),
  "a tool with the wrong sign": six("TOOL torch", list => list.with(0, negated(list[0]!))),
  "a frame from elsewhere": six("FRAME carton", plus(2, 750)),
  "a lost frame": text => text.replace(/ IN carton/, ""),
  "the other frame": text => text.replace(/ IN carton/, " IN Drehtisch_a"),
  "a lost tool": text => text.replace(/(POSE [^\r]*) TOOL torch/, "$1"),
  "a straight motion for a joint one": text => text.replace("MOVE PTP", "MOVE LIN"),
  "a joint motion for a straight one": text => text.replace("MOVE LIN", "MOVE PTP"),
  "a straight motion for a smooth one": text => text.replace("MOVE SPLINE", "MOVE LIN"),
  "a straight motion for an arc": text => text.replace(/MOVE CIRCLE VIA .*? TO /, "MOVE LIN "),
  "a point on the way that is elsewhere": six("CIRCLE VIA POSE", plus(0, 5)),
  "a lost motion": text => text.replace(/MOVE [^\r]*\r\n/, ""),
  "a motion twice": text => text.replace(/(MOVE LIN [^\r]*\r\n)/, "$1$1"),
  "a blend that nobody asked for": text =>
    text.replace(/^(MOVE LIN [^\r]* SPEED [0-9.]+ (?:%|MMPS))(?= NAME| GROUP|\r)/m, "$1 BLEND 10 MM"),
  "a speed in metres per second": text =>
    text.replace(/SPEED ([0-9.]+) MMPS/, (_, v: string) => `SPEED ${Number(v) / 1000} MMPS`),
  "a share for millimetres per second": text =>
    text.replace(/SPEED ([0-9.]+) MMPS/, (_, v: string) => `SPEED ${Math.min(100, Number(v) / 20)} %`),
  "a share as a fraction": text => text.replace(/SPEED ([0-9.]+) %/, (_, v: string) => `SPEED ${Number(v) / 100} %`),
  "a lost speed": text => text.replace(/ SPEED [0-9.]+ (?:%|MMPS)/, ""),
  "a duration in milliseconds": text => text.replace(/TIME ([0-9.]+)/, (_, s: string) => `TIME ${Number(s) * 1000}`),
  "open for close": text =>
    text.replace(/GRIPPER (CLOSE|OPEN)/, (_, word: string) => `GRIPPER ${word === "OPEN" ? "CLOSE" : "OPEN"}`),
  "a wait in milliseconds": text => text.replace(/WAIT ([0-9.]+)/, (_, s: string) => `WAIT ${Number(s) * 1000 + 1}`),
  "a lost wait": text => text.replace(/WAIT [^\r]*\r\n/, ""),
  "the wrong elbow": text =>
    text.replace(
      /BRANCH (\w+) (UP|DOWN)/g,
      (_, shoulder: string, word: string) => `BRANCH ${shoulder} ${word === "UP" ? "DOWN" : "UP"}`,
    ),
  "the wrong wrist": text =>
    text.replace(/POSITIVE|NEGATIVE/g, word => (word === "POSITIVE" ? "NEGATIVE" : "POSITIVE")),
  "the wrong shoulder": text =>
    text.replace(/BRANCH (FRONT|BACK)/g, (_, word: string) => `BRANCH ${word === "FRONT" ? "BACK" : "FRONT"}`),
});
