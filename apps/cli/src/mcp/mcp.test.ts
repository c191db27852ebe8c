import {
  existsSync,
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  rmSync,
  symlinkSync,
  writeFileSync,
} from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { Client, StreamableHTTPClientTransport } from "@modelcontextprotocol/client";
import { StdioClientTransport } from "@modelcontextprotocol/client/stdio";
import { addCatalogue, checkProgram, seededRandom, type MoveStep, type Program } from "@twincell/core";
import { CATALOGUE } from "@twincell/core/catalogue";
import { saveDocument, selectedProgram, tracedCartonCell, type CellDocument } from "@twincell/project";
import { afterAll, beforeAll, beforeEach, describe, expect, test } from "vitest";
import { addToken } from "@twincell/server";
import { CellFolder } from "./cell-folder.ts";
import { serveMcp } from "./http.ts";
import { answerOf, TOOLS } from "./server.ts";
import { followRepairs } from "./testing/follow-repairs.ts";

const root = fileURLToPath(new URL("../../../../", import.meta.url));
const base = mkdtempSync(join(tmpdir(), "twincell-mcp-"));
const cells = join(base, "cells");
const carton = tracedCartonCell();
const program = selectedProgram(carton)!;
const far: MoveStep = {
  id: "far",
  type: "move",
  path: "ptp",
  speed: { ratio: 0.3 },
  blend_m: 0,
  target: { pose: { position: [1.9, 0, 0.5], quaternion: [0, 1, 0, 0] }, frame: "world", tool: "torch" },
};
const broken: CellDocument = {
  ...carton,
  programs: [{ ...program, steps: [program.steps[0]!, far, ...program.steps.slice(1)] }],
};
const OUTSIDE = "nothing of this file is for agents";

beforeAll(() => addCatalogue(CATALOGUE));
beforeEach(() => {
  rmSync(cells, { recursive: true, force: true });
  mkdirSync(cells, { recursive: true });
  writeFileSync(join(base, "outside.json"), OUTSIDE);
  writeFileSync(join(cells, "good.json"), saveDocument(carton));
  writeFileSync(join(cells, "broken.json"), saveDocument(broken));
  symlinkSync(join(base, "outside.json"), join(cells, "link.json"));
});
afterAll(() => rmSync(base, { recursive: true, force: true }));

interface Answer {
  readonly sentence?: string;
  readonly [key: string]: unknown;
}
const call = async (name: string, asked: unknown): Promise<{ failed: boolean; answer: Answer }> => {
  const tool = TOOLS.find(each => each.name === name)!;
  return (await answerOf(tool, await CellFolder.open(cells), asked)) as { failed: boolean; answer: Answer };
};

describe("twincell mcp", () => {
  test("by HTTP the same client lists the same tools and judges a program with a token; without one, with a viewer's, from another page and under another name nothing is answered", async () => {
    const data = mkdtempSync(join(tmpdir(), "twincell-mcp-data-"));
    const token = addToken(data, "agent", "programmer", null)!;
    const viewer = addToken(data, "viewer", "viewer", null)!;
    const said: string[] = [];
    const served = await serveMcp({
      folder: await CellFolder.open(cells),
      port: 0,
      data,
      say: text => said.push(text),
    });
    try {
      const client = new Client({ name: "test", version: "1" });
      const headers = { authorization: `Bearer ${token}` };
      await client.connect(new StreamableHTTPClientTransport(new URL(served.url), { requestInit: { headers } }));
      const { tools } = await client.listTools();
      expect(tools.map(({ name }) => name).toSorted()).toEqual(TOOLS.map(({ name }) => name).toSorted());
      const judged = await client.callTool({ name: "check", arguments: { cell: "good.json" } });
      expect(judged.structuredContent).toMatchObject({ verdict: { ok: true } });
      await client.close();
      const list = JSON.stringify({ jsonrpc: "2.0", id: 1, method: "tools/list" });
      const ask = async (more: Record<string, string>, path = ""): Promise<number> => {
        const { request } = await import("node:http");
        return new Promise((resolve, reject) => {
          const asked = request(new URL(served.url + path), {
            method: "POST",
            headers: { "content-type": "application/json", accept: "application/json, text/event-stream", ...more },
          });
          asked.once("error", reject);
          asked.once("response", response => {
            response.resume();
            resolve(response.statusCode!);
          });
          asked.end(list);
        });
      };
      expect(await ask(headers)).toBe(200);
      expect(await ask({})).toBe(401);
      expect(await ask({ authorization: "Bearer twincell_forged" })).toBe(401);
      expect(await ask({ authorization: `Bearer ${viewer}` })).toBe(403);
      expect(await ask({ ...headers, origin: "http://evil.example" })).toBe(403);
      expect(await ask({ ...headers, host: "evil.example" })).toBe(403);
      expect(await ask(headers, "/elsewhere")).toBe(404);
      expect(said).toEqual([]);
    } finally {
      await served.close();
    }
  });

  test("a client published by others lists the tools, repairs a program by its repairs, exports and proposes it", async () => {
    const client = new Client({ name: "test", version: "1" });
    const transport = new StdioClientTransport({
      command: process.execPath,
      args: [join(root, "apps/cli/src/main.ts"), "mcp", "--folder", cells],
      cwd: root,
    });
    await client.connect(transport);
    try {
      const { tools } = await client.listTools();
      expect(tools.map(({ name }) => name).toSorted()).toEqual(TOOLS.map(({ name }) => name).toSorted());
      const ask = async (
        name: string,
        asked: Record<string, unknown>,
      ): Promise<{ isError: boolean; answer: Answer }> => {
        const result = await client.callTool({ name, arguments: asked });
        return { isError: result.isError === true, answer: result.structuredContent as Answer };
      };
      const before = await ask("check", { cell: "broken.json" });
      expect(before.answer).toMatchObject({ verdict: { ok: false } });
      const refused = await ask("propose_run", { cell: "broken.json", why: "trace the carton" });
      expect(refused).toMatchObject({ isError: true });
      expect(refused.answer.sentence).toMatch(/^Edge trace is not proposed: .+\.$/);
      const repaired = await ask("apply_repair", { cell: "broken.json", step: "far", repair: 0 });
      expect(repaired.isError).toBe(false);
      for (let round = 0; round < 5; round++) {
        const { verdict } = (await ask("check", { cell: "broken.json" })).answer as unknown as {
          verdict: { steps: { id: string; verdict: string }[] };
        };
        const step = verdict.steps.find(each => each.verdict === "bad");
        if (!step) break;
        await ask("apply_repair", { cell: "broken.json", step: step.id, repair: 0 });
      }
      const text = await ask("export_program", { cell: "broken.json", dialect: "v-plus" });
      expect(text.isError, JSON.stringify(text.answer)).toBe(false);
      const proposal = await ask("propose_run", { cell: "broken.json", why: "trace the carton" });
      expect(proposal.isError, JSON.stringify(proposal.answer)).toBe(false);
      expect((await ask("proposals", {})).answer).toEqual({ proposals: [proposal.answer["proposal"]] });
      // The file that a person runs is the program that was judged.
      const written = JSON.parse(
        readFileSync(join(cells, "proposals", `${String(proposal.answer["proposal"])}.program.json`), "utf8"),
      ) as Program;
      const { robot, cell } = await (await CellFolder.open(cells)).program("broken.json");
      expect(checkProgram(written, robot, { cell }).verdict.ok).toBe(true);
      expect((await ask("check", { cell: "../outside.json" })).isError).toBe(true);
      expect((await ask("check", { cell: 7 })).isError).toBe(true);
    } finally {
      await client.close();
    }
  });

  test("a cell is made, a program is written into it, and what is not whole is refused with the place, the file as it was", async () => {
    expect(await call("new_cell", { cell: "new.json", robot: "ur10e", name: "Bench" })).toMatchObject({
      failed: false,
    });
    expect(await call("new_cell", { cell: "new.json", robot: "ur10e", name: "Bench" })).toMatchObject({
      failed: true,
      answer: { sentence: "new.json is there already." },
    });
    const before = readFileSync(join(cells, "new.json"), "utf8");
    const { answer } = await call("cell", { cell: "new.json" });
    const { document } = answer as unknown as { document: CellDocument };
    const empty = selectedProgram(document)!;
    const wrong = await call("write_program", {
      cell: "new.json",
      program: { ...empty, steps: [{ id: "a", type: "fly" }] },
    });
    expect(wrong.failed).toBe(true);
    expect(wrong.answer.sentence).toMatch(/steps/);
    expect(await call("write_cell", { cell: "new.json", document: { ...document, objects: [{}] } })).toMatchObject({
      failed: true,
    });
    expect(readFileSync(join(cells, "new.json"), "utf8")).toBe(before);
    const ready: MoveStep = { ...far, id: "ready", target: { q: [0, -1.2, 1.2, -1.57, -1.57, 0] } };
    const good = await call("write_program", { cell: "new.json", program: { ...empty, steps: [ready] } });
    expect(good).toMatchObject({ failed: false, answer: { ok: true, bad: [] } });
    expect(await call("timeline", { cell: "new.json" })).toMatchObject({ failed: false, answer: { complete: true } });
  });

  test("2,000 made-up calls end in an answer each, leave the files outside alone, and propose nothing that is not good", async () => {
    const random = seededRandom(20261124);
    const pick = <T>(of: readonly T[]): T => of[Math.floor(random() * of.length)]!;
    const junk: readonly unknown[] = [
      "broken.json",
      "broken.json",
      "../outside.json",
      "link.json",
      "/etc/passwd",
      "proposals/../../outside.json",
      "",
      -1,
      1e308,
      null,
      [],
      {},
      { robot: "ur10e" },
      "far",
      "Edge trace",
      "x".repeat(5000),
      "\u0000.json",
      true,
    ];
    const keys = ["cell", "program", "step", "repair", "why", "dialect", "document", "robot", "name", "id", "maker"];
    const before = readFileSync(join(cells, "broken.json"), "utf8");
    for (let i = 0; i < 2000; i++) {
      const asked = Object.fromEntries(keys.flatMap(key => (random() < 0.6 ? [[key, pick(junk)]] : [])));
      const { name } = pick(TOOLS.filter(each => each.name !== "apply_repair"));
      const { failed, answer } = await call(name, pick([asked, asked, asked, pick(junk)]));
      if (failed)
        expect(String(answer.sentence).length, `${name} ${JSON.stringify(asked).slice(0, 200)}`).toBeGreaterThan(3);
      expect(existsSync(join(cells, "proposals"))).toBe(false);
    }
    expect(readFileSync(join(base, "outside.json"), "utf8")).toBe(OUTSIDE);
    expect(readFileSync(join(cells, "broken.json"), "utf8")).toBe(before);
    expect(readdirSync(base).toSorted()).toEqual(["cells", "outside.json"]);
  });

  test("who only follows the repairs mends every program whose points were moved away, of six seeded ones", async () => {
    const { bad, mended } = await followRepairs(await CellFolder.open(cells), carton, 6, 95);
    expect(bad).toBeGreaterThanOrEqual(4);
    expect(mended).toBe(bad);
  });
});
