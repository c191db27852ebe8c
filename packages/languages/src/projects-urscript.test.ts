/*
 * Scripts as PolyScope exports them and as people put them into its programs. Written for these tests; what the robot
 * does is worked out by hand: degrees of the joints, millimetres in the cell (the base of the script turned by 180°),
 * and the order of lines and motions.
 */
import { robotById } from "@twincell/core";
import { expect, test } from "vitest";
import { urScript } from "./index.ts";
import { told } from "./testing/told.ts";

const robot = robotById("ur10e")!;
const run = (files: Parameters<typeof told>[2], inputs?: Parameters<typeof told>[3]): ReturnType<typeof told> =>
  told(urScript, robot, files, inputs);
const HOME = "[0.1,-1.5,1.4,-1.5,-1.5,0.0]";
const HOME_DEG = "5.73 -85.944 80.214 -85.944 -85.944 0";

test("a pick loop with functions, shifted poses, one-line decisions and a line that is waited for", () => {
  const { does } = run(
    {
      "pick.script": [
        "def pick():",
        "  # Stückliste",
        `  home = ${HOME}`,
        "  def above(p_at, up=0.05):",
        "    return pose_add(p_at, p[0,0,up,0,0,0])",
        "  end",
        "  def grip(close):",
        "    if close: set_standard_digital_out(1, True) else: set_standard_digital_out(1, False) end",
        "    sleep(0.2)",
        "  end",
        "  movej(home, a=1.4, v=1.0)",
        "  i = 0",
        "  while i < 3:",
        "    i = i + 1",
        "    if i == 2: continue end",
        "    place = p[0.5 + 0.1 * i, 0.1, 0.3, 3.14, 0, 0]",
        "    movel(above(place), v=0.2, r=0.01)",
        "    movel(place, v=0.1)",
        "    grip(i == 1)",
        "    if get_standard_digital_in(4):",
        "      break",
        "    elif i > 5:",
        "      halt",
        "    end",
        "  end",
        "  while (not get_standard_digital_in(5)): sync() end",
        "  movej(home)",
        "end",
      ],
    },
    { standard_in_5: true },
  );
  expect(does).toEqual([
    `ptp q ${HOME_DEG}`,
    "lin -600 -100 350 in world within 10",
    "lin -600 -100 300 in world",
    expect.stringMatching(/= true$/),
    "wait 0.2 s",
    "lin -800 -100 350 in world within 10",
    "lin -800 -100 300 in world",
    expect.stringMatching(/= false$/),
    "wait 0.2 s",
    expect.stringMatching(/^wait for .*"is":true/),
    `ptp q ${HOME_DEG}`,
  ]);
});

test("a script file of a program: points of the program are left out and named, its conditions are inputs given by hand", () => {
  const files = (...lines: string[]): Parameters<typeof told>[2] => ({ "node.script": lines });
  const lines = [
    "movej(Waypoint_1_q)",
    "if part_here:",
    `  movej(${HOME})`,
    "end",
    "if door == False:",
    "  set_standard_digital_out(2, True)",
    "end",
  ];
  const off = run(files(...lines));
  expect(off.does).toEqual([expect.stringMatching(/= true$/)]);
  expect(off.notes).toEqual([
    "node.script 1: The motion to Waypoint_1_q is left out: no file that is open gives the point. The robot goes on to the next point from where it is.",
    'node.script 2: "part_here" gets its value in no file that is open: it counts as an input, off until it is given by hand.',
    'node.script 5: "door" gets its value in no file that is open: it counts as an input, off until it is given by hand.',
  ]);
  expect(run(files(...lines), { part_here: true, door: true }).does).toEqual([`ptp q ${HOME_DEG}`]);
  expect(run(files("movej(Waypoint_1_q)", "movel(pose_add(get_actual_tcp_pose(), p[0,0,0.1,0,0,0]))")).does[0]).toMatch(
    /^node\.script 2: The robot was to be at a point that no open file gives\./,
  );
  expect(run(files("n = lot + 1")).does).toEqual(['node.script 1: "lot" has no value yet.']);
});

test("a program that wants arguments is not run by itself; called by another file of the project it is", () => {
  const part = ["def approach(x):", "  movel(p[x, 0.2, 0.3, 3.14, 0, 0])", "end"];
  const alone = run({ "approach.script": part });
  expect(alone.does).toEqual([]);
  expect(alone.notes).toEqual([
    "approach.script 2: The program wants to be given x: it is not run by itself. Open it with the program that calls it.",
  ]);
  const whole = run({
    "main.script": [`movej(${HOME})`, "approach(0.7)"],
    "approach.script": part,
    "other.script": ["this is no script"],
  });
  expect(whole.does).toEqual([`ptp q ${HOME_DEG}`, "lin -700 -200 300 in world"]);
});

test("what the controller follows in real time, and what another machine answers, decides no motion", () => {
  const files = (...lines: string[]): Parameters<typeof told>[2] => ({ "a.script": lines });
  expect(run(files("speedl([0,0,0.1,0,0,0], 0.5, 0.1)")).does[0]).toMatch(
    /^a\.script 1: speedl is followed in real time/,
  );
  expect(run(files("n = socket_read_ascii_float(2)", "if n[0] > 1:", `  movej(${HOME})`, "end")).does[0]).toMatch(
    /^a\.script 2: What socket_read_ascii_float answers in line 1 is not in the text\./,
  );
});
