import { seededRandom, type EmittedFile, type Executed, type Interpreted } from "@twincell/core";
import { describe, expect, test } from "vitest";
import type { ByteStream } from "../../transport/index.ts";
import { FtpLines, FtpReplies, passivePort, passiveText, programOf, readCommand } from "../codec/ftp.ts";
import { bench as openBench, HOST, shifted } from "../testing/bench.ts";

const bytes = (text: string): Uint8Array => Uint8Array.from(text, sign => sign.charCodeAt(0));

/**
 * Joint moves in radians, outputs, calls and faults of a listing: enough to show that a controller executes what it is
 * handed. TP itself is read in the apps' tests.
 */
function interpret(text: string): Interpreted {
  const lines = text.split("\n");
  const wrong = lines.findIndex(line => line.includes("nonsense"));
  if (wrong >= 0)
    return {
      kind: "not-understood",
      faults: [{ line: wrong + 1, column: 1, expected: "an instruction", sentence: "This is no instruction." }],
    };
  return {
    kind: "ready",
    context: { tools: {}, frames: {}, signals: { lamp: { kind: "digital-out", address: 7 } } },
    *run(): Generator<Executed, void> {
      for (const [i, line] of lines.entries()) {
        if (line.startsWith("/END")) return;
        if (line.includes("FAULT")) throw new Error("division by zero");
        if (line.includes("DO[7]=ON")) yield { line: i + 1, step: { id: "", type: "set", signal: "lamp", to: true } };
        if (line.startsWith("J "))
          yield {
            line: i + 1,
            step: {
              id: "",
              type: "move",
              path: "ptp",
              target: { q: line.slice(2).split(",").map(Number) },
              speed: { ratio: 1 },
              blend_m: 0,
            },
          };
      }
    },
  };
}
const listing = (...body: string[]): EmittedFile[] => [
  { name: "job.ls", text: ["/PROG  JOB", "/MN", ...body, "/END", ""].join("\n"), lines: [] },
];

const bench = (more: Parameters<typeof openBench>[0] = {}) =>
  openBench({ ...more, virtual: { ftpPort: 21, interpret, ...more.virtual } });
/** A client of FTP, byte by byte. */
async function talk({ scheduler, network }: Awaited<ReturnType<typeof bench>>, port = 21) {
  const connecting = network.connect({ host: HOST, port });
  await scheduler.elapse(0.005);
  const answer = await connecting;
  if (answer.kind === "refused") throw new Error(answer.sentence);
  const { stream } = answer;
  let text = "";
  let over = false;
  stream.onBytes(lent => {
    text += String.fromCharCode(...lent);
  });
  stream.onEnd(() => {
    over = true;
  });
  await scheduler.elapse(0.005);
  return {
    stream: stream as ByteStream,
    over: () => over,
    heard: () => text,
    async say(line: string) {
      text = "";
      stream.send(bytes(line));
      await scheduler.elapse(0.01);
      return text;
    },
  };
}

describe("FTP", () => {
  test("lines, answers, commands and the passive port are read as RFC 959 has them", () => {
    const lines = new FtpLines();
    const got: string[] = [];
    for (const piece of ["USER an", "onymous\r", "\nSTOR A B.LS\r\n\n"])
      expect(
        lines.push(bytes(piece), line => {
          got.push(line);
          return true;
        }),
      ).toBeNull();
    expect(got).toEqual(["USER anonymous", "STOR A B.LS", ""]);
    const replies = new FtpReplies();
    expect(["230-Hello", " 230 not yet", "230 in"].map(line => replies.take(line))).toEqual([
      null,
      null,
      { code: 230, text: "Hello\n 230 not yet\nin" },
    ]);
    expect([replies.take("hello"), replies.take("226 ")]).toEqual([
      "A line came that is no answer of the protocol.",
      { code: 226, text: "" },
    ]);
    expect([readCommand("stor a.ls"), readCommand("QUIT"), readCommand("?"), readCommand("")]).toEqual([
      { name: "STOR", rest: "a.ls" },
      { name: "QUIT", rest: "" },
      null,
      null,
    ]);
    expect([
      passiveText("127.0.0.5", 49_152),
      passivePort("Entering Passive Mode (127,0,0,5,192,0)"),
      passivePort("=10,0,0,1,4,1"),
      passivePort("(1,2,3,4,5)"),
      passivePort("(1,2,3,4,256,1)"),
    ]).toEqual(["Entering Passive Mode (127,0,0,5,192,0)", 49_152, 1025, NaN, NaN]);
    expect([programOf("/PROG  job_1\t  Macro\n/ATTR"), programOf("PROG a"), programOf("/PROG 1a")]).toEqual([
      "JOB_1",
      "",
      "",
    ]);
  });

  test("a listing is put, listed, read and deleted; what is none is refused by name", async () => {
    const made = await bench();
    const line = await talk(made);
    expect(line.heard()).toBe("220 Twincell virtual controller FTP server ready.\r\n");
    expect(await line.say("PASV\r\n")).toBe("530 Log in first.\r\n");
    expect(await line.say("USER anonymous\r\nPASS\r\nTYPE I\r\nPWD\r\nCWD md:\r\n")).toBe(
      '230 User logged in.\r\n230 User logged in.\r\n200 Well.\r\n257 "MD:\\" is the device.\r\n250 MD:\r\n',
    );
    const put = async (name: string, text: string): Promise<string> => {
      const data = await talk(made, passivePort(await line.say("PASV\r\n")));
      expect(await line.say(`STOR ${name}\r\n`)).toBe("150 Opening the data connection.\r\n");
      data.stream.send(bytes(text));
      data.stream.close();
      await made.scheduler.elapse(0.01);
      return line.heard().split("\r\n").at(-2)!;
    };
    expect(await put("job.ls", "/PROG  JOB\n/END\n")).toBe("226 Stored.");
    expect(await put("other.ls", "/PROG  JOB\n/END\n")).toBe("550 OTHER.LS holds the program JOB.");
    expect(await put("job.tp", "/PROG  JOB\n")).toBe("550 JOB.TP is no name of a listing (.LS).");
    expect(await put("none.ls", "hello")).toBe("550 NONE.LS does not begin with /PROG and a name.");
    const get = await talk(made, passivePort(await line.say("PASV\r\n")));
    expect(await line.say("RETR MD:\\JOB.LS\r\n")).toBe("150 Opening the data connection.\r\n226 Sent.\r\n");
    expect([get.heard(), get.over()]).toEqual(["/PROG  JOB\n/END\n", true]);
    expect(await line.say("NLST\r\n")).toBe("425 Use PASV first.\r\n");
    expect(await line.say("DELE job.ls\r\nSIZE job.ls\r\nMKD x\r\n")).toBe(
      "250 Deleted.\r\n550 There is no file JOB.LS.\r\n502 MKD is not carried out here.\r\n",
    );
    expect(await line.say("QUIT\r\n")).toBe("221 Goodbye.\r\n");
    expect(line.over()).toBe(true);
  });

  test("any bytes: no crash, the connection reset, logged once, and the next client is answered", async () => {
    const made = await bench();
    const random = seededRandom(5);
    const words = ["USER a\r\n", "PASV\r\n", "STOR ", "RETR a\r\n", "LIST\r\n", "\r\n", "STOR X.LS\r\n", "PASV"];
    for (let round = 0; round < 200; round++) {
      const line = await talk(made);
      const text = Array.from({ length: 8 }, () =>
        random() < 0.7
          ? words[Math.floor(random() * words.length)]!
          : String.fromCharCode(...Array.from({ length: 20 }, () => Math.floor(random() * 256))),
      ).join("");
      await line.say(text);
      line.stream.close();
      await made.scheduler.elapse(0.005);
    }
    const long = await talk(made);
    await long.say("A".repeat(2000));
    expect(long.over()).toBe(true);
    expect(made.log.length).toBeGreaterThan(0);
    expect(new Set(made.log).size).toBe(made.log.length);
    expect((await talk(made)).heard()).toMatch(/^220 /);
  });
});

describe("program texts", () => {
  const there = `J ${shifted(0.2).join(",")}`;

  test("are put on the controller by FTP, called, run to their end by its own interpreter, and motions go on after them", async () => {
    const { fanuc, real, ended, scheduler } = await bench();
    const moving: boolean[] = [];
    real.onSample(sample => {
      if (moving.at(-1) !== sample.moving) moving.push(sample.moving);
    });
    expect(
      await ended(
        real.runText!([...listing("DO[7]=ON", there), { name: "sub.ls", text: "/PROG  SUB\n/END\n", lines: [] }]),
      ),
    ).toEqual({ kind: "done" });
    expect(fanuc.arm.jointAngle(1)).toBeCloseTo(shifted(0.2)[0]!, 6);
    expect([fanuc.arm.signals.read("DO[7]"), fanuc.programs.names]).toEqual([true, ["JOB.LS", "SUB.LS"]]);
    await scheduler.elapse(0.1);
    expect([moving.at(-1), real.isMoving()]).toEqual([false, false]);
    expect(await ended(real.moveJoints(shifted(0)))).toEqual({ kind: "done" });
    expect(await ended(real.runText!(listing(there)))).toEqual({ kind: "done" });
  });

  test("a stop ends one on its way, while it is put there too; override 0 holds it", async () => {
    const { real, ended, scheduler } = await bench();
    const far = listing(`J ${shifted(0.8).join(",")}`);
    const running = real.runText!(far);
    await scheduler.elapse(0.3);
    expect(real.isMoving()).toBe(true);
    real.setSpeed(0);
    await scheduler.elapse(0.5);
    const held = real.jointAngles();
    await scheduler.elapse(0.5);
    expect(real.jointAngles()).toEqual(held);
    real.setSpeed(100);
    await scheduler.elapse(0.05);
    real.stop();
    expect(await ended(running)).toMatchObject({ kind: "stopped", why: { code: "controller.stopped" } });
    await scheduler.elapse(1);
    const rest = real.jointAngles();
    const second = real.runText!(far);
    await scheduler.elapse(0.001);
    real.stop();
    expect((await ended(second)).kind).toBe("stopped");
    await scheduler.elapse(1);
    expect(real.jointAngles()).toEqual(rest);
    expect(await ended(real.moveJoints(shifted(0)))).toEqual({ kind: "done" });
  });

  test("what is no listing, is not understood, faults on its way, or finds no FTP: refused or stopped with the reason", async () => {
    const { real, ended, scheduler } = await bench();
    expect(await ended(real.runText!([{ name: "a.src", text: "", lines: [] }]))).toMatchObject({
      kind: "refused",
      why: { code: "fanuc.no-listing" },
    });
    expect(await ended(real.runText!(listing("nonsense")))).toMatchObject({
      kind: "refused",
      why: {
        sentence:
          "The controller refused: the program cannot be carried out: INTP-105 JOB, line 3: This is no instruction.",
      },
    });
    expect(await ended(real.runText!(listing(there, "FAULT")))).toMatchObject({ kind: "stopped" });
    await scheduler.elapse(0.2);
    void real.reset();
    await scheduler.elapse(0.5);
    expect(await ended(real.moveJoints(shifted(0)))).toEqual({ kind: "done" });
    const deaf = await bench({ face: { ftpPort: 2121 } });
    expect(await deaf.ended(deaf.real.runText!(listing(there)))).toMatchObject({
      kind: "refused",
      why: {
        code: "fanuc.files",
        sentence: expect.stringMatching(/^The program was not put on the controller: /) as string,
      },
    });
  });
});
