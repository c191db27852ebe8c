import { createWriteStream } from "node:fs";
import { once } from "node:events";
import { given } from "../io/arguments.ts";
import { controlFrom, sceneFor } from "../io/physics.ts";
import { readCell, readProgram } from "../io/program.ts";
import { programRobot, ROBOT_HELP, ROBOT_OPTIONS } from "../io/robot.ts";
import { UseFault, type Command } from "../io/usage.ts";

export const datasetCommand: Command = {
  name: "dataset",
  summary: "demonstrations for learning: a program with contact, again and again",
  usage: `twincell dataset PROGRAM --cell CELL [--episodes 10] [--seed 1] [--jitter 0.003] [--turn 0.1] [-o FILE]

Carries the program out with physics from starts that differ and writes JSON lines: one header, then what was seen and what the
arm was told, then how each episode ended with the hash of its states. docs/dataset.md describes them. Exit 1 when no episode
came to its end.

  --episodes N  how many (default 10)
  --seed S      of the first episode; the next has S + 1. The same seed gives the same lines
  --jitter M    work pieces start up to this far from their places, along x and y (default 0)
  --turn RAD    and turned about z by up to this (default 0)
  --period S    from one sample to the next (default 0.04)
  --most S      an episode is at most this long (default 300)
  --control C   of the arm: moved (as told, the default), drives, computed-torque
  -o FILE       instead of standard output

${ROBOT_HELP}`,
  async run(args) {
    const options = given(args, {
      ...ROBOT_OPTIONS,
      cell: { type: "string" },
      episodes: { type: "string" },
      seed: { type: "string" },
      jitter: { type: "string" },
      turn: { type: "string" },
      period: { type: "string" },
      most: { type: "string" },
      control: { type: "string" },
      bandwidth: { type: "string" },
      out: { type: "string", short: "o" },
      json: { type: "boolean" },
    });
    const [path] = options.positionals;
    const cellPath = options.text("cell");
    const episodes = options.number("episodes") ?? 10;
    const period_s = options.number("period") ?? 0.04;
    if (path === undefined) throw new UseFault("PROGRAM is missing.", "Give the path of a program file.");
    if (!(Number.isInteger(episodes) && episodes >= 1))
      throw new UseFault(`--episodes wants a whole number from 1 on, not ${episodes}.`);
    if (!(period_s >= 0.002)) throw new UseFault(`--period wants at least 0.002 s, not ${period_s}.`);
    const { program, robot } = await readProgram(path, await programRobot(options));
    const scene = sceneFor(
      cellPath === undefined ? undefined : await readCell(cellPath),
      robot,
      program,
      controlFrom(options.text("control"), options.number("bandwidth")),
    );
    const { datasetLines, loadEngine } = await import("@twincell/physics");
    const file = options.text("out");
    const out = file === undefined ? process.stdout : createWriteStream(file);
    if (file !== undefined)
      await once(out, "open").catch((problem: unknown) => {
        throw new UseFault(
          `${file} cannot be written: ${problem instanceof Error ? problem.message : String(problem)}.`,
        );
      });
    let done = 0;
    let lines = 0;
    for (const line of datasetLines(await loadEngine(), scene, program, {
      episodes,
      seed: options.number("seed") ?? 1,
      period_s,
      most_s: options.number("most") ?? 300,
      jitter_m: options.number("jitter") ?? 0,
      turn_rad: options.number("turn") ?? 0,
    })) {
      if ("end" in line) {
        if (line.end === "done") done++;
        else
          process.stderr.write(
            `Episode ${line.episode}: ${line.why ?? "it was still running when its time was over."}\n`,
          );
      }
      lines++;
      if (!out.write(`${JSON.stringify(line)}\n`)) await once(out, "drain");
    }
    if (file !== undefined)
      await new Promise<void>(resolve => {
        out.end(() => {
          resolve();
        });
      });
    process.stderr.write(`${done} of ${episodes} episodes came to their end; ${lines} lines.\n`);
    return done > 0 ? 0 : 1;
  },
};
