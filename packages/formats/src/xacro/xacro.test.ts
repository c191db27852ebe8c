import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { describe, expect, test } from "vitest";
import { seededRandom } from "@twincell/core";
import { expandXacro, filesInMemory, readRobot } from "../index.ts";
import { disk } from "../testing/disk.ts";
import { parseXml, type Element } from "../xml.ts";

type Tree = readonly [
  name: string,
  attributes: Readonly<Record<string, string>>,
  text: string,
  children: readonly Tree[],
];
const folder = fileURLToPath(new URL("../../../../fixtures/xacro/", import.meta.url));
const golden = JSON.parse(readFileSync(`${folder}expanded.json`, "utf8")) as {
  cases: { file: string; args: Record<string, string>; tree: Tree }[];
};

const bytesOf = (text: string): Uint8Array => new TextEncoder().encode(text);
const treeOf = ({ name, attributes, text, children }: Element): Tree => [
  name,
  attributes,
  text
    .split(/\s+/)
    .filter(word => word !== "")
    .join(" "),
  children.map(treeOf),
];

/** Words equal, numbers to 1e-14 of their size: the last bit of a sine belongs to the machine. */
function sameText(got: string, want: string): boolean {
  const a = got.split(/\s+/);
  const b = want.split(/\s+/);
  return (
    a.length === b.length &&
    a.every(
      (word, i) =>
        word === b[i] ||
        (Math.abs(Number(word) - Number(b[i])) <= 1e-14 * Math.abs(Number(word)) &&
          /[.e]/.test(word) === /[.e]/.test(b[i]!)),
    )
  );
}
function expectTree(got: Tree, want: Tree, at: string): void {
  expect([at, got[0], Object.keys(got[1]).sort()]).toEqual([at, want[0], Object.keys(want[1]).sort()]);
  for (const [key, value] of Object.entries(want[1])) {
    const given = got[1][key]!.replaceAll(folder.slice(0, -1), "@");
    expect(sameText(given, value) ? value : given, `${at}/${got[0]}@${key}`).toBe(value);
  }
  expect(got[2]).toBe(want[2]);
  expect(got[3].map(child => child[0])).toEqual(want[3].map(child => child[0]));
  got[3].forEach((child, i) => {
    expectTree(child, want[3][i]!, `${at}/${got[0]}[${i}]`);
  });
}
function expanded(text: string, others: Record<string, string> = {}, args: Record<string, string> = {}) {
  return expandXacro(
    "main.xacro",
    filesInMemory(
      new Map(Object.entries({ "main.xacro": text, ...others }).map(([path, content]) => [path, bytesOf(content)])),
    ),
    { args },
  );
}
const robot = (inside: string): string =>
  `<?xml version="1.0"?>\n<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="r">\n${inside}\n</robot>`;

describe("expansion agrees with the reference implementation", () => {
  test.each(golden.cases.map(({ file, args, tree }) => [file, JSON.stringify(args), args, tree] as const))(
    "%s %s",
    (file, _, args, tree) => {
      const answer = expandXacro(`${folder}${file}`, disk, { args });
      if (answer.kind !== "expanded") throw new Error(`${answer.file}:${answer.line} ${answer.sentence}`);
      expectTree(treeOf(parseXml(answer.text)), tree, "");
    },
  );
});

const PROPERTY = (name: string, value: string): string => `<xacro:property name="${name}" value="${value}"/>`;

describe("what cannot be expanded is said in one sentence, with file and line", () => {
  test.each<[inside: string, sentence: string, line?: number]>([
    ['<a v="${b}"/>', "The name b is not defined.", 3],
    ['<a v="${1 +}"/>', "The expression “1 +” is not understood: its end is not expected there."],
    ['<a v="${1 ? 2}"/>', "“? 2” is not understood in the expression “1 ? 2”."],
    ['<a v="${(1}"/>', "The expression “(1” is not understood: “)” is missing."],
    ['<a v="${lambda x: x}"/>', "The expression “lambda x: x” is not understood: “lambda” is not expected there."],
    ['<a v="${1/0}"/>', "“/” divides by 0."],
    ["<a v=\"${'a' - 1}\"/>", "A text and a whole number cannot be combined with “-”."],
    ["<a v=\"${'a' &lt; 1}\"/>", "A text and a whole number have no order: “<” cannot compare them."],
    ['<a v="${sqrt(-1)}"/>', "sqrt() has no value at -1."],
    ["<a v=\"${sin('x')}\"/>", "sin() wants a number, not a text."],
    ['<a v="${[1][3]}"/>', "Item 3 is asked of a list with 1."],
    ['<a v="${dict(a=1).b}"/>', "The dictionary has no key b."],
    ["<a v=\"${''.__class__}\"/>", "The name __class__ may not be used."],
    ['<a v="${__import__}"/>', "The name __import__ may not be used."],
    ['<a v="${sin}"/>', "sin() stands where its value is expected."],
    ['<a v="${1"/>', "“${1” is not closed."],
    ['<a v="$(arg x)"/>', "The argument x has no value; give it as x:=value."],
    [
      '<a v="$(env HOME)"/>',
      "“$(env HOME)” asks for a variable of the computer's environment, which is not read; use an argument.",
    ],
    ['<a v="$(anon x)"/>', "“$(anon x)” is not known; arg, find, dirname, eval and optenv are."],
    ["\n<xacro:nothing/>", "There is no macro nothing.", 4],
    ['<xacro:macro name="m" params="a b"/><xacro:m a="1"/>', "The macro m is called without its parameter b."],
    ['<xacro:macro name="m"/><xacro:m a="1"/>', "The macro m has no parameter a."],
    ['<xacro:macro name="m" params="*b"/><xacro:m/>', "The macro m wants 1 blocks and is given 0."],
    ['<xacro:macro name="m"/><xacro:m><c/></xacro:m>', "The macro m has no use for <c>."],
    ['<xacro:insert_block name="b"/>', "There is no block b to insert."],
    ['<xacro:if value="maybe"/>', "The condition “maybe” became “maybe”, which is neither true nor false."],
    ["<xacro:if/>", "A condition has no value."],
    [PROPERTY("1a", "2"), "“1a” cannot name a property."],
    [`${PROPERTY("a", "${b}")}${PROPERTY("b", "${a}")}<c v="\${a}"/>`, "The property a rests on itself."],
    ['<xacro:include filename="gone.xacro"/>', "gone.xacro is missing."],
    [
      '<xacro:include filename="$(find gone_description)/a.xacro"/>',
      "package://gone_description/a.xacro is missing: the package gone_description is not beside the file.",
    ],
    [
      '<xacro:include filename="https://x/a.xacro"/>',
      "https://x/a.xacro is not a file here: only package://, file:// and plain paths are opened.",
    ],
    ['<xacro:element xacro:name="${1}"/>', "“1” cannot name an element."],
    ["${xacro.fatal('stop here')}", "The file itself stops: stop here."],
    [
      "<a v=\"${xacro.load_yaml('bad.yaml')}\"/>",
      "The YAML file is not understood: Flow sequence in block collection must be sufficiently indented and end with a ].",
    ],
    [
      "<a v=\"${xacro.load_yaml('bomb.yaml')}\"/>",
      "The YAML file repeats itself through aliases more than a hundred times.",
    ],
  ])("%s", (inside, sentence, line) => {
    const bomb = `a: &a [x, x, x, x, x, x, x, x, x]\n${[..."bcdefgh"].map((letter, i) => `${letter}: &${letter} [${Array.from({ length: 9 }, () => `*${"abcdefgh"[i]}`).join(", ")}]`).join("\n")}\n`;
    const answer = expanded(robot(inside), { "bad.yaml": "a: [1, 2", "bomb.yaml": bomb });
    if (answer.kind === "expanded") throw new Error(answer.text);
    expect(answer.sentence).toBe(sentence);
    if (line !== undefined) expect([answer.file, answer.line]).toEqual(["main.xacro", line]);
  });

  test("a fault in an included file is named there", () => {
    expect(
      expanded(robot(`<xacro:include filename="sub/b.xacro"/>`), { "sub/b.xacro": robot('\n<x v="${q}"/>') }),
    ).toEqual({ kind: "not-understood", sentence: "The name q is not defined.", line: 4, file: "sub/b.xacro" });
    expect(expanded(robot(`<xacro:include filename="b.xacro"/>`), { "b.xacro": "<robot>" })).toMatchObject({
      file: "b.xacro",
      sentence: "The file is not XML: unclosed tag: robot.",
    });
  });

  test("a robot made of a xacro that is wrong as a robot is named by the line that was written", () => {
    const main = robot(
      `<link name="a"/><link name="b"/>\n<xacro:macro name="j" params="n">\n<joint name="\${n}" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 0"/></joint></xacro:macro>\n<xacro:j n="j1"/>`,
    );
    const answer = readRobot("main.xacro", filesInMemory(new Map([["main.xacro", bytesOf(main)]])));
    expect(answer).toMatchObject({
      kind: "not-understood",
      sentence: "The axis of Joint j1 is (0, 0, 0) and has no direction.",
      line: 5,
      file: "main.xacro",
    });
  });
});

describe("every expansion ends", () => {
  const doubling = Array.from({ length: 60 }, (_, i) => PROPERTY(`p${i + 1}`, `\${p${i}}\${p${i}}`)).join("");
  test.each<[name: string, inside: string, sentence: string]>([
    [
      "a macro that calls itself",
      `<xacro:macro name="m"><xacro:m/></xacro:macro><xacro:m/>`,
      "Macros call each other more than 150 deep.",
    ],
    [
      "macros that double",
      `${Array.from({ length: 18 }, (_, i) => `<xacro:macro name="m${i}"><xacro:m${i + 1}/><xacro:m${i + 1}/></xacro:macro>`).join("")}<xacro:macro name="m18"><a/></xacro:macro><xacro:m0/>`,
      "The xacro becomes more than 200000 elements.",
    ],
    [
      "macros that double and make nothing",
      `${Array.from({ length: 60 }, (_, i) => `<xacro:macro name="m${i}"><xacro:m${i + 1}/><xacro:m${i + 1}/></xacro:macro>`).join("")}<xacro:macro name="m60"/><xacro:m0/>`,
      "The xacro grows without end: more than 20 million characters and operations were made from it.",
    ],
    [
      "a text that doubles",
      `${PROPERTY("p0", "xxxxxxxx")}${doubling}<a v="\${p60}"/>`,
      "The xacro grows without end: more than 20 million characters and operations were made from it.",
    ],
    [
      "a long list",
      `<a v="\${len([0] * 10**9)}"/>`,
      "The xacro grows without end: more than 20 million characters and operations were made from it.",
    ],
    [
      "a long range",
      `<a v="\${len(range(10**12))}"/>`,
      "The xacro grows without end: more than 20 million characters and operations were made from it.",
    ],
    ["a wide format", `<a v="\${'%999999999d' % 1}"/>`, "A number is to be written 999999999 characters wide."],
    ["a large power", `<a v="\${9**9**9}"/>`, "9 to the power of 387420489 is too large."],
    [
      "properties that rest on properties",
      `${PROPERTY("p0", "1")}${Array.from({ length: 400 }, (_, i) => PROPERTY(`p${i + 1}`, `\${p${i} + 1}`)).join("")}<a v="\${p400}"/>`,
      "Properties rest on each other more than 150 deep.",
    ],
    [
      "a file that includes itself",
      `<xacro:include filename="main.xacro"/>`,
      "Files include each other more than 32 deep.",
    ],
    [
      "a deep expression",
      `<a v="\${${"(".repeat(500)}1${")".repeat(500)}}"/>`,
      "An expression is nested more than 60 deep.",
    ],
    ["many signs", `<a v="\${${"-".repeat(5000)}1}"/>`, "An expression is nested more than 60 deep."],
    ["deep XML", "<a>".repeat(100) + "</a>".repeat(100), "Elements are nested more than 64 deep."],
  ])("%s", (_, inside, sentence) => {
    const before = performance.now();
    expect(expanded(robot(inside))).toMatchObject({ kind: "not-understood", sentence });
    expect(performance.now() - before).toBeLessThan(5000);
  });

  test("damaged files end in a robot or in a sentence (1500 seeded cases)", () => {
    const whole = readFileSync(`${folder}language.xacro`, "utf8");
    const space = readFileSync(`${folder}space.xacro`, "utf8");
    const random = seededRandom(17);
    const pieces = [
      "${",
      "}",
      "$(",
      ")",
      "'",
      '"',
      "(",
      "[",
      "]",
      "**",
      " if ",
      " for x in ",
      "<",
      "/>",
      "10**99",
      "%s",
      "0",
      ".",
      "xacro:",
      "\u0000",
      "é",
      "$$",
      "&lt;",
    ];
    let refused = 0;
    for (let i = 0; i < 1500; i++) {
      let text = whole;
      for (let n = 1 + Math.floor(random() * 2); n > 0; n--) {
        const at = 200 + Math.floor(random() * (text.length - 200));
        const length = Math.floor(random() * 8);
        text =
          text.slice(0, at) +
          (random() < 0.7 ? pieces[Math.floor(random() * pieces.length)]! : "") +
          text.slice(at + length);
      }
      const answer = expanded(text, { "space.xacro": space });
      if (answer.kind === "not-understood") {
        refused++;
        expect(answer.sentence).toMatch(/^.{10,400}[.]$/s);
      }
    }
    expect(refused).toBeGreaterThan(700);
  });
});

describe("arguments and files", () => {
  test("an argument that the file does not have is said, one that is given wins over its default", () => {
    const answer = expanded(robot(`<xacro:arg name="a" default="1"/><x v="$(arg a)"/>`), {}, { a: "5", b: "6" });
    expect(answer).toMatchObject({
      kind: "expanded",
      warnings: ["The argument b was given, but the file has no such argument."],
    });
    expect(answer.kind === "expanded" && answer.text).toContain(`<x v="5"/>`);
  });

  test("includes are found in packages, in other spellings, with backslashes, by pattern; every file that was read is told", () => {
    const part = (name: string): string => robot(`<${name}/>`);
    const files = filesInMemory(
      new Map(
        Object.entries({
          "ws/src/arm/package.xml": "<package><name>arm_description</name></package>",
          "ws/src/arm/urdf/main.xacro": robot(
            ["$(find arm_description)/urdf/A.xacro", "sub\\\\b.xacro", "$(find other)/c.xacro", "more/*.xacro"]
              .map(name => `<xacro:include filename="${name.replaceAll("\\\\", "\\")}"/>`)
              .join(""),
          ),
          "ws/src/arm/urdf/a.xacro": part("one"),
          "ws/src/arm/urdf/sub/b.xacro": part("two"),
          "ws/src/other/c.xacro": part("three"),
          "ws/src/arm/urdf/more/x.xacro": part("four"),
          "ws/src/arm/urdf/more/y.xacro": part("five"),
        }).map(([path, text]) => [path, bytesOf(text)]),
      ),
    );
    const answer = expandXacro("ws/src/arm/urdf/main.xacro", files);
    if (answer.kind !== "expanded") throw new Error(answer.sentence);
    expect(parseXml(answer.text).children.map(({ name }) => name)).toEqual(["one", "two", "three", "four", "five"]);
    expect(answer.read.length).toBe(6);
    expect(answer.warnings).toEqual(["ws/src/arm/urdf/A.xacro is spelt ws/src/arm/urdf/a.xacro."]);
  });
});
