import { given } from "../io/arguments.ts";
import { checkPort } from "../io/standards.ts";
import { UseFault, type Command } from "../io/usage.ts";

export const mcpCommand: Command = {
  name: "mcp",
  summary: "the cells of a folder for an agent (Model Context Protocol)",
  usage: `twincell mcp [--folder DIR] [--http PORT [--data DIR]]

Speaks the Model Context Protocol on standard input and output: an agent can make and change cells and programs in DIR, have
them judged, follow the repairs, lay them out in time and export them. It moves no robot: propose_run writes a program that was
judged good, with its certificate, into DIR/proposals, and a person runs it (twincell run --on). docs/mcp.md lists the tools.

  --folder DIR    the folder with the saved cells; nothing outside of it is read or written (default .)
  --http PORT     by streamable HTTP at http://127.0.0.1:PORT/mcp instead, on this machine alone; 0 takes a free port
  --data DIR      with --http: only who sends a token of that folder (twincell token add NAME --role programmer --data DIR)`,
  async run(args) {
    const options = given(args, {
      folder: { type: "string" },
      http: { type: "string" },
      data: { type: "string" },
    });
    if (options.positionals.length > 0) throw new UseFault(`mcp takes no argument "${options.positionals[0]}".`);
    const port = checkPort("http", options.number("http"));
    if (options.text("data") !== undefined && port === undefined)
      throw new UseFault("--data says whose tokens let in by HTTP.", "Give --http PORT too.");
    const { CellFolder } = await import("../mcp/cell-folder.ts");
    const folder = await CellFolder.open(options.text("folder") ?? ".");
    if (port !== undefined) {
      const { serveMcp } = await import("../mcp/http.ts");
      const say = (sentence: string): void => void process.stderr.write(`${sentence}\n`);
      const served = await serveMcp({ folder, port, data: options.text("data"), say });
      process.stdout.write(`MCP: ${served.url}\n`);
      await new Promise<void>(resolve => {
        for (const signal of ["SIGINT", "SIGTERM"] as const) process.once(signal, () => resolve());
      });
      await served.close();
      return 0;
    }
    const { mcpServer } = await import("../mcp/server.ts");
    const { StdioServerTransport } = await import("@modelcontextprotocol/server/stdio");
    const server = mcpServer(folder);
    const ended = new Promise<void>(resolve => {
      process.stdin.once("end", resolve);
      process.stdin.once("close", resolve);
    });
    await server.connect(new StdioServerTransport());
    await ended;
    await server.close();
    return 0;
  },
};
