import { pose, robotById } from "@twincell/core";
import { describeDialect, describeMutations, type DialectBench } from "../testing/describe-dialect.ts";
import { listIn, negatedAt, numberFaults } from "../testing/changes.ts";
import { linesOf } from "../testing/lines.ts";
import { describeStructure } from "../testing/describe-structure.ts";
import { melfaBasic } from "./index.ts";

const bench: DialectBench = {
  robot: robotById("mitsubishi_rv7fl")!,
  worldFromBase: pose([0.3, -0.2, 0.75], [0, 0, Math.sin(0.4), Math.cos(0.4)]),
  paths: ["ptp", "lin", "circ"],
  structured: true,
  signals: linesOf("melfa-basic"),
};

describeDialect(melfaBasic, bench);
describeStructure(melfaBasic, bench);

const joints = listIn(/^(J\d+=\()([^)]*)(\))/m);
const place = listIn(/^(P\d+=\()([^)]*)(\)\([1-7])/m);
const flag =
  (bit: number) =>
  (text: string): string =>
    text.replace(/^(P\w+=\([^)]*\)\()([1-7]),/gm, (_, head: string, value: string) => `${head}${Number(value) ^ bit},`);

describeMutations(melfaBasic, bench, {
  ...numberFaults(joints, place, 400),
  "a joint motion for a straight one": text => text.replace(/ Mvs P/, " Mov P"),
  "a straight motion for a joint motion": text => text.replace(/ Mov P/, " Mvs P"),
  "the middle of an arc and its end in the wrong order": text =>
    text.replace(/(Mvr [^,]*),([^,]*),([^\r]*)/, "$1,$3,$2"),
  "an arc that starts somewhere else": text => text.replace(/Mvr [^,]*,([^,]*)/, "Mvr $1,$1"),
  "lost stops": text => text.replace(/\d+ +Cnt 0\r\n/g, ""),
  "points that are never passed": text => text.replaceAll("Cnt 1, 10, 10", "Cnt 0"),
  "a lost tool": text => text.replace(/\d+ Tool P(?!_)[^\r]*\r\n/, ""),
  "a tool with the wrong sign": listIn(/^(PTORCH=\()([^)]*)(\))/m)(negatedAt(0)),
  "a frame with the wrong sign": listIn(/^(PCARTON=\()([^)]*)(\))/m)(negatedAt(0)),
  "a place that does not count from its frame": text => text.replace(/(Mov|Mvs) P[A-Z_0-9]+\*/, "$1 "),
  "a frame behind its place": text => text.replace(/(Mov|Mvs) (P[A-Z_0-9]+)\*(P\d+)/, "$1 $3*$2"),
  "a lost motion": text => text.replace(/\d+ Mo?v[^\r]*\r\n/, ""),
  "open for close": text => text.replace(/HOpen|HClose/, word => (word === "HOpen" ? "HClose" : "HOpen")),
  "a wait in milliseconds": text => text.replace(/Dly ([0-9.]+)/, (_, s: string) => `Dly ${Number(s) * 1000}`),
  "half the speed of a path": text => text.replace(/Spd ([0-9.]+)/, (_, v: string) => `Spd ${Number(v) / 2}`),
  "a share for a percentage": text => text.replace(/JOvrd ([0-9.]+)/, (_, v: string) => `JOvrd ${Number(v) / 100}`),
  "the wrong arm": flag(4),
  "the wrong elbow": flag(2),
  "the wrong wrist": flag(1),
});
