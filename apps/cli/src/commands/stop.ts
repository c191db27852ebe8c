import { given } from "../io/arguments.ts";
import { AT_HELP, AT_OPTIONS, greetServer, robotAt } from "../io/at.ts";
import { UseFault, type Command } from "../io/usage.ts";

/** A robot that was told to stop stands within this [s]. */
const STANDS_S = 5;

export const stopCommand: Command = {
  name: "stop",
  summary: "stop a robot, whoever moves it; all robots of a server with --all",
  usage: `twincell stop --at HOST[:PORT] [--station ID | --all] [--emergency]

Anyone may stop: no lease is asked for. Waits until the robot stands and says so as JSON; exit 1 when it still moves after ${STANDS_S} s.
At a controller (--driver) only what the controller takes from a second client can be stopped: otherwise use its pendant.

  --all             every robot of the server
  --emergency       the controller's emergency stop or drives off, where its protocol has one
${AT_HELP}
Not a certified safety device: the red button is at the robot.`,
  async run(args) {
    const options = given(args, { ...AT_OPTIONS, all: { type: "boolean" }, emergency: { type: "boolean" } });
    if (options.positionals.length > 0) throw new UseFault(`stop takes no argument "${options.positionals[0]}".`);
    const emergency = options.flag("emergency");
    if (options.flag("all")) {
      const at = options.text("at");
      if (at === undefined || options.text("driver") !== undefined)
        throw new UseFault("--all is for a server.", "Give its address with --at, without --driver.");
      const { joined } = await greetServer(options, at);
      joined.client.stop(undefined, emergency);
      // Its answer comes behind the stop.
      await joined.client.ping();
      joined.close();
      process.stdout.write(`${JSON.stringify({ stopped: "all" })}\n`);
      return 0;
    }
    const at = await robotAt(options, true);
    at.client.stop(at.info.id, emergency);
    await at.client.ping();
    const asked = at.sample?.sequence ?? -1;
    const stands = await at.until(({ moving, sequence }) => !moving && sequence !== asked, STANDS_S);
    process.stdout.write(`${JSON.stringify({ stopped: at.info.id, stands, q_rad: at.sample?.q_rad ?? null })}\n`);
    await at.close();
    if (stands) return 0;
    process.stderr.write(
      at.sample
        ? `twincell: ${at.info.name} still moves after ${STANDS_S} s. Use the red button at the robot.\n`
        : `twincell: Nothing was heard of ${at.info.name} for ${STANDS_S} s. Use the red button at the robot.\n`,
    );
    return 1;
  },
};
