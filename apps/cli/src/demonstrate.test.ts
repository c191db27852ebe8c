import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { afterAll, describe, expect, test } from "vitest";

const root = fileURLToPath(new URL("../../../", import.meta.url));
const folder = mkdtempSync(join(tmpdir(), "twincell-hand-"));
afterAll(() => {
  rmSync(folder, { recursive: true, force: true });
});
const at = (name: string): string => join(folder, name);

function twincell(args: readonly string[]): { code: number; lines: Record<string, unknown>[]; err: string } {
  const run = spawnSync(process.execPath, ["apps/cli/src/main.ts", ...args], { cwd: root, encoding: "utf8" });
  const lines = run.stdout.trim().split("\n").filter(Boolean);
  return {
    code: run.status ?? -1,
    lines: lines.map(line => JSON.parse(line) as Record<string, unknown>),
    err: run.stderr,
  };
}

/** A table of a hand that picks at y = −0.2 m and places at y = 0.2 m, 50 samples a second, `slow` times as slow. */
function table(name: string, slow = 1, off_mm = 0): string {
  const rows: string[] = ["t_s,x_mm,y_mm,z_mm,rx_deg,ry_deg,rz_deg,closed"];
  let t = 0;
  let from: readonly number[] = [500, -200, 350];
  const sample = (p: readonly number[], closed: boolean): void => {
    rows.push([t.toFixed(3), ...p, 0, 180, 0, closed ? 1 : 0].join(","));
    t += 0.02 * slow;
  };
  const go = (to: readonly number[], closedFrom: boolean, closedTo: boolean): void => {
    for (let n = 1; n <= 50; n++)
      sample(
        from.map((v, k) => v + (n / 50) * (to[k]! - v) + (k === 0 ? off_mm * Math.sin(n) : 0)),
        closedFrom,
      );
    for (let n = 0; n < 30; n++) sample(to, n < 15 ? closedFrom : closedTo);
    from = to;
  };
  go([500, -200, 200], false, true);
  go([500, -200, 350], true, true);
  go([500, 200, 350], true, true);
  go([500, 200, 200], true, false);
  go([500, 200, 350], false, false);
  writeFileSync(at(name), `${rows.join("\n")}\n`);
  return at(name);
}

describe("twincell demonstrate", () => {
  test("M-38 M-39 M-47 M-54 one shown pick-and-place becomes a program for nine places, with what was filtered and how far it is off", () => {
    const shown = table("expert.csv");
    const { code, lines, err } = twincell([
      ...["demonstrate", shown, "--robot", "kuka_kr6r900sixx", "-o", at("nine.json"), "--filtered", at("filtered.csv")],
      ...["--pallet", "0.5,0.2,0.2;0.6,0.2,0.2;0.5,0.3,0.2", "--rows", "3", "--columns", "3"],
    ]);
    expect([code, err]).toEqual([0, ""]);
    expect(lines[0]).toMatchObject({
      kind: "planned",
      samples: 400,
      dropped: 0,
      stops: 5,
      straights: 5,
      curves: 0,
      points: 15,
      places: 9,
    });
    expect(lines[0]!["rate_Hz"]).toBeCloseTo(50, 6);
    const deviation = lines[0]!["deviation"] as { max_mm: number; rms_mm: number };
    expect(deviation.max_mm).toBeLessThan(1);
    expect(deviation.rms_mm).toBeLessThan(deviation.max_mm);
    expect(readFileSync(at("filtered.csv"), "utf8").trim().split("\n").length).toBeGreaterThanOrEqual(6);
    // The command line's own check is content with it.
    const check = twincell(["check", at("nine.json"), "--robot", "kuka_kr6r900sixx"]);
    expect([check.code, check.err]).toEqual([0, ""]);
    // KRL is written from it and executed again.
    const post = twincell(["post", at("nine.json"), "--to", "krl", "-o", at("krl")]);
    expect([post.code, post.err]).toEqual([0, ""]);
  }, 60_000);

  test("M-61 M-62 three attempts are scored against the expert's and the best is named", () => {
    const paths = [table("far.csv", 1, 30), table("slow.csv", 3), table("good.csv", 1.1, 2)];
    const { code, lines } = twincell([
      "demonstrate",
      "score",
      table("expert.csv"),
      ...paths,
      "--within-mm",
      "10",
      "--within-s",
      "12",
    ]);
    expect(code).toBe(0);
    expect(lines.slice(0, 3).map(line => line["accepted"])).toEqual([false, false, true]);
    expect(lines[3]).toMatchObject({ kind: "best", attempt: paths[2], accepted: true });
    expect(twincell(["demonstrate", "score", at("expert.csv"), at("far.csv"), "--within-mm", "1"]).code).toBe(1);
  }, 30_000);

  test("M-29 M-30 M-35 a hand is calibrated, and its glove's raw lines become a table with velocities", () => {
    const sweep = Array.from({ length: 20 }, (_, i) => 300 + 140 * i);
    const readings = [9.81, 0, -9.81].map(a => ({ voltage_V: (a + 24) / 9.6, acceleration_mps2: a }));
    writeFileSync(
      at("hand.json"),
      JSON.stringify({ name: "Ana", fingers: Array(5).fill(sweep), accelerometer: readings }),
    );
    const profile = twincell(["calibrate", "hand", at("hand.json")]);
    expect(profile.code).toBe(0);
    expect(profile.lines[0]).toMatchObject({ format: "twincell.hand", name: "Ana" });
    writeFileSync(at("profile.json"), JSON.stringify(profile.lines[0]));
    const raw = Array.from({ length: 101 }, (_, i) => {
      const a = i < 25 ? 1 : i < 50 ? -1 : 0;
      return [i / 50, (a + 24) / 9.6, 2.5, 2.5, 0, 0, 0, 1, ...Array<number>(5).fill(i > 60 ? 2900 : 310)].join(",");
    });
    writeFileSync(at("raw.csv"), [...raw, "garbage"].join("\n"));
    const made = twincell([
      "demonstrate",
      "raw",
      at("raw.csv"),
      "--hand",
      at("profile.json"),
      "--start",
      "0.5,0,0.3",
      "-o",
      at("table.csv"),
    ]);
    expect(made.lines[0]).toMatchObject({ kind: "demonstration", hand: "Ana", samples: 101, dropped: 1, grips: 1 });
    const rows = readFileSync(at("table.csv"), "utf8").trim().split("\n");
    expect(rows[0]).toContain("vx_mps,vy_mps,vz_mps");
    expect(Number(rows.at(-1)!.split(",")[1])).toBeCloseTo(0.75, 6);
  }, 30_000);

  test("what cannot be done is one sentence: no table, no corners, no profile, a way out of reach", () => {
    const shown = table("expert.csv");
    writeFileSync(at("empty.csv"), "");
    const said = (...args: string[]): readonly [number, string] => {
      const { code, err } = twincell(["demonstrate", ...args]);
      return [code, err];
    };
    const robot = ["--robot", "kuka_kr6r900sixx", "-o", at("x.json")];
    expect(said(at("empty.csv"), ...robot)).toEqual([2, `twincell: ${at("empty.csv")}: line 1: The table is empty.\n`]);
    expect(said(shown, ...robot, "--pallet", "0,0,0", "--rows", "1", "--columns", "1")[1]).toContain(
      "three are needed",
    );
    expect(said("raw", shown, "-o", at("x.csv"))[1]).toContain("--hand PROFILE is missing");
    expect(said(shown, "--robot", "abb_irb120", "-o", at("y.json"), "--curves", "wild")[1]).toContain(
      'There are no "wild" curves',
    );
  }, 30_000);
});
