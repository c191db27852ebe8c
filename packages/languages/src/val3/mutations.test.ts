import { pose, robotById } from "@twincell/core";
import { describeMutations, type DialectBench } from "../testing/describe-dialect.ts";
import { val3 } from "./index.ts";

const bench: DialectBench = {
  robot: robotById("staubli_rx160")!,
  worldFromBase: pose([0.3, -0.2, 0.75], [0, 0, Math.sin(0.4), Math.cos(0.4)]),
  paths: ["ptp", "lin", "circ"],
};

/** Changes the values of every datum of that type. */
const values =
  (type: string, change: (value: string) => string) =>
  (text: string): string =>
    text.replace(
      new RegExp(`(type="${type}" size="1">\\s*)(<Value[^>]*>)`, "g"),
      (_, head: string, value: string) => head + change(value),
    );
const field = (type: string, name: string, change: (value: number) => number): ((text: string) => string) =>
  values(type, value =>
    value.replace(new RegExp(` ${name}="([^"]*)"`), (_, number: string) => ` ${name}="${change(Number(number))}"`),
  );
const exchanged = (type: string, a: string, b: string): ((text: string) => string) =>
  values(type, value => value.replace(` ${a}=`, " ?=").replace(` ${b}=`, ` ${a}=`).replace(" ?=", ` ${b}=`));
const word =
  (a: string, b: string) =>
  (text: string): string =>
    text.replace(new RegExp(`"(${a}|${b})"`, "g"), (_, found: string) => `"${found === a ? b : a}"`);
const once =
  (pattern: RegExp, by: string) =>
  (text: string): string =>
    text.replace(pattern, by);
const negated = (value: number): number => -value;
const POINT = "pointRx";
const JOINT = "jointRx";

describeMutations(val3, bench, {
  "joint 1 with the wrong sign": field(JOINT, "j1", negated),
  "joint 2 counted from level": field(JOINT, "j2", value => value + 90),
  "joint 3 counted as V+ does": field(JOINT, "j3", value => value + 90),
  "joint 4 with the wrong sign": field(JOINT, "j4", negated),
  "joint 6 with the wrong sign": field(JOINT, "j6", negated),
  "joints 4 and 5 in the wrong order": exchanged(JOINT, "j4", "j5"),
  "radians for degrees": field(JOINT, "j3", value => (value / 180) * Math.PI),
  "a hundredth of a degree too much": field(JOINT, "j5", value => value + 0.01),
  "metres for millimetres": field(POINT, "x", value => value / 1000),
  "heights from the foot": field(POINT, "z", value => value + 550),
  "x and y in the wrong order": exchanged(POINT, "x", "y"),
  "rx and rz in the wrong order": exchanged(POINT, "rx", "rz"),
  "ry with the wrong sign": field(POINT, "ry", negated),
  "rz with the wrong sign": field(POINT, "rz", negated),
  "two hundredths of a millimetre too much": field(POINT, "y", value => value + 0.02),
  "the other shoulder": word("righty", "lefty"),
  "the other elbow": word("epositive", "enegative"),
  "the other wrist": word("wpositive", "wnegative"),
  "points of the world": text => text.replace(/fatherId="(?!world|flange)[^"]*"(?= ?\/?>)/g, 'fatherId="world[0]"'),
  "a frame that is not there": once(/fatherId="(?!world|flange)[^"]*"/, 'fatherId="nowhere[0]"'),
  "a frame with the wrong sign": field("frame", "x", negated),
  "a frame from the foot": field("frame", "z", value => value + 550),
  "a frame turned the wrong way": field("frame", "rz", negated),
  "a tool with the wrong sign": field("tool", "x", negated),
  "a tool in metres": field("tool", "z", value => value / 1000),
  "a tool turned the wrong way": field("tool", "rx", value => value + 5),
  "no tool": text => text.replace(/,(?:torch|long_tool\w*),/g, ",flange,"),
  "a joint motion for a straight one": once(/movel\(/, "movej("),
  "a straight motion for a joint one": once(/movej\(/, "movel("),
  "a straight motion for an arc": once(/movec\([^,]*,/, "movel("),
  "the points of an arc in the wrong order": once(/movec\(([^,]*),([^,]*),/, "movec($2,$1,"),
  "a lost motion": once(/ +move[jl]\([^\r]*\r\n/, ""),
  "a motion twice": once(/( +move[jl]\([^\r]*\r\n)/, "$1$1"),
  "a motion that waits for nothing": once(/ +waitEndMove\(\)\r\n(?= +(?:\/\/[^\r]*\r\n +)*delay)/, ""),
  "a lost stop": text => text.replaceAll('blend="off"', 'blend="joint"'),
  "half the speed of joints": field("mdesc", "vel", value => value / 2),
  "speeds in metres": field("mdesc", "tmax", value => value / 1000),
  "half the acceleration": field("mdesc", "accel", value => value / 2),
  "another description": once(/,m\)/, ",m_2)"),
  "open for close": text =>
    text.replace(/(open|close)\(/, (_, found: string) => `${found === "open" ? "close" : "open"}(`),
  "a wait in milliseconds": text =>
    text.replace(/delay\(([0-9.]+)\)/, (_, s: string) => `delay(${Number(s) * 1000 + 1})`),
  "a lost wait": once(/ +delay\([^\r]*\r\n/, ""),
  "an early end": once(/( +move[jl]\([^\r]*\r\n)(?=[^]* +move)/, "$1return\r\n"),
  "no data": text => text.replace(/<Datas>[^]*<\/Datas>/, "<Datas></Datas>"),
  "no code": text => text.replace("<![CDATA[", "").replace("]]>", ""),
});
