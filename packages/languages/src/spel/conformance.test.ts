import { pose, robotById } from "@twincell/core";
import { describeDialect, describeMutations, type DialectBench } from "../testing/describe-dialect.ts";
import { listIn, negatedAt, numberFaults } from "../testing/changes.ts";
import { linesOf } from "../testing/lines.ts";
import { describeStructure } from "../testing/describe-structure.ts";
import { spel } from "./index.ts";

const bench: DialectBench = {
  robot: robotById("epson_c4_a601s")!,
  worldFromBase: pose([0.3, -0.2, 0.75], [0, 0, Math.sin(0.4), Math.cos(0.4)]),
  paths: ["ptp", "lin", "circ"],
  structured: true,
  signals: linesOf("spel"),
};

describeDialect(spel, bench);
describeStructure(spel, bench);

const joints = listIn(/(Go JA\()([^)]*)(\))/);
const place = listIn(/((?:Go|Move) XY\()([^)]*)(\))/);
const other =
  (a: string, b: string) =>
  (text: string): string =>
    text.replace(
      new RegExp(`^( *Go XY[^\\r]*) /(${a}|${b})\\b`, "m"),
      (_, head: string, word: string) => `${head} /${word === a ? b : a}`,
    );

describeMutations(spel, bench, {
  ...numberFaults(joints, place, 320),
  "a joint motion for a straight one": text => text.replace("  Move XY", "  Go XY"),
  "a straight motion for a joint motion": text => text.replace("  Go XY", "  Move XY"),
  "the middle of an arc and its end in the wrong order": text =>
    text.replace(/Arc3 ([^\r]*?\)(?: \/\d)?), ([^\r]*?\)(?: \/\d)?)( CP)?\r/, "Arc3 $2, $1$3\r"),
  "a stop that is passed": text =>
    text.replace(
      /( {2}(?:Go|Move) [^\r]*\))\r\n(?=(?: {2}(?!Wait|O[nf]|Tool)[^\r]*\r\n)*? {2}(?:Go|Move|Arc3))/,
      "$1 CP\r\n",
    ),
  "a lost tool": text => text.replace(/ {2}Tool [^0][^\r]*\r\n/, ""),
  "a tool with the wrong sign": listIn(/(TLSet torch, XY\()([^)]*)(\))/)(negatedAt(0)),
  "a local with the wrong sign": listIn(/(Local carton, XY\()([^)]*)(\))/)(negatedAt(0)),
  "a place that does not count from its local": text => text.replace(/(XY\([^)]*\)) \/\d/, "$1"),
  "a lost motion": text => text.replace(/ {2}(?:Go|Move)[^\r]*\r\n/, ""),
  "open for close": text =>
    text.replace(/(On|Off) doGripper/, (_, word: string) => `${word === "On" ? "Off" : "On"} doGripper`),
  "a wait in milliseconds": text => text.replace(/Wait ([0-9.]+)/, (_, s: string) => `Wait ${Number(s) * 1000}`),
  "half the speed of a path": text => text.replace(/SpeedS ([0-9.]+)/, (_, v: string) => `SpeedS ${Number(v) / 2}`),
  "the speed of joints for the speed of a path": text => text.replace(/SpeedS [0-9.]+/, "Speed 50"),
  "the wrong hand": other("L", "R"),
  "the wrong elbow": other("A", "B"),
  "the wrong wrist": other("NF", "F"),
});
