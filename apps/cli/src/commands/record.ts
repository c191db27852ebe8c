import { existsSync, statSync } from "node:fs";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { createArchive, KEEPING, type Archive, type ArchivePort } from "@twincell/recording";
import { zstd } from "@twincell/recording/zstd";
import { newFile, recordingFolderOf, recordingsFolder, recordRemote } from "@twincell/server";
import { given } from "../io/arguments.ts";
import { robotOf, ROBOT_HELP, ROBOT_OPTIONS } from "../io/robot.ts";
import { stateLines } from "../io/state-lines.ts";
import { UseFault, type Command } from "../io/usage.ts";

const TICK_MS = 100;

export const recordCommand: Command = {
  name: "record",
  summary: "a state stream, or the stations of a server, kept as MCAP",
  usage: `twincell record --to FILE --robot R [--cell NAME] [--program NAME] [--still 0.00001]
twincell record --to FOLDER/ --from URL [--station NAME]
twincell record --to FOLDER/ --robot R [--file-hours 1] [--file-mb 64] [--keep-days 30] [--keep-gb 20]

Reads the JSON lines of simulate, run and replay, one sample each, until the end of the input or Ctrl-C, and records them: joints to
0.000001 rad, lines in and out, mode, safety, step and message where a line has them ("mode", "safety", "override", "message").
A line {"event":{"code","level","sentence"}} is kept as an event, {"load":{"torque_Nm","current_A","temperature_C"}} as what the joints carry.
With --from it records the stations of a Twincell server instead, each in a folder of its own: what they say, who commands them, and how late
the link is. A crash loses less than a second. Foxglove and ROS tools open the files.

  --to FILE       a new .mcap file; with a slash at the end, or where that folder is, a folder with one file after the other
  --from URL      a server as "serve" prints it, such as http://127.0.0.1:7341; --station NAME records that one alone
  --still BAND    rad by which the joints of a standing robot may flicker and still count as standing (default: not at all)
  --file-hours H  length of one file of the folder (default ${KEEPING.file_s / 3600}), or --file-mb MB (default ${KEEPING.file_bytes / 1e6}), whichever comes first
  --keep-days D   files that began longer ago are deleted (default ${KEEPING.keep_s / 86_400})
  --keep-gb GB    the oldest are deleted while all together weigh more (default ${KEEPING.keep_bytes / 1e9})

${ROBOT_HELP}`,
  async run(args) {
    const options = given(args, {
      ...ROBOT_OPTIONS,
      to: { type: "string" },
      cell: { type: "string" },
      program: { type: "string" },
      from: { type: "string" },
      station: { type: "string" },
      still: { type: "string" },
      "file-hours": { type: "string" },
      "file-mb": { type: "string" },
      "keep-days": { type: "string" },
      "keep-gb": { type: "string" },
      json: { type: "boolean" },
    });
    const to = options.text("to");
    if (options.positionals.length > 0)
      throw new UseFault(
        `record takes no argument "${options.positionals[0]}".`,
        "The stream comes on standard input.",
      );
    if (to === undefined)
      throw new UseFault("--to is missing.", "Give a new file, or a folder with a slash at its end.");
    const folder = /[/\\]$/.test(to) || (existsSync(to) && statSync(to).isDirectory());
    if (!folder && existsSync(to))
      throw new UseFault(`${to} is already there.`, "Give another name; recordings are not written over.");
    const positive = (name: string, otherwise: number): number => {
      const value = options.number(name) ?? otherwise;
      if (!(value > 0)) throw new UseFault(`--${name} wants more than 0, not ${value}.`);
      return value;
    };
    const still = options.number("still") ?? 0;
    if (!(still >= 0 && still < 0.01)) throw new UseFault(`--still wants 0 up to 0.01 rad, not ${still}.`);
    const keeping = folder
      ? {
          file_s: positive("file-hours", KEEPING.file_s / 3600) * 3600,
          file_bytes: positive("file-mb", KEEPING.file_bytes / 1e6) * 1e6,
          keep_s: positive("keep-days", KEEPING.keep_s / 86_400) * 86_400,
          keep_bytes: positive("keep-gb", KEEPING.keep_bytes / 1e9) * 1e9,
        }
      : { file_s: Infinity, file_bytes: Infinity, keep_s: Infinity, keep_bytes: Infinity };
    const from = options.text("from");
    if (from !== undefined) {
      if (!folder)
        throw new UseFault(
          `${to} is one file; a server may have several stations.`,
          "Give a folder, with a slash at its end.",
        );
      return fromServer(from, options.text("station"), to, still, keeping);
    }
    const { robot } = await robotOf(options);
    let begun = false;
    const single: ArchivePort = {
      list: () => Promise.resolve([]),
      read: () => Promise.resolve(new Uint8Array(0)),
      remove: () => Promise.resolve(),
      create() {
        if (begun) throw new Error("its file is full or was taken away");
        begun = true;
        return newFile(to);
      },
    };
    const archive = createArchive(folder ? recordingsFolder(to) : single, {
      robot,
      cell: options.text("cell") ?? "",
      program: options.text("program") ?? "",
      compact: { packing: await zstd(), still },
      clock_ns: () => BigInt(Date.now()) * 1_000_000n,
      keeping,
    });
    process.stderr.write(`Recording ${robot.name} to ${to}.${folder ? ` ${keptFor(keeping)}` : ""}\n`);
    const samples = await take(archive, stateLines(robot));
    if (archive.problem) {
      process.stderr.write(`twincell: ${archive.problem.sentence} ${archive.problem.hint}\n`);
      return 1;
    }
    process.stderr.write(
      `${samples} ${samples === 1 ? "sample" : "samples"} recorded${archive.deleted > 0 ? `; ${archive.deleted} old ${archive.deleted === 1 ? "file" : "files"} deleted` : ""}.\n`,
    );
    return 0;
  },
};

/** Records the stations of a server until it goes, or Ctrl-C. */
async function fromServer(
  from: string,
  only: string | undefined,
  to: string,
  still: number,
  keeping: typeof KEEPING,
): Promise<number> {
  const url = URL.canParse(from) ? new URL(from) : null;
  if (!url || !/^https?:$/.test(url.protocol))
    throw new UseFault(`--from wants the address of a server, not "${from}".`, "Such as http://127.0.0.1:7341.");
  const packing = await zstd();
  let bad = false;
  const recorder = recordRemote(url, {
    onTrouble: sentence => {
      bad = true;
      process.stderr.write(`twincell: ${sentence}\n`);
    },
    archive(station, robot) {
      if (only !== undefined && station.id !== only) return null;
      const place = join(to, recordingFolderOf(station.id));
      process.stderr.write(`Recording ${station.name} to ${place}. ${keptFor(keeping)}\n`);
      return createArchive(recordingsFolder(place), {
        robot,
        cell: station.name,
        program: "",
        compact: { packing, still },
        clock_ns: () => BigInt(Date.now()) * 1_000_000n,
        keeping,
      });
    },
  });
  const end = (): void => {
    recorder.close();
  };
  for (const signal of ["SIGINT", "SIGTERM"] as const) process.once(signal, end);
  const why = await recorder.ended;
  for (const signal of ["SIGINT", "SIGTERM"] as const) process.removeListener(signal, end);
  if (why !== null) process.stderr.write(`twincell: ${why}\n`);
  return why === null && !bad ? 0 : 1;
}

const keptFor = (keeping: typeof KEEPING): string =>
  `A new file begins every ${round(keeping.file_s / 3600)} h or ${round(keeping.file_bytes / 1e6)} MB; files go after ${round(keeping.keep_s / 86_400)} days, the oldest also when all pass ${round(keeping.keep_bytes / 1e9)} GB.`;
const round = (value: number): number => Number(value.toPrecision(3));

/** Hands line after line to the archive. A line that cannot be read ends it; what came before is kept whole. */
async function take(archive: Archive, read: ReturnType<typeof stateLines>): Promise<number> {
  const input = createInterface({ input: process.stdin, crlfDelay: Infinity });
  const end = (): void => {
    input.close();
  };
  const clock = setInterval(() => {
    void archive.tick();
  }, TICK_MS);
  for (const signal of ["SIGINT", "SIGTERM"] as const) process.once(signal, end);
  let line = 0;
  let samples = 0;
  try {
    for await (const text of input) {
      line++;
      if (text.trim() === "") continue;
      let value: unknown;
      try {
        value = JSON.parse(text);
      } catch (problem) {
        throw new UseFault(
          `Line ${line} is not JSON: ${(problem as Error).message}.`,
          `${samples} samples before it are recorded.`,
        );
      }
      const said = read(value, line);
      if (said.kind === "sample") {
        archive.record(said.sample);
        samples++;
      } else if (said.kind === "event") archive.event(said.code, said.sentence, said.level);
      else archive.note(said.note, said.what);
      if (archive.problem) break;
    }
  } finally {
    clearInterval(clock);
    for (const signal of ["SIGINT", "SIGTERM"] as const) process.removeListener(signal, end);
    archive.close();
  }
  return samples;
}
