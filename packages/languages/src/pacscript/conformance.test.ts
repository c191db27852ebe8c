import { pose, robotById } from "@twincell/core";
import { describeDialect, describeMutations, type DialectBench } from "../testing/describe-dialect.ts";
import { listIn, negatedAt, numberFaults } from "../testing/changes.ts";
import { linesOf } from "../testing/lines.ts";
import { describeStructure } from "../testing/describe-structure.ts";
import { pacScript } from "./index.ts";

const bench: DialectBench = {
  robot: robotById("denso_vs060")!,
  worldFromBase: pose([0.3, -0.2, 0.75], [0, 0, Math.sin(0.4), Math.cos(0.4)]),
  paths: ["ptp", "lin", "circ"],
  structured: true,
  signals: linesOf("pacscript"),
};

describeDialect(pacScript, bench);
describeStructure(pacScript, bench);

const joints = listIn(/(Move P, @\d+ J\()([^)]*)(\))/);
const place = listIn(/(Move [PL], @\d+ P\()([^)]*)(\))/);
const figure =
  (bit: number) =>
  (text: string): string =>
    text.replace(
      /^( *Move P, @\d+ P\((?:[^,]*, ){6})([0-7])\)/gm,
      (_, head: string, value: string) => `${head}${Number(value) ^ bit})`,
    );

describeMutations(pacScript, bench, {
  ...numberFaults(joints, place, 345),
  "a joint motion for a straight one": text => text.replace(/Move L, (@\d+ P)/, "Move P, $1"),
  "a straight motion for a joint motion": text => text.replace(/Move P, (@\d+ P)/, "Move L, $1"),
  "the middle of an arc and its end in the wrong order": text =>
    text.replace(/Move C, (P\([^)]*\)), (@\d+) ([PJ]\([^)]*\))/, "Move C, $3, $2 $1"),
  "stops that are passed": text => text.replaceAll("@0 ", "@10 "),
  "points that are never passed": text => text.replaceAll("@10 ", "@0 "),
  "a lost tool": text => text.replace(/ {2}ChangeTool [^0][^\r]*\r\n/, ""),
  "a lost work": text => text.replace(/ {2}ChangeWork [^0][^\r]*\r\n/, ""),
  "a tool with the wrong sign": listIn(/(Tool torch, P\()([^)]*)(\))/)(negatedAt(0)),
  "a work with the wrong sign": listIn(/(Work carton, P\()([^)]*)(\))/)(negatedAt(0)),
  "a lost motion": text => text.replace(/ {2}Move[^\r]*\r\n/, ""),
  "open for close": text =>
    text.replace(
      /(Set|Reset) IO\[doGripper\]/,
      (_, word: string) => `${word === "Set" ? "Reset" : "Set"} IO[doGripper]`,
    ),
  "a wait in seconds": text => text.replace(/Delay ([0-9.]+)/, (_, ms: string) => `Delay ${Number(ms) / 1000}`),
  "millimetres for metres per second": text =>
    text.replace(/Mps\(([0-9.]+)\)/, (_, v: string) => `Mps(${Number(v) * 1000})`),
  "a percentage for metres per second": text => text.replace(/Mps\(([0-9.]+)\)/, "$1"),
  "a share for a percentage": text => text.replace(/Speed = ([0-9.]+)/, (_, v: string) => `Speed = ${Number(v) / 100}`),
  "the wrong arm": figure(1),
  "the wrong elbow": figure(2),
  "the wrong wrist": figure(4),
});
