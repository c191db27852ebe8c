import { given } from "../io/arguments.ts";
import { UseFault, type Command } from "../io/usage.ts";

export const mcpCommand: Command = {
  name: "mcp",
  summary: "the cells of a folder for an agent (Model Context Protocol)",
  usage: `twincell mcp [--folder DIR]

Speaks the Model Context Protocol on standard input and output: an agent can make and change cells and programs in DIR, have
them judged, follow the repairs, lay them out in time and export them. It moves no robot: propose_run writes a program that was
judged good, with its certificate, into DIR/proposals, and a person runs it (twincell run --on). docs/mcp.md lists the tools.

  --folder DIR    the folder with the saved cells; nothing outside of it is read or written (default .)`,
  async run(args) {
    const options = given(args, { folder: { type: "string" } });
    if (options.positionals.length > 0) throw new UseFault(`mcp takes no argument "${options.positionals[0]}".`);
    const { CellFolder } = await import("../mcp/cell-folder.ts");
    const folder = await CellFolder.open(options.text("folder") ?? ".");
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
