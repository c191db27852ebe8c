import { catalogueRobots, checkProgram, LIBRARY, planProgram, robotById, withBranches } from "@twincell/core";
import { DIALECTS, proveText, runnableFile } from "@twincell/languages";
import { isTextProgram } from "@twincell/project";
import { z } from "zod";
import { dialectOf } from "../io/dialect.ts";
import { explained, repairSearch } from "../io/explained.ts";
import { UseFault } from "../io/usage.ts";
import { cellFile, programName } from "./inputs.ts";
import { tool, type Tool } from "./tool.ts";

/** Bad steps that one answer explains, unless more are asked for: each is a search of its own. */
const EXPLAINED = 1;

export const READ_TOOLS: readonly Tool[] = [
  tool({
    name: "robots",
    title: "Robots of the library",
    description: "Id, maker, reach [m] and number of joints of every robot model that a cell can have.",
    input: z.object({ maker: z.string().max(80).optional().describe("Only those whose maker contains this.") }),
    readOnly: true,
    run: (_folder, { maker = "" }) =>
      Promise.resolve({
        robots: [...LIBRARY, ...catalogueRobots()]
          .filter(({ vendor }) => vendor.toLowerCase().includes(maker.toLowerCase()))
          .map(({ id, name, vendor, reach_m, arm }) => ({
            id,
            name,
            maker: vendor,
            reach_m,
            joints: arm.joints.length,
          })),
      }),
  }),
  tool({
    name: "cells",
    title: "Cells of the folder",
    description: "Every saved cell of the folder: its robot, its objects and its programs.",
    input: z.object({}),
    readOnly: true,
    run: async folder => ({
      cells: (await folder.list()).map(({ file, document, why }) =>
        document
          ? {
              file,
              name: document.name,
              robot: document.robot.id,
              objects: document.objects.length,
              programs: document.programs.map(program => program.name),
              selected: document.program,
            }
          : { file, why },
      ),
    }),
  }),
  tool({
    name: "cell",
    title: "One cell",
    description:
      "A saved cell as it is: robot and where it stands, tools, objects, frames, programs with their steps. Lengths in metres, angles in radians, quaternions x y z w, z up. docs/cell.schema.json describes it.",
    input: z.object({ cell: cellFile }),
    readOnly: true,
    run: async (folder, { cell }) => ({ document: await folder.read(cell) }),
  }),
  tool({
    name: "check",
    title: "Judge a program",
    description:
      'Reach, joint limits, speeds, branches, singular postures and collision in the whole cell. The first bad step has "repair" (more with explain): why, and up to three changes, each proven by checking the whole program again; apply one with apply_repair and its place in "repairs", from 0.',
    input: z.object({
      cell: cellFile,
      program: programName,
      explain: z.int().min(0).max(20).optional().describe("Bad steps that are explained; 1 when absent."),
    }),
    readOnly: true,
    run: async (folder, asked) => {
      const { document, program, robot, cell } = await folder.program(asked.cell, asked.program);
      const checked = checkProgram(program, robot, { cell });
      const search = repairSearch(program, robot, { cell }, checked, document);
      const answer = explained(checked, search, asked.explain ?? EXPLAINED);
      return { program: program.name, verdict: answer.verdict, notExplained: answer.leftOut };
    },
  }),
  tool({
    name: "timeline",
    title: "When each step happens",
    description:
      "Start and duration [s] of every step of a program, as the virtual robot carries it out, and its end posture.",
    input: z.object({ cell: cellFile, program: programName }),
    readOnly: true,
    run: async (folder, asked) => {
      const { program, robot, cell } = await folder.program(asked.cell, asked.program);
      const { plan, kind } = planProgram(program, robot, { worldFromBase: cell.worldFromBase });
      return {
        program: program.name,
        complete: kind === "planned",
        duration_s: plan.duration_s,
        segments: plan.segments.map(segment => ({
          step: segment.step,
          kind: segment.kind,
          start_s: segment.start_s,
          duration_s: segment.duration_s,
          end_rad: Array.from(segment.q_rad.slice(-robot.arm.joints.length)),
        })),
      };
    },
  }),
  tool({
    name: "export_program",
    title: "The program in a controller's own language",
    description: `The files of a program in one of ${DIALECTS.map(({ id }) => id).join(", ")}. The text is executed by the dialect's interpreter and compared with the plan first; one that does not say the same is refused.`,
    input: z.object({ cell: cellFile, program: programName, dialect: z.string().max(40) }),
    readOnly: true,
    run: async (folder, asked) => {
      const dialect = dialectOf("dialect", asked.dialect);
      const { program: taught, robot, cell } = await folder.program(asked.cell, asked.program);
      const { worldFromBase } = cell;
      const program = withBranches(taught, robot, { where: "needed", worldFromBase });
      const emitted = dialect.emit(program, robot, worldFromBase);
      if (emitted.kind === "cannot")
        throw new UseFault(`${emitted.step ? `Step ${emitted.step}: ` : ""}${emitted.sentence}`, emitted.hint);
      const runnable = runnableFile(dialect, emitted.files);
      const proof = runnable && proveText(dialect, runnable, program, robot, worldFromBase);
      if (proof && proof.kind !== "proven") throw new UseFault(proof.sentence, "Nothing was exported.");
      return { dialect: dialect.id, files: emitted.files, warnings: emitted.warnings };
    },
  }),
  tool({
    name: "robot",
    title: "One robot model",
    description:
      "Joints with limits [rad, rad/s, rad/s²; m where they slide], home posture and reach of a robot model.",
    input: z.object({ id: z.string().max(120) }),
    readOnly: true,
    run: (_folder, { id }) => {
      const robot = robotById(id);
      if (!robot) throw new UseFault(`The library has no robot called "${id}".`, "See the tool robots.");
      const { name, vendor, reach_m, home_rad, arm } = robot;
      return Promise.resolve({
        id,
        name,
        maker: vendor,
        reach_m,
        home_rad,
        joints: arm.joints.map(({ kind, limits }) => ({ kind, ...limits })),
      });
    },
  }),
  tool({
    name: "texts",
    title: "Vendor texts of a cell",
    description: "The programs of a cell that are a controller's own text, with their language and files.",
    input: z.object({ cell: cellFile }),
    readOnly: true,
    run: async (folder, { cell }) => ({
      texts: (await folder.read(cell)).programs.filter(isTextProgram),
    }),
  }),
];
