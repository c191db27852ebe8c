import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { afterAll, describe, expect, test } from "vitest";

const root = fileURLToPath(new URL("../../../", import.meta.url));
const CELL = "examples/03-conveyor-pallet/cell.json";
const folder = mkdtempSync(join(tmpdir(), "twincell-physics-"));
afterAll(() => {
  rmSync(folder, { recursive: true, force: true });
});

function twincell(...args: readonly string[]) {
  const run = spawnSync(process.execPath, ["apps/cli/src/main.ts", ...args], {
    cwd: root,
    encoding: "utf8",
    maxBuffer: 1 << 28,
  });
  return { code: run.status ?? -1, out: run.stdout, err: run.stderr };
}
interface Line {
  readonly t: number;
  readonly io: Record<string, boolean>;
  readonly parts: Record<string, { position: number[]; grasp: string }>;
  readonly events: { sentence: string }[];
}

/** The example with one box to fetch only, and something changed. */
function oneBox(
  name: string,
  change: (cell: { objects: { id: string; mass_kg?: number }[]; robot: { id: string } }) => void = () => undefined,
): readonly [program: string, cell: string] {
  const cell = JSON.parse(readFileSync(`${root}${CELL}`, "utf8"));
  const program = cell.programs[0];
  cell.objects = cell.objects.filter((object: { id: string }) => !/box-[2-9]/.test(object.id));
  Object.assign(program.pallets.places, { rows: 1, columns: 1 });
  change(cell);
  const paths = [join(folder, `${name}.program.json`), join(folder, `${name}.cell.json`)] as const;
  writeFileSync(paths[0], JSON.stringify(program));
  writeFileSync(paths[1], JSON.stringify(cell));
  return paths;
}

describe("simulate --physics", () => {
  const [program, cell] = oneBox("one");
  test("X-36 writes where the parts are and what happens, and ends with the box on its place", () => {
    const { code, out, err } = twincell("simulate", program, "--cell", cell, "--physics", "--period", "0.1");
    const lines = out
      .trim()
      .split("\n")
      .map(line => JSON.parse(line) as Line);
    expect(code, err).toBe(0);
    const said = lines.flatMap(({ events }) => events.map(({ sentence }) => sentence));
    expect(said).toEqual(
      expect.arrayContaining([
        "“Photo-cell” was tripped.",
        "“Box 1” is held.",
        "“Box 1” weighs 0.8 kg.",
        "The program has come to its end.",
      ]),
    );
    expect(lines.some(({ io, parts }) => io.gripper === true && parts["box-1"]!.grasp === "held")).toBe(true);
    [0.47, 0.22, 0.23].forEach((wanted, k) => {
      expect(Math.abs(lines.at(-1)!.parts["box-1"]!.position[k]! - wanted)).toBeLessThan(0.003);
    });
    expect(err).toMatch(/^The program took \d+\.\d\d s\. This rests on: .*friction of 0\.6.* States [0-9a-f]{16}\.\n$/);
  });
  test("X-07 what is too heavy is refused with a sentence, exit 1", () => {
    const [heavy, at] = oneBox("heavy", document => {
      document.objects.find(({ id }) => id === "box-1")!.mass_kg = 10.1;
    });
    const { code, err } = twincell("simulate", heavy, "--cell", at, "--physics", "--period", "1");
    expect(code).toBe(1);
    expect(err).toContain(
      "twincell: Universal Robots UR10e carries at most 10 kg; “Box 1” (10.1 kg) with the gripper (0.08 kg) weighs 10.18 kg.",
    );
  });
  test("wrong use is said: a control nobody knows", () => {
    expect(twincell("simulate", program, "--cell", cell, "--physics", "--control", "magic")).toMatchObject({
      code: 2,
      err: expect.stringContaining('not "magic"'),
    });
  });
});

test("X-44 dataset writes a header, samples and ends; the same seed the same file", () => {
  const [program, cell] = oneBox("data");
  const write = (name: string): string => {
    const file = join(folder, name);
    const { code, err } = twincell(
      "dataset",
      program,
      "--cell",
      cell,
      "--episodes",
      "1",
      "--seed",
      "5",
      "--jitter",
      "0.002",
      "-o",
      file,
    );
    expect(code, err).toBe(0);
    expect(err).toMatch(/^1 of 1 episodes came to their end; \d+ lines\.\n$/);
    return readFileSync(file, "utf8");
  };
  const text = write("a.jsonl");
  const lines = text
    .trim()
    .split("\n")
    .map(line => JSON.parse(line) as Record<string, unknown>);
  expect(lines[0]).toMatchObject({ format: "twincell.dataset", version: 1, robot: "ur10e" });
  expect(lines.filter(line => "end" in line).map(({ end }) => end)).toEqual(["done"]);
  expect(write("b.jsonl")).toBe(text);
});

test("X-34 validate prints a success table, exit 1 when something was not placed", () => {
  const { code, out, err } = twincell("validate", "--shapes", "cylinder", "--widths", "0.05", "--masses", "1,12");
  expect(code).toBe(1);
  expect(out.split("\n")[0]).toMatch(/^cylinder +50 mm +1 kg {2}placed +\d\.\d\d mm off$/);
  expect(out.split("\n")[1]).toMatch(
    /^cylinder +50 mm +12 kg {2}refused Universal Robots UR10e carries at most 10 kg;/,
  );
  expect(err).toBe("1 of 2 placed by Universal Robots UR10e.\n");
});
