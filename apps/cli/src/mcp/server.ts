import { Fault } from "@twincell/core";
import { McpServer } from "@modelcontextprotocol/server";
import { z } from "zod";
import cli from "../../package.json" with { type: "json" };
import type { CellFolder } from "./cell-folder.ts";
import { EDIT_TOOLS } from "./edit-tools.ts";
import { PROPOSE_TOOLS } from "./propose-tools.ts";
import { READ_TOOLS } from "./read-tools.ts";
import type { Tool } from "./tool.ts";

export const TOOLS: readonly Tool[] = [...READ_TOOLS, ...EDIT_TOOLS, ...PROPOSE_TOOLS];

const INSTRUCTIONS = `Twincell: robot cells on disk, judged and repaired. SI units, radians, quaternions x y z w, z up; joints count from 1.
Write a program, ask check, follow its repairs with apply_repair until it is ok, then export it or propose it. Nothing here moves a
robot: a person does. Not a certified safety device.`;

/** What a tool says: its answer, or what is wrong in one sentence with the way out. Never throws. */
export async function answerOf(
  { run }: Tool,
  folder: CellFolder,
  asked: unknown,
): Promise<{ readonly failed: boolean; readonly answer: object }> {
  try {
    return { failed: false, answer: await run(folder, asked as never) };
  } catch (problem) {
    if (problem instanceof Fault) return { failed: true, answer: { sentence: problem.message, hint: problem.hint } };
    if (problem instanceof z.ZodError) {
      const [first] = problem.issues;
      return {
        failed: true,
        answer: { sentence: `${first?.path.join(".") ?? "input"}: ${first?.message ?? "is wrong"}`, hint: "" },
      };
    }
    return {
      failed: true,
      answer: { sentence: problem instanceof Error ? problem.message : String(problem), hint: "Please report this." },
    };
  }
}

/** An MCP server over the cells of a folder. */
export function mcpServer(folder: CellFolder): McpServer {
  const server = new McpServer({ name: "twincell", version: cli.version }, { instructions: INSTRUCTIONS });
  for (const tool of TOOLS)
    server.registerTool(
      tool.name,
      {
        title: tool.title,
        description: tool.description,
        inputSchema: tool.input,
        annotations: { readOnlyHint: tool.readOnly, destructiveHint: false, openWorldHint: false },
      },
      async (asked: unknown) => {
        const { failed, answer } = await answerOf(tool, folder, asked);
        return {
          content: [{ type: "text" as const, text: JSON.stringify(answer) }],
          structuredContent: answer as Record<string, unknown>,
          ...(failed ? { isError: true } : {}),
        };
      },
    );
  return server;
}
