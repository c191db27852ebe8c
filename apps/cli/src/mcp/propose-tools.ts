import { createHash } from "node:crypto";
import { readdir } from "node:fs/promises";
import { join } from "node:path";
import { checkProgram, writeCertificate } from "@twincell/core";
import { z } from "zod";
import { writeWhole } from "../io/output.ts";
import { UseFault } from "../io/usage.ts";
import { cellFile, programName } from "./inputs.ts";
import { tool, type Tool } from "./tool.ts";

const FOLDER = "proposals";

export const PROPOSE_TOOLS: readonly Tool[] = [
  tool({
    name: "propose_run",
    title: "Propose a program for a real robot",
    description:
      "Judges a program in its whole cell and, where nothing is bad, writes it with its certificate into the folder proposals. It moves nothing: a person looks at it and runs it, with the lease and the enabling switch in the person's own hand. A program with a bad step is refused.",
    input: z.object({ cell: cellFile, program: programName, why: z.string().min(1).max(1000) }),
    readOnly: false,
    run: async (folder, asked) => {
      const { program, robot, cell } = await folder.program(asked.cell, asked.program);
      const { verdict, certificate } = checkProgram(program, robot, { cell, certify: true });
      const bad = verdict.steps.find(step => step.verdict !== "ok" && step.verdict !== "warn");
      if (!verdict.ok || bad !== undefined || certificate === undefined)
        throw new UseFault(
          `${program.name} is not proposed: ${bad?.findings[0]?.sentence ?? "not every step could be judged."}`,
          "Ask check for repairs and propose it again.",
        );
      const text = `${JSON.stringify(program, null, 2)}\n`;
      // The same program in the same cell is the same proposal.
      const id = createHash("sha256").update(text).update(writeCertificate(certificate)).digest("hex").slice(0, 12);
      await writeWhole(join(folder.root, FOLDER), [
        { name: `${id}.program.json`, text },
        { name: `${id}.certificate.json`, text: writeCertificate(certificate) },
        {
          name: `${id}.proposal.json`,
          text: `${JSON.stringify({ id, cell: asked.cell, program: program.name, why: asked.why, duration_s: verdict.duration_s, clearance_m: verdict.clearance_m }, null, 2)}\n`,
        },
      ]);
      return {
        proposal: id,
        duration_s: verdict.duration_s,
        clearance_m: verdict.clearance_m,
        next: [
          `A person proves it again: twincell check ${FOLDER}/${id}.program.json --cell ${asked.cell} --verify ${FOLDER}/${id}.certificate.json`,
          `A person runs it: twincell run ${FOLDER}/${id}.program.json --on HOST`,
        ],
      };
    },
  }),
  tool({
    name: "proposals",
    title: "What was proposed",
    description: "The programs that wait in the folder proposals for a person.",
    input: z.object({}),
    readOnly: true,
    run: async folder => {
      const names = await readdir(join(folder.root, FOLDER)).catch(() => []);
      return {
        proposals: names
          .filter(name => name.endsWith(".proposal.json"))
          .map(name => name.slice(0, -".proposal.json".length)),
      };
    },
  }),
];
