import { robotById, type CommandOutcome } from "@twincell/core";
import type { Request } from "@twincell/protocol";
import { saveConnection } from "@twincell/server";
import { isAbsolute, relative, dirname, resolve } from "node:path";
import { given, type Given } from "../io/arguments.ts";
import { addressOf, AT_HELP, AT_OPTIONS, driverOf, greetServer, robotAt } from "../io/at.ts";
import { readCell } from "../io/program.ts";
import { UseFault, type Command } from "../io/usage.ts";

export const connectCommand: Command = {
  name: "connect",
  summary: "open a robot at a server, or try whether a controller can be reached",
  usage: `twincell connect ID --at SERVER[:PORT] --driver D --robot R [--address HOST[:PORT]] [--cell CELL] [--watch] [--save FILE]
       twincell connect ID --at SERVER[:PORT] --close
       twincell connect --at CONTROLLER[:PORT] --driver D --robot R

With an ID it opens a robot of that name at a server and connects it; it stays open when the command ends. Without --address the server
starts a virtual controller of that maker. Without an ID it goes to a controller, says what it hears of it as one JSON line, and leaves.

  --address H[:P]   where the controller is, as seen from the server
  --watch           only to look at: nothing is commanded until somebody takes it
  --close           stops and closes that robot
  --save FILE       also keeps it in a file of connections, which serve --connections FILE opens again when it starts
${AT_HELP}`,
  async run(args) {
    const options = given(args, {
      ...AT_OPTIONS,
      address: { type: "string" },
      watch: { type: "boolean" },
      close: { type: "boolean" },
      save: { type: "string" },
    });
    const [id, more] = options.positionals;
    if (more !== undefined) throw new UseFault(`connect takes one ID, not "${more}" as well.`);
    if (id !== undefined) return atServer(options, id);
    for (const name of ["address", "save"])
      if (options.text(name) !== undefined) throw new UseFault(`--${name} is for a robot with an ID, at a server.`);
    if (options.text("driver") === undefined)
      throw new UseFault("--driver is missing.", "Or give an ID, to open the robot at a server.");
    const at = await robotAt(options, true);
    const heard = await at.until(() => true);
    const { name, brand, robot, virtual, watchdog } = at.info;
    const { sample } = at;
    await at.close();
    if (!heard || !sample) {
      process.stderr.write(`twincell: ${name} said nothing.\n`);
      return 1;
    }
    const { q_rad, mode, safety, moving, override } = sample;
    process.stdout.write(
      `${JSON.stringify({ name, driver: brand, model: robot, virtual, watchdog, mode, safety, moving, override, q_rad })}\n`,
    );
    return 0;
  },
};

async function atServer(options: Given, id: string): Promise<number> {
  const at = options.text("at");
  if (at === undefined) throw new UseFault("--at is missing.", "Give the server's HOST[:PORT].");
  const request = options.flag("close") ? null : await openRequest(options, id);
  const { joined } = await greetServer(options, at);
  let outcome: CommandOutcome = { kind: "done" };
  const requests: Request[] = request ? [request, { type: "connect", station: id }] : [{ type: "close", station: id }];
  for (const each of requests) {
    outcome = await joined.client.ask(each);
    if (outcome.kind !== "done") break;
  }
  joined.close();
  process.stdout.write(`${JSON.stringify(outcome)}\n`);
  if (outcome.kind !== "done") {
    process.stderr.write(`twincell: ${outcome.why.sentence} ${outcome.why.hint}\n`);
    return 1;
  }
  const file = options.text("save");
  if (file !== undefined && request) {
    const { brand, robot, address, watch } = request;
    const cell = options.text("cell");
    saveConnection(file, {
      id,
      driver: brand,
      model: robot,
      ...(address ? { address: { host: address.host, ...(address.ports ? { ports: address.ports } : {}) } } : {}),
      ...(cell === undefined
        ? {}
        : { cell: isAbsolute(cell) ? cell : relative(dirname(resolve(file)), resolve(cell)) }),
      ...(watch === undefined ? {} : { watch }),
    });
  }
  return 0;
}

async function openRequest(options: Given, id: string): Promise<Extract<Request, { readonly type: "open" }>> {
  const driver = driverOf(options.text("driver") ?? missing("driver"));
  const model = options.text("robot") ?? missing("robot");
  if (!robotById(model)) throw new UseFault(`There is no robot "${model}".`, "See twincell robots.");
  const address = options.text("address");
  const cell = options.text("cell");
  return {
    type: "open",
    station: id,
    brand: driver.id,
    robot: model,
    ...(address === undefined ? {} : { address: addressOf(options, address, driver) }),
    ...(cell === undefined ? {} : { cell: await readCell(cell) }),
    ...(options.flag("watch") ? { watch: true } : {}),
  };
}

function missing(name: string): never {
  throw new UseFault(`--${name} is missing.`);
}
