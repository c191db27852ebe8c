import { jointsOf, PlanCursor, planProgram, PlanSignals, pose, torqueAt, trackingError } from "@twincell/core";
import { given } from "../io/arguments.ts";
import { lineWriter } from "../io/json-lines.ts";
import { inputsFrom, ioOf, momentWriter, toolsBySteps } from "../io/moments.ts";
import { controlFrom, playWithPhysics, sceneFor } from "../io/physics.ts";
import { readCell, readProgram } from "../io/program.ts";
import { programRobot, ROBOT_HELP, ROBOT_OPTIONS } from "../io/robot.ts";
import { UseFault, type Command } from "../io/usage.ts";

export const simulateCommand: Command = {
  name: "simulate",
  summary: "a program laid out in time, one line per period",
  usage: `twincell simulate PROGRAM [--robot R] [--cell CELL] [--period 0.01] [--inputs part=true,level=2.5]
                  [--torque] [--within-torque] [--accuracy 0.1,0.5,1] [--physics]

Writes JSON lines {"t":s,"q":[…],"position":[…],"quaternion":[…],"io":{…},"step":ID}: joint angles and the TCP in the world,
from the start to the end of the program; how long it takes, and on what that rests, on stderr. Waits for signals take no
time, and a loop without end goes round once. A step that cannot be carried out ends it with exit 1 and a sentence.

  --robot R       the robot that moves; the one the program names when absent
  --cell CELL     where the robot stands (default: in the origin)
  --period S      seconds between two lines
  --inputs LIST   what inputs are, for the decisions of the program (default: all off, levels 0)
  --torque        adds "torque":[…] to every line: what the joints are asked for, in N m (N of a joint that slides), loads of payload
                  steps included, friction not; exit 1 with a sentence where masses or torque limits are not published
  --within-torque slows motions until every joint keeps within its torque; on stderr which, and by how much
  --accuracy LIST instead of the lines above, one for each of these shares of the planned speed: the plan driven by spring and damper
                  drives with the weight held, as {"override","duration_s","worst_m","rms_m","worstJoint_rad","saturated_s"} off the plan
  --bandwidth W   of those drives, in rad/s (default 60)
  --physics       carries the program out with contact in the cell: parts fall, are gripped by friction and carried, belts run, sensors
                  drive the inputs, waits wait. Every line has "parts":{ID:{"position","quaternion","grasp"}} and "events":[…]; exit 1 with a
                  sentence where it is paused. Same cell, program and version: the same states to the last bit, whose hash is on stderr
  --control C     of the arm with --physics: moved (as told, the default), drives, computed-torque
  --most S        with --physics: at most so many seconds (default 600)
  --lift-anything with --physics: what is too heavy for the robot is lifted all the same

${ROBOT_HELP}`,
  async run(args) {
    const options = given(args, {
      ...ROBOT_OPTIONS,
      cell: { type: "string" },
      period: { type: "string" },
      inputs: { type: "string" },
      torque: { type: "boolean" },
      "within-torque": { type: "boolean" },
      accuracy: { type: "string" },
      bandwidth: { type: "string" },
      physics: { type: "boolean" },
      control: { type: "string" },
      most: { type: "string" },
      "lift-anything": { type: "boolean" },
      json: { type: "boolean" },
    });
    const [path] = options.positionals;
    const period_s = options.number("period") ?? 0.01;
    if (path === undefined) throw new UseFault("PROGRAM is missing.", "Give the path of a program file.");
    if (!(period_s >= 1e-6)) throw new UseFault(`--period wants at least 0.000001 s, not ${period_s}.`);
    const { program, robot } = await readProgram(path, await programRobot(options));
    const cellPath = options.text("cell");
    const cell = cellPath === undefined ? undefined : await readCell(cellPath);
    const worldFromBase = cell === undefined ? pose<"world", "base">() : cell.robot.worldFromBase;

    const inputs = inputsFrom(options.text("inputs"));
    if (options.flag("physics")) {
      const scene = sceneFor(cell, robot, program, controlFrom(options.text("control"), options.number("bandwidth")));
      return playWithPhysics({
        scene,
        program,
        period_s,
        most_s: options.number("most") ?? 600,
        inputs,
        liftAnything: options.flag("lift-anything"),
      });
    }
    const answer = planProgram(program, robot, {
      worldFromBase,
      inputs,
      ...(options.flag("within-torque") ? { withinTorque: {} } : {}),
    });
    const { plan } = answer;
    const torque =
      options.flag("torque") || options.flag("within-torque")
        ? torqueAt(plan, robot, program, { worldFromBase })
        : undefined;
    if (torque?.kind === "unknown") {
      process.stderr.write(`twincell: ${torque.sentence}\n`);
      return 1;
    }
    const torqueOf = (t_s: number): { torque?: number[] } =>
      options.flag("torque") && torque?.kind === "known" ? { torque: Array.from(torque.at(t_s)) } : {};
    const overrides = options.numbers("accuracy");
    const bandwidth_rad_s = options.number("bandwidth") ?? 60;
    if (overrides !== undefined) {
      if (!overrides.every(share => share > 0 && share <= 10))
        throw new UseFault("--accuracy wants shares above 0 and up to 10.", "Such as --accuracy 0.1,0.5,1.");
      if (!(bandwidth_rad_s > 0 && bandwidth_rad_s <= 1000))
        throw new UseFault(`--bandwidth wants more than 0 and up to 1000 rad/s, not ${bandwidth_rad_s}.`);
      const tracked = trackingError(plan, robot, program, {
        worldFromBase,
        overrides,
        control: { kind: "drives", bandwidth_rad_s },
      });
      if (tracked.kind === "unknown") {
        process.stderr.write(`twincell: ${tracked.sentence}\n`);
        return 1;
      }
      for (const row of tracked.rows) process.stdout.write(`${JSON.stringify(row)}\n`);
      return answer.kind === "planned" ? 0 : 1;
    }
    const moment = momentWriter(robot, worldFromBase, program.tools, toolsBySteps(program));
    const outputs = new PlanSignals(plan);
    const io = (t_s: number, closed: boolean) => ({
      ...ioOf(closed, program.signals, new Map(Object.entries(inputs))),
      ...Object.fromEntries(outputs.at(t_s)),
    });
    const writer = lineWriter();
    const cursor = new PlanCursor(plan);
    const q = new Float64Array(jointsOf(plan) || robot.arm.joints.length);
    if (plan.segments.length === 0) q.set(robot.home_rad);
    const lines = Math.floor(plan.duration_s / period_s + 1e-9);
    for (let i = 0; i <= lines; i++) {
      const now = plan.segments.length ? cursor.at(i * period_s, q) : { gripperClosed: false, step: "" };
      writer.write({
        ...moment(i * period_s, q, io(i * period_s, now.gripperClosed), now.step),
        ...torqueOf(i * period_s),
      });
    }
    if (lines * period_s < plan.duration_s - 1e-9) {
      const now = cursor.at(plan.duration_s, q);
      writer.write({
        ...moment(plan.duration_s, q, io(plan.duration_s, now.gripperClosed), now.step),
        ...torqueOf(plan.duration_s),
      });
    }
    await writer.end();
    for (const { step, share, peak } of answer.gentled)
      process.stderr.write(
        `Step ${step} runs at ${(share * 100).toFixed(0)} % of its speed: joint ${peak.joint} would need ${Math.abs(peak.torque_Nm).toFixed(1)} N m; its limit is ${peak.limit_Nm.toFixed(1)} N m.\n`,
      );
    if (answer.kind === "planned") {
      process.stderr.write(
        `The program takes ${plan.duration_s.toFixed(2)} s.${answer.assumptions.length > 0 ? ` This rests on: ${answer.assumptions.join(" ")}` : ""}\n`,
      );
      return 0;
    }
    process.stderr.write(`twincell: Step ${answer.stuck.step}: ${answer.stuck.sentence} ${answer.stuck.hint}\n`);
    return 1;
  },
};
