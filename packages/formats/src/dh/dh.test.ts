import { describe, expect, test } from "vitest";
import { angleBetween, distance, flangePose, LIBRARY, robotById, seededRandom, type SerialArm } from "@twincell/core";
import { dhTableText, readDhTable, writeDhTable } from "../index.ts";

const RX90L = `# The RX90L as its paper prints it, with the shoulder above the floor.
# name: RX90L
# convention: modified
# units: mm deg
joint  a    alpha  d    theta  lower   upper  speed
1      0      0    420  0      -160    160    236
2      0    -90      0  0      -227.5  47.5   200
3      450    0      0  0      -52.5   232.5  286
4      0     90    650  0      -270    270    401
5      0    -90      0  0      -105    120    320
6      0     90     85  0      -270    270    580
`;
function read(text: string) {
  const answer = readDhTable(text);
  if (answer.kind !== "read") throw new Error(answer.sentence);
  return answer;
}
function expectSame(a: SerialArm, b: SerialArm, within: number): void {
  const random = seededRandom(4);
  for (let n = 0; n < 50; n++) {
    const q = a.joints.map(() => 6 * random() - 3);
    const one = flangePose(a, q);
    const other = flangePose(b, q);
    expect(
      Math.max(distance(one.position, other.position), angleBetween(one.quaternion, other.quaternion)),
    ).toBeLessThan(within);
  }
}

describe("N-08 the RX90L from its D-H table", () => {
  const library = robotById("staubli_rx90l")!;
  test("as text with spaces, commas, semicolons or tabs: the library's arm to 1e-12, with its limits", () => {
    for (const separator of [" ", ",", "; ", "\t"]) {
      const { arm, assumptions } = read(
        RX90L.replace(/([^\n])[ ]+(?=[-\w])/g, (whole, before: string, at: number, all: string) =>
          all.lastIndexOf("#", at) > all.lastIndexOf("\n", at) ? whole : before + separator,
        ),
      );
      expectSame(arm, library.arm, 1e-12);
      arm.joints.forEach(({ name, limits }, j) => {
        expect(name).toBe(`joint_${j + 1}`);
        for (const key of ["lower_rad", "upper_rad", "speed_rad_s", "acceleration_rad_s2"] as const)
          expect(limits[key]).toBeCloseTo(library.arm.joints[j]!.limits[key], 12);
      });
      expect(assumptions.length).toBe(6);
    }
  });

  test("written as a table for people, read again", () => {
    const text = dhTableText(read(RX90L).table, ["j1", "j2", "j3", "j4", "j5", "j6"]);
    expect(text).toContain("j3    450      0    0      0");
    expectSame(read(text).arm, library.arm, 1e-12);
  });
});

test("every arm of the library is written as a table of either convention and read back to 1e-12, limits included", () => {
  for (const { arm } of LIBRARY)
    for (const convention of ["standard", "modified"] as const) {
      const back = read(writeDhTable(arm, convention));
      expectSame(arm, back.arm, 1e-12);
      expect(back.assumptions).toEqual([]);
      expect(back.arm.name).toBe(arm.name);
      expect(back.arm.joints.map(({ name }) => name)).toEqual(arm.joints.map(({ name }) => name));
      back.arm.joints.forEach(({ limits }, j) => {
        expect(limits.lower_rad).toBe(arm.joints[j]!.limits.lower_rad);
      });
    }
});

test("metres and radians, a sense of -1, base and flange", () => {
  const { arm } =
    read(`{"convention":"standard","units":{"length":"m","angle":"rad"},"rows":[{"a":0.5,"alpha":0,"d":0.1,"sense":-1}],
    "base":{"position":[1,0,0],"quaternion":[0,0,0,1]},"flange":{"position":[0,0,0.2],"quaternion":[0,0,0,1]}}`);
  const { position } = flangePose(arm, [Math.PI / 2]);
  [1, -0.5, 0.3].forEach((value, k) => {
    expect(position[k]).toBeCloseTo(value, 12);
  });
});

const json = (inside: string, head = `"convention":"modified","units":{"length":"m","angle":"rad"},`): string =>
  `{${head}"rows":[${inside}]}`;
const text = (rows: string, head = "# convention: standard\n# units: mm deg\n"): string => `${head}a alpha d\n${rows}`;
test.each<[string, string, number?]>([
  ["", "The table has no line of column names, such as: name a alpha d theta."],
  ["{", "The file begins like JSON, but it is no JSON."],
  ["{}", "The table has no rows."],
  [json(""), "The table has no rows."],
  [json("1"), "Row 1 is not an object."],
  [json(`{"a":0,"alpha":0}`), "The row of joint_1 has no d."],
  [json(`{"a":0,"alpha":null,"d":0}`), "The alpha of row 1 is not a finite number."],
  [json(`{"a":1e999,"alpha":0,"d":0}`), "The a of row 1 is not a finite number."],
  [
    json(`{"a":0,"alpha":0,"d":0,"tetha":1}`),
    "Row 1 has an entry “tetha”; a, alpha, d, theta, sense, sigma, lower, upper, speed, acceleration and name are known.",
  ],
  [json(`{"a":450,"alpha":0,"d":0}`), "The a of joint_1 would be 450 m; the table is read in m."],
  [json(`{"a":0,"alpha":0,"d":0,"sense":2}`), "The sense of joint_1 is 2; it is 1 or -1."],
  [json(`{"a":0,"alpha":0,"d":0,"lower":1,"upper":0}`), "The lower limit of joint_1, 1, is above its upper limit, 0."],
  [json(`{"a":0,"alpha":0,"d":0,"speed":-1}`), "The speed of joint_1 is -1, below 0."],
  [json(`{"name":"x","a":0,"alpha":0,"d":0},{"name":"x","a":0,"alpha":0,"d":0}`), "Two rows are called x."],
  [
    json(`{"a":0,"alpha":0,"d":0}`, `"convention":"craig",`),
    "The convention “craig” is not known: standard or modified.",
  ],
  [
    json(`{"a":0,"alpha":0,"d":0}`, `"convention":"standard",`),
    "The table does not say its units: lengths in m or mm, angles in rad or deg.",
  ],
  [
    json(`{"a":0,"alpha":0,"d":0}`, `"convention":"standard","units":{"length":"m","angle":"rad"},"base":{},`),
    'The base wants "position" as 3 finite numbers.',
  ],
  [text("1 2 3", "# units: mm deg\n"), "The table does not say its convention: standard or modified."],
  [text("1 2\n"), "A row has 2 entries; there are 3 columns.", 4],
  [text("1 x 3\n"), "The alpha holds “x”, which is not a usable number.", 4],
  [text("1 NaN 3\n"), "The alpha holds “NaN”, which is not a usable number.", 4],
  [
    "# convention: standard\n# units: mm deg\na beta d\n",
    "“beta” is no column of a D-H table; a, alpha, d, theta, sense, sigma, lower, upper, speed, acceleration and name are.",
    3,
  ],
  [text("0 0 0\n".repeat(101)), "The table has 101 rows; at most 100 are read."],
  ["x".repeat(1_000_001), "The file has 1000001 characters; a D-H table has at most 1000000."],
])("refused in one sentence: %#", (content, sentence, line) => {
  expect(readDhTable(content)).toEqual({ kind: "not-understood", sentence, ...(line === undefined ? {} : { line }) });
});
