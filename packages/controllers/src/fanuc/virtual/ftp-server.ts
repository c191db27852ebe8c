import type { ByteStream, Listening, Network } from "../../transport/index.ts";
import { FtpLines, lineBytes, MAX_FILE, passiveText, readCommand, type FtpCommand } from "../codec/ftp.ts";
import type { Programs } from "./programs.ts";

export interface FtpServerOptions {
  readonly network: Network;
  readonly host: string;
  readonly port: number;
  readonly programs: Programs;
  readonly log: (sentence: string) => void;
}
export interface FtpServer {
  readonly listening: Listening;
  cut(): void;
  close(): void;
}

const MOST_CLIENTS = 8;
const MOST_UNKNOWN = 20;
const MOST_LOGGED = 100;
const LETTERS = 8192;

/**
 * The files of a virtual controller: the device MD: with its programs as listings. Whoever sends what is no line is
 * logged once and cut off.
 */
export async function serveFtp(options: FtpServerOptions): Promise<FtpServer> {
  const open = new Set<() => void>();
  const logged = new Set<string>();
  const note = (sentence: string): void => {
    if (logged.size < MOST_LOGGED && !logged.has(sentence)) {
      logged.add(sentence);
      options.log(sentence);
    }
  };

  function accept(stream: ByteStream): void {
    if (open.size >= MOST_CLIENTS) {
      stream.close();
      return;
    }
    const lines = new FtpLines();
    const say = (code: number, text: string): void => {
      stream.send(lineBytes(`${code} ${text}`));
    };
    const client = session(options, say);
    const end = (): void => {
      if (open.delete(end)) {
        client.close();
        stream.close();
      }
    };
    open.add(end);
    let unknown = 0;
    stream.onEnd(end);
    stream.onBytes(lent => {
      if (!open.has(end)) return;
      const why = lines.push(lent, line => {
        const command = readCommand(line);
        const goesOn = command ? client.take(command) : (say(500, "What is that?"), ++unknown < MOST_UNKNOWN);
        if (!goesOn) end();
        return goesOn && open.has(end);
      });
      if (why) {
        note(`${stream.peer.host}: ${why} The connection is reset.`);
        end();
      }
    });
    say(220, "Twincell virtual controller FTP server ready.");
  }
  const listening = await options.network.listen({ host: options.host, port: options.port }, accept);
  const cut = (): void => {
    for (const end of [...open]) end();
  };
  return {
    listening,
    cut,
    close() {
      if (listening.kind === "listening") listening.close();
      cut();
    },
  };
}

/** One client: who it is, and the connection over which its next file goes. */
function session(
  { network, host, programs }: FtpServerOptions,
  say: (code: number, text: string) => void,
): { take(command: FtpCommand): boolean; close(): void } {
  let isIn = false;
  let isOver = false;
  let came = false;
  let route: { close(): void } | null = null;
  let data: ByteStream | null = null;
  let then: ((stream: ByteStream) => void) | null = null;

  function shut(): void {
    route?.close();
    data?.close();
    route = data = then = null;
  }
  async function passive(): Promise<void> {
    shut();
    const listening = await network.listen({ host, port: 0 }, stream => {
      if (came || isOver) {
        stream.close();
        return;
      }
      came = true;
      // The port stays open until the next one is asked for: closing it would cut what came over it.
      data = stream;
      then?.(stream);
      then = null;
    });
    if (listening.kind === "taken") {
      say(425, "No port is free.");
      return;
    }
    if (isOver) {
      listening.close();
      return;
    }
    route = listening;
    came = false;
    say(227, passiveText(host, listening.address.port));
  }
  /** As soon as the client has come to the port that it was told. */
  function overData(go: (stream: ByteStream) => void): void {
    if (!route || (came && !data)) {
      say(425, "Use PASV first.");
      return;
    }
    say(150, "Opening the data connection.");
    if (data) go(data);
    else then = go;
  }
  function store(name: string): void {
    overData(stream => {
      let text = "";
      let isFull = false;
      stream.onBytes(lent => {
        isFull ||= text.length + lent.length > MAX_FILE;
        if (!isFull)
          for (let i = 0; i < lent.length; i += LETTERS) text += String.fromCharCode(...lent.subarray(i, i + LETTERS));
      });
      stream.onEnd(() => {
        if (data !== stream) return;
        data = null;
        const why = isFull ? `a file of more than ${MAX_FILE} bytes` : programs.store(name, text);
        if (why === null) say(226, "Stored.");
        else say(550, why);
      });
    });
  }
  function send(text: string): void {
    overData(stream => {
      stream.send(Uint8Array.from(text, sign => sign.charCodeAt(0) & 255));
      stream.close();
      data = null;
      say(226, "Sent.");
    });
  }

  return {
    take({ name, rest }) {
      const file = rest
        .split(/[\\/:]/)
        .at(-1)!
        .toUpperCase();
      switch (name) {
        case "USER":
          isIn = true;
          say(230, "User logged in.");
          return true;
        case "PASS":
          isIn = true;
          say(230, "User logged in.");
          return true;
        case "QUIT":
          say(221, "Goodbye.");
          return false;
        case "NOOP":
        case "TYPE":
        case "MODE":
        case "STRU":
          say(200, "Well.");
          return true;
        case "SYST":
          say(215, "UNIX emulated by a virtual controller.");
          return true;
        default:
          break;
      }
      if (!isIn) {
        say(530, "Log in first.");
        return true;
      }
      switch (name) {
        case "PWD":
        case "XPWD":
          say(257, '"MD:\\" is the device.');
          return true;
        case "CWD":
          if (/^(md:?[\\/]?|[\\/]?)$/i.test(rest)) say(250, "MD:");
          else say(550, "There is the device MD: only.");
          return true;
        case "PASV":
          void passive();
          return true;
        case "STOR":
          store(file);
          return true;
        case "RETR": {
          const text = programs.read(file);
          if (text === undefined) say(550, `There is no file ${file}.`);
          else send(text);
          return true;
        }
        case "SIZE": {
          const text = programs.read(file);
          if (text === undefined) say(550, `There is no file ${file}.`);
          else say(213, String(text.length));
          return true;
        }
        case "DELE":
          if (programs.remove(file)) say(250, "Deleted.");
          else say(550, `There is no file ${file}.`);
          return true;
        case "NLST":
          send(programs.names.map(each => `${each}\r\n`).join(""));
          return true;
        case "LIST":
          send(
            programs.names
              .map(
                each =>
                  `-rw-rw-rw- 1 noone nogroup ${String(programs.read(each)!.length).padStart(8)} Jan  1 00:00 ${each.toLowerCase()}\r\n`,
              )
              .join(""),
          );
          return true;
        default:
          say(502, `${name} is not carried out here.`);
          return true;
      }
    },
    close() {
      isOver = true;
      shut();
    },
  };
}
