import { given } from "../io/arguments.ts";
import { AT_HELP, AT_OPTIONS, robotAt } from "../io/at.ts";
import { lineWriter } from "../io/json-lines.ts";
import { UseFault, type Command } from "../io/usage.ts";

/** Lines wait no longer than this before they are written [ms]. */
const FLUSH_MS = 50;

export const watchCommand: Command = {
  name: "watch",
  summary: "what a robot says, one JSON line each",
  usage: `twincell watch --at HOST[:PORT] [--samples N] [--for S] [--period S] [--only sample,link,guard,notice,act]

Writes {"type":"sample","time_s","q_rad":[…],"moving","mode","safety",…}, and what is said of link, guard and commands, as the protocol has
it, until Ctrl-C. Nothing is commanded; whoever moves the robot is left alone.

  --samples N       ends after so many samples
  --for S           ends after so many seconds
  --period S        samples no nearer to each other than this, on the controller's clock
  --only TYPES      only messages of these types
${AT_HELP}`,
  async run(args) {
    const options = given(args, {
      ...AT_OPTIONS,
      samples: { type: "string" },
      for: { type: "string" },
      period: { type: "string" },
      only: { type: "string" },
    });
    if (options.positionals.length > 0) throw new UseFault(`watch takes no argument "${options.positionals[0]}".`);
    const most = options.number("samples") ?? Infinity;
    const for_s = options.number("for");
    const period_s = options.number("period") ?? 0;
    if (!(most >= 1)) throw new UseFault(`--samples wants 1 or more, not ${most}.`);
    if (for_s !== undefined && !(for_s > 0)) throw new UseFault(`--for wants more than 0 s, not ${for_s}.`);
    if (!(period_s >= 0)) throw new UseFault(`--period wants 0 s or more, not ${period_s}.`);
    const only = options.text("only")?.split(",");
    const at = await robotAt(options, true);
    const writer = lineWriter();
    let samples = 0;
    let last_s = -Infinity;
    const why = await new Promise<string | null>(resolve => {
      const flush = setInterval(() => {
        writer.flush();
      }, FLUSH_MS);
      const ends: (() => void)[] = [];
      const end = (sentence: string | null): void => {
        for (const each of ends.splice(0)) each();
        resolve(sentence);
      };
      const done = (): void => {
        end(null);
      };
      const timer = for_s === undefined ? undefined : setTimeout(done, for_s * 1000);
      for (const signal of ["SIGINT", "SIGTERM"] as const) process.once(signal, done);
      const off = at.onTold(message => {
        if (!("station" in message) || message.station !== at.info.id) return;
        if (message.type === "closed") {
          end(`${at.info.name} was closed.`);
          return;
        }
        if (only && !only.includes(message.type)) return;
        if (message.type === "sample") {
          if (message.time_s - last_s < period_s) return;
          last_s = message.time_s;
          samples++;
        }
        writer.write(message);
        if (samples >= most) end(null);
      });
      ends.push(off, () => {
        clearInterval(flush);
        clearTimeout(timer);
        for (const signal of ["SIGINT", "SIGTERM"] as const) process.removeListener(signal, done);
      });
      void at.ended.then(sentence => {
        if (sentence !== null) end(sentence);
      });
    });
    await writer.end();
    await at.close();
    if (why === null) return 0;
    process.stderr.write(`twincell: ${why}\n`);
    return 1;
  },
};
