import { open, type FileHandle } from "node:fs/promises";
import { Writable } from "node:stream";
import { degrees } from "@twincell/core";
import cli from "../../package.json" with { type: "json" };
import { isLoopback, verdictOf, type Evidence } from "../first-motion/evidence.ts";
import { anglesText, moveFirst, pullCable, SPEED_PERCENT } from "../first-motion/protocol.ts";
import { questionsOn, type Questions } from "../first-motion/questions.ts";
import { given } from "../io/arguments.ts";
import { addressOf, AT_HELP, COMMANDER_OPTIONS, commandAt, driverOf, robotAt } from "../io/at.ts";
import { UseFault, type Command } from "../io/usage.ts";

export const firstMotionCommand: Command = {
  name: "first-motion",
  summary: "the guided first motion of a real robot, with a file of evidence",
  usage: `twincell first-motion --at CONTROLLER[:PORT] --driver D --robot R --by NAME --to FILE

Walks a person who stands at the robot through its first motion at ${SPEED_PERCENT} % speed (docs/first-motion.md): compare the angles, move each
joint by 2° and back, stop on the way, pull the cable. Every question takes yes, no or skip on standard input; no ends it at once.
What was answered and measured is written as JSON, without any address. Exit 0 when everything was answered with yes.

  --by NAME         who stands at the robot
  --to FILE         the file of evidence
${AT_HELP}
Nobody in reach, a hand on the emergency stop. Not a certified safety device.`,
  async run(args) {
    const options = given(args, { ...COMMANDER_OPTIONS, by: { type: "string" }, to: { type: "string" } });
    if (options.positionals.length > 0)
      throw new UseFault(`first-motion takes no argument "${options.positionals[0]}".`);
    const by = options.text("by");
    const to = options.text("to");
    const driver = options.text("driver");
    if (driver === undefined)
      throw new UseFault("--driver is missing.", "The first motion is made at a controller directly, not at a server.");
    if (by === undefined) throw new UseFault("--by is missing.", "Give the name of whoever stands at the robot.");
    if (to === undefined) throw new UseFault("--to is missing.", "Give a file for the evidence.");
    if (options.text("speed") !== undefined)
      throw new UseFault("--speed is not taken.", `The first motion goes at ${SPEED_PERCENT} %.`);
    const file = await newFile(to);
    const questions = questionsOn(process.stdin, terminal());
    // Ctrl-C stops the robot; it also ends a question that waits.
    const end = (): void => questions.close();
    process.once("SIGINT", end);
    try {
      const evidence = await walkThrough(options, questions, { by, driver });
      await file.writeFile(`${JSON.stringify(evidence, null, 2)}\n`);
      process.stderr.write(`\n${to}: ${evidence.verdict}.\n`);
      return evidence.verdict === "passed" ? 0 : 1;
    } finally {
      process.removeListener("SIGINT", end);
      questions.close();
      await file.close();
    }
  },
};

/** Opened before anything moves: evidence that could not be kept would have been made for nothing. */
async function newFile(path: string): Promise<FileHandle> {
  try {
    return await open(path, "wx");
  } catch (problem) {
    const there = problem instanceof Error && "code" in problem && problem.code === "EEXIST";
    throw new UseFault(
      there ? `${path} is there already.` : `${path} cannot be written: ${(problem as Error).message}.`,
      "Name another file for the evidence.",
    );
  }
}

/** Questions go where people read, and leave standard output to the outcome. */
const terminal = (): Writable =>
  new Writable({
    write(chunk: Buffer, _, done) {
      process.stderr.write(chunk, () => {
        done();
      });
    },
  });

async function walkThrough(
  options: ReturnType<typeof given>,
  questions: Questions,
  { by, driver }: { readonly by: string; readonly driver: string },
): Promise<Evidence> {
  const looking = await robotAt(options, true);
  await looking.until(() => true);
  const { info, robot } = looking;
  const alone = await questions.ask(
    "alone",
    "Nobody is in reach of the arm, its override is at 10 % or less, and a hand is on the emergency stop. Is that so?",
  );
  const angles =
    alone === "yes"
      ? await questions.ask(
          "angles",
          `${info.name} says that its joints stand at\n${anglesText(looking)}\nDoes the pendant show the same, to 0.1?`,
          { q_deg: (looking.sample?.q_rad ?? []).map(degrees) },
        )
      : "skipped";
  await looking.close();
  // Nothing moves before both were answered with yes.
  if (alone === "yes" && angles === "yes") {
    await commandAt(options, async (at, ask) => {
      await ask({ type: "hold", station: at.info.id, pressed: false });
      const outcome = await moveFirst(at, ask, questions);
      return outcome.kind === "done" ? pullCable(at, ask, questions) : outcome;
    });
  }
  return {
    format: "twincell.first-motion",
    version: 1,
    twincell: cli.version,
    by,
    made: new Date().toISOString(),
    driver,
    model: robot.id,
    virtual: isLoopback(addressOf(options, options.text("at")!, driverOf(driver)).host),
    watchdog: info.watchdog,
    verdict: verdictOf(questions.asked, robot.arm.joints.length),
    steps: questions.asked,
  };
}
