import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { parseRobot, robotFromArm, withVendorFile } from "./index.ts";

const read = (path: string): unknown =>
  JSON.parse(readFileSync(new URL(`../../../../${path}`, import.meta.url), "utf8"));
interface Schema {
  readonly properties: Readonly<Record<string, Schema>>;
  readonly items: Schema;
  readonly required: readonly string[];
}
const { $defs: SCHEMA } = read("docs/robot.schema.json") as { readonly $defs: Readonly<Record<string, Schema>> };
const FILE = read("fixtures/robots/gp12.json") as Record<string, unknown> & {
  readonly joints: Record<string, unknown>[];
  readonly vendor: Record<string, unknown> & { readonly axes: object[]; readonly postures: object[] };
};

/** The fields that a reader names when it meets one that it does not know. */
function knownTo(answer: ReturnType<typeof parseRobot> | ReturnType<typeof withVendorFile>): string[] {
  const faults = answer.kind === "robot" ? [] : answer.faults;
  const said = faults
    .map(({ sentence }) => /it can have ([^.]*)\.$/.exec(sentence)?.[1])
    .find(each => each !== undefined);
  return said?.split(", ").sort() ?? [];
}
const strange = { strange: 1 };
const inVendor = (part: object): unknown => ({ ...FILE, vendor: { ...FILE.vendor, ...part } });

test("docs/robot.schema.json has the fields that robot files and vendor sections are read with, no more and no fewer", () => {
  const vendor = SCHEMA["vendor"]!;
  const fields = (schema: Schema): string[] => Object.keys(schema.properties).sort();
  expect(knownTo(parseRobot({ ...FILE, ...strange }))).toEqual(fields(SCHEMA["robot"]!));
  const joints = FILE.joints.with(0, { ...FILE.joints[0]!, ...strange });
  expect(knownTo(parseRobot({ ...FILE, joints }))).toEqual(fields(SCHEMA["robot"]!.properties["joints"]!.items));
  expect(knownTo(parseRobot(inVendor(strange)))).toEqual(fields(vendor));
  for (const [key, value] of [
    ["axes", FILE.vendor.axes.with(0, { ...FILE.vendor.axes[0]!, ...strange })],
    ["postures", FILE.vendor.postures.with(0, { ...FILE.vendor.postures[0]!, ...strange })],
    ["couplings", [{ axis: 3, with: 2, factor: 1, ...strange }]],
  ] as const)
    expect(knownTo(parseRobot(inVendor({ [key]: value }))), key).toEqual(fields(vendor.properties[key]!.items));
  expect(knownTo(parseRobot(inVendor({ pulses: { ...strange } })))).toEqual(fields(vendor.properties["pulses"]!));
  const answer = parseRobot({ ...FILE, vendor: "Yaskawa" });
  const arm = answer.kind === "robot" ? robotFromArm(answer.robot.arm) : undefined;
  expect(knownTo(withVendorFile(arm!, { format: "twincell.vendor", version: 1, ...strange }))).toEqual(
    fields(SCHEMA["beside"]!),
  );
});

test("what the schema requires is missed with its place", () => {
  for (const key of SCHEMA["vendor"]!.required) {
    const answer = parseRobot(inVendor({ [key]: undefined }));
    expect(answer.kind === "robot" ? "" : answer.faults.map(({ path }) => path).join(" "), key).toContain(
      `vendor.${key}`,
    );
  }
  for (const [part, says] of [
    [{ axes: FILE.vendor.axes.slice(1) }, "The robot has 6 joints; the vendor section counts 5 axes."],
    [{ axes: FILE.vendor.axes.with(2, { name: "U", sign: 2 }) }, "The sign of axis 3 is 1 or -1; here it is 2."],
    [{ couplings: [{ axis: 3, with: 3, factor: 1 }] }, "Axis 3, which axis 3 is coupled with, is itself coupled."],
    [{ couplings: [{ axis: 7, with: 2, factor: 1 }] }, "An axis is a number from 1 to 6; here it is 7."],
    [{ pulses: { per_rad: [1, 1, 0, 1, 1, 1], source: "x" } }, "No axis has 0 pulses per radian."],
  ] as const) {
    const answer = parseRobot(inVendor(part));
    expect(answer.kind === "robot" ? [] : answer.faults.map(({ sentence }) => sentence)).toContain(says);
  }
});
