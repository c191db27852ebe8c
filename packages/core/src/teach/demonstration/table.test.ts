import { expect, test } from "vitest";
import { DEMONSTRATION_COLUMNS, readDemonstration, seededRandom, writeDemonstration } from "../../index.ts";

const readable = (text: string) => {
  const answer = readDemonstration(text);
  if (answer.kind !== "demonstration") throw new Error(`${answer.line}: ${answer.sentence}`);
  return answer;
};

test("M-35 what is written has position, orientation, velocity and acceleration, and is read again", () => {
  // x = t²: v = 2 t, a = 2; a quarter turn about z in 10 s.
  const lines = Array.from({ length: 101 }, (_, i) => {
    const t = i / 10;
    const half = (t / 10) * (Math.PI / 4);
    return `${t},${t * t},0,0.5,0,0,${Math.sin(half)},${Math.cos(half)},${i > 50 ? 1 : 0}`;
  });
  const { demonstration } = readable(`# by hand\nt_s,x_m,y_m,z_m,qx,qy,qz,qw,closed\n${lines.join("\n")}\n`);
  const written = writeDemonstration(demonstration);
  const [head, ...rows] = written
    .trim()
    .split("\n")
    .map(line => line.split(","));
  expect(head).toEqual([...DEMONSTRATION_COLUMNS]);
  const column = (name: (typeof DEMONSTRATION_COLUMNS)[number], row: number): number =>
    Number(rows[row]![DEMONSTRATION_COLUMNS.indexOf(name)]);
  expect(column("vx_mps", 50)).toBeCloseTo(10, 6);
  expect(column("ax_mps2", 50)).toBeCloseTo(2, 6);
  expect(column("wz_radps", 50)).toBeCloseTo(Math.PI / 20, 6);
  expect(column("closed", 51)).toBe(1);
  const again = readable(written).demonstration;
  expect(again.times_s).toEqual(demonstration.times_s);
  expect(again.closed).toEqual(demonstration.closed);
  expect(again.worldFromTcp[40]!.position[0]).toBeCloseTo(16, 9);
});

test("milliseconds, millimetres, angles about fixed axes and other separators are read; bad lines are left out and counted", () => {
  const { demonstration, dropped } = readable(
    "t_ms;x_mm;y_mm;z_mm;rx_deg;ry_deg;rz_deg\n0;100;200;300;0;0;90\n20;101;200;300;0;0;90\n20;102;200;300;0;0;90\n40;NaN;0;0;0;0;0\n60;103;200;300;0;0;90\n",
  );
  expect(dropped).toBe(2);
  expect(demonstration.times_s).toEqual([0, 0.02, 0.06]);
  expect(demonstration.worldFromTcp[0]!.position).toEqual([0.1, 0.2, 0.3]);
  expect(demonstration.worldFromTcp[0]!.quaternion[2]).toBeCloseTo(Math.SQRT1_2, 12);
});

test("what is missing is said with its line", () => {
  expect(readDemonstration("")).toMatchObject({ kind: "unreadable", line: 1, sentence: "The table is empty." });
  expect(readDemonstration("# x\nx_m,y_m,z_m\n0,0,0")).toMatchObject({
    line: 2,
    sentence: expect.stringContaining("t_s"),
  });
  expect(readDemonstration("t_s,x_m\n0,0")).toMatchObject({
    line: 1,
    sentence: expect.stringContaining("x_mm, y_mm, z_mm"),
  });
  expect(readDemonstration("t_s,x_m,y_m,z_m\n0,0,0,0\nNaN,0,0,0\n")).toMatchObject({
    sentence: "The table holds 1 readable samples (1 left out); at least 2 show a motion.",
  });
});

test("5,000 hostile tables are read or refused with a sentence", () => {
  const random = seededRandom(11);
  const parts = [
    "t_s",
    "x_m",
    "y_m,z_m",
    ",",
    ";",
    "\n",
    "1e999",
    "-0",
    "NaN",
    "qx,qy,qz,qw",
    "#",
    "0.1",
    "\u0000",
    "é",
    "1,2,3,4",
  ];
  for (let n = 0; n < 5000; n++) {
    const text = Array.from(
      { length: Math.floor(40 * random()) },
      () => parts[Math.floor(parts.length * random())],
    ).join("");
    const answer = readDemonstration(text);
    if (answer.kind === "unreadable") expect(answer.sentence.length).toBeGreaterThan(10);
    else
      for (const { position } of answer.demonstration.worldFromTcp) expect(position.every(Number.isFinite)).toBe(true);
  }
});
