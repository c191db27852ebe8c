import { pose, robotById } from "@twincell/core";
import { expect, test } from "vitest";
import { vPlus } from "../index.ts";
import { describeDialect, describeMutations, type DialectBench } from "../testing/describe-dialect.ts";

const bench: DialectBench = {
  robot: robotById("staubli_rx90l")!,
  worldFromBase: pose([0.3, -0.2, 0.75], [0, 0, Math.sin(0.4), Math.cos(0.4)]),
  paths: ["ptp", "lin"],
  structured: true,
  runnable: files => files.find(file => file.name.endsWith(".v2"))!,
};

describeDialect(vPlus, bench);

test("a byte-order mark, lower case and blanks at will change nothing", () => {
  const steps = (text: string): unknown => {
    const parsed = vPlus.parse(text, bench.robot);
    return parsed.kind === "parsed" ? parsed.program.steps : parsed.faults;
  };
  const plain = steps(".PROGRAM a()\nSPEED 50 ALWAYS\nMOVE #PPOINT(1,2,3)\n.END\n");
  expect(plain).toMatchObject([{ type: "move", speed: { ratio: 0.5 } }]);
  expect(steps("\uFEFF.program A ( )\r\n\tspeed  50 always\r\n  move   #ppoint ( 1 , 2 ,3 )\r\n.end\r\n")).toEqual(
    plain,
  );
});

/** Changes the numbers of the first location that matches. */
const location =
  (word: "TRANS" | "#PPOINT", change: (numbers: string[]) => string[]) =>
  (text: string): string =>
    text.replace(
      new RegExp(`(MOVES? ${word})\\(([^)]*)\\)`),
      (_, head: string, numbers: string) => `${head}(${change(numbers.split(",")).join(",")})`,
    );
const negated = (text: string): string => (text.startsWith("-") ? text.slice(1) : `-${text}`);
const swapped =
  (i: number, j: number) =>
  (list: string[]): string[] =>
    list.with(i, list[j]!).with(j, list[i]!);

describeMutations(vPlus, bench, {
  "a joint with the wrong sign": location("#PPOINT", list => list.with(1, negated(list[1]!))),
  "two joints in the wrong order": location("#PPOINT", swapped(3, 4)),
  "radians for degrees": location("#PPOINT", list => list.map(x => String((Number(x) / 180) * Math.PI))),
  "metres for millimetres": location("TRANS", list => list.map((x, i) => (i < 3 ? String(Number(x) / 1000) : x))),
  "x and y in the wrong order": location("TRANS", swapped(0, 1)),
  "yaw and roll in the wrong order": location("TRANS", swapped(3, 5)),
  "a roll with the wrong sign": location("TRANS", list => list.with(5, negated(list[5]!))),
  "heights from the foot instead of the shoulder": location("TRANS", list =>
    list.with(2, String(Number(list[2]) + 420)),
  ),
  "a hundredth of a degree too much": location("#PPOINT", list => list.with(0, String(Number(list[0]) + 0.01))),
  "two hundredths of a millimetre too much": location("TRANS", list => list.with(0, String(Number(list[0]) + 0.02))),
  "a joint motion for a straight one": text => text.replace("MOVES ", "MOVE "),
  "a lost stop": text => text.replace(/ {2}BREAK\r\n(?=(?: {2}(?!DELAY|OPENI|CLOSEI|TOOL)[^\r]*\r\n)*? {2}MOVE)/, ""),
  "a lost tool": text => text.replace(/ {2}TOOL (?!NULL)[^\r]*\r\n/, ""),
  "a tool with the wrong sign": text =>
    text.replace(/(SET torch = TRANS\()([^,]*)/, (_, head: string, x: string) => head + negated(x)),
  "a lost motion": text => text.replace(/ {2}MOVE[^\r]*\r\n/, ""),
  "open for close": text => text.replace(/OPENI|CLOSEI/, word => (word === "OPENI" ? "CLOSEI" : "OPENI")),
  "a wait in milliseconds": text => text.replace(/DELAY ([0-9.]+)/, (_, s: string) => `DELAY ${Number(s) * 1000}`),
  "a speed in metres per second": text =>
    text.replace(/SPEED ([0-9.]+) MMPS/, (_, v: string) => `SPEED ${Number(v) / 1000} MMPS`),
  "a percentage for millimetres per second": text => text.replace(" MMPS", ""),
  "the wrong elbow": text => text.replace(/ABOVE|BELOW/g, word => (word === "ABOVE" ? "BELOW" : "ABOVE")),
  "the wrong wrist": text => text.replace(/NOFLIP|FLIP/g, word => (word === "FLIP" ? "NOFLIP" : "FLIP")),
});
