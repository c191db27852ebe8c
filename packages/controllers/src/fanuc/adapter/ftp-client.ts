import type { Scheduler } from "@twincell/core";
import type { Address, ByteStream, Network } from "../../transport/index.ts";
import { FtpLines, FtpReplies, lineBytes, passivePort, type FtpReply } from "../codec/ftp.ts";

export interface FtpOptions {
  readonly network: Network;
  readonly scheduler: Scheduler;
  readonly to: Address;
  readonly user: string;
  readonly password: string;
}
export interface FtpFile {
  readonly name: string;
  readonly bytes: Uint8Array;
}

/** An answer that does not come within this time never comes [s]. */
const PATIENCE_S = 10;
const LOOK_S = 0.05;

/** Puts files on a controller over a connection of their own, one after the other. Null, or why it did not work. */
export async function putFiles(options: FtpOptions, files: readonly FtpFile[]): Promise<string | null> {
  const { network, to } = options;
  const connected = await network.connect(to);
  if (connected.kind === "refused") return connected.sentence;
  const line = talk(connected.stream, options.scheduler);
  try {
    return await transfer(line, options, files);
  } finally {
    line.close();
  }
}

async function transfer(
  line: Talk,
  { network, to, user, password }: FtpOptions,
  files: readonly FtpFile[],
): Promise<string | null> {
  const greeting = await line.reply();
  if (greeting.code !== 220) return wrong("The greeting", greeting);
  let login = await line.ask(`USER ${user}`);
  if (login.code === 331) login = await line.ask(`PASS ${password}`);
  if (login.code !== 230) return wrong(`Logging in as ${user}`, login);
  const type = await line.ask("TYPE I");
  if (type.code !== 200) return wrong("Choosing plain bytes", type);
  for (const { name, bytes } of files) {
    const passive = await line.ask("PASV");
    const port = passive.code === 227 ? passivePort(passive.text) : NaN;
    if (!(port > 0)) return wrong("Asking for a passive connection", passive);
    const data = await network.connect({ host: to.host, port });
    if (data.kind === "refused") return data.sentence;
    const begun = await line.ask(`STOR ${name}`);
    if (begun.code !== 150 && begun.code !== 125) {
      data.stream.close();
      return wrong(`Storing ${name}`, begun);
    }
    data.stream.send(bytes);
    data.stream.close();
    const stored = await line.reply();
    if (stored.code !== 226 && stored.code !== 250) return wrong(`Storing ${name}`, stored);
  }
  await line.ask("QUIT");
  return null;
}
const wrong = (what: string, { code, text }: FtpReply): string =>
  code === 0 ? text : `${what}: the controller answered "${code} ${text.slice(0, 200)}".`;

interface Talk {
  reply(): Promise<FtpReply>;
  ask(command: string): Promise<FtpReply>;
  close(): void;
}
/** Answers in the order in which they come; code 0 when none comes any more, with the reason. */
function talk(stream: ByteStream, scheduler: Scheduler): Talk {
  const lines = new FtpLines();
  const replies = new FtpReplies();
  const came: FtpReply[] = [];
  let waiting: ((reply: FtpReply) => void) | null = null;
  let over: string | null = null;
  let since_s = 0;
  const end = (sentence: string): void => {
    over ??= sentence;
    stream.close();
    stop();
    waiting?.({ code: 0, text: over });
    waiting = null;
  };
  const stop = scheduler.every(LOOK_S, () => {
    if (waiting && scheduler.now_s() - since_s > PATIENCE_S)
      end(`The controller did not answer within ${PATIENCE_S} s.`);
  });
  stream.onEnd(({ sentence }) => {
    end(sentence);
  });
  stream.onBytes(lent => {
    const why = lines.push(lent, line => {
      const reply = replies.take(line);
      if (typeof reply === "string") {
        end(reply);
        return false;
      }
      if (reply === null) return true;
      if (waiting) {
        const give = waiting;
        waiting = null;
        give(reply);
      } else if (came.push(reply) > 8) {
        end("The controller answered what nobody asked.");
        return false;
      }
      return true;
    });
    if (why) end(why);
  });
  const reply = (): Promise<FtpReply> =>
    new Promise(resolve => {
      const next = came.shift();
      if (next) {
        resolve(next);
        return;
      }
      if (over !== null) {
        resolve({ code: 0, text: over });
        return;
      }
      since_s = scheduler.now_s();
      waiting = resolve;
    });
  return {
    reply,
    ask(command) {
      stream.send(lineBytes(command));
      return reply();
    },
    close() {
      over ??= "The connection was closed here.";
      stop();
      stream.close();
    },
  };
}
