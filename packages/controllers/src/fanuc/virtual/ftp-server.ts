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
  options: FtpServerOptions,
  say: (code: number, text: string) => void,
): { take(command: FtpCommand): boolean; close(): void } {
  return sessionOf(new FtpSession(options, say));
}

class FtpSession {
  readonly network: Network;
  readonly host: string;
  readonly programs: Programs;
  readonly say: (code: number, text: string) => void;
  isIn = false;
  isOver = false;
  came = false;
  route: { close(): void } | null = null;
  data: ByteStream | null = null;
  then: ((stream: ByteStream) => void) | null = null;

  constructor({ network, host, programs }: FtpServerOptions, say: (code: number, text: string) => void) {
    this.network = network;
    this.host = host;
    this.programs = programs;
    this.say = say;
  }

  shut(): void {
    this.route?.close();
    this.data?.close();
    this.route = this.data = this.then = null;
  }

  async passive(): Promise<void> {
    this.shut();
    const listening = await this.network.listen({ host: this.host, port: 0 }, stream => {
      if (this.came || this.isOver) {
        stream.close();
        return;
      }
      this.came = true;
      // The port stays open until the next one is asked for: closing it would cut what came over it.
      this.data = stream;
      this.then?.(stream);
      this.then = null;
    });
    if (listening.kind === "taken") {
      this.say(425, "No port is free.");
      return;
    }
    if (this.isOver) {
      listening.close();
      return;
    }
    this.route = listening;
    this.came = false;
    this.say(227, passiveText(this.host, listening.address.port));
  }

  /** As soon as the client has come to the port that it was told. */
  overData(go: (stream: ByteStream) => void): void {
    if (!this.route || (this.came && !this.data)) {
      this.say(425, "Use PASV first.");
      return;
    }
    this.say(150, "Opening the data connection.");
    if (this.data) go(this.data);
    else this.then = go;
  }

  store(name: string): void {
    this.overData(stream => {
      let text = "";
      let isFull = false;
      stream.onBytes(lent => {
        isFull ||= text.length + lent.length > MAX_FILE;
        if (!isFull)
          for (let i = 0; i < lent.length; i += LETTERS) text += String.fromCharCode(...lent.subarray(i, i + LETTERS));
      });
      stream.onEnd(() => {
        if (this.data !== stream) return;
        this.data = null;
        const why = isFull ? `a file of more than ${MAX_FILE} bytes` : this.programs.store(name, text);
        if (why === null) this.say(226, "Stored.");
        else this.say(550, why);
      });
    });
  }

  send(text: string): void {
    this.overData(stream => {
      stream.send(Uint8Array.from(text, sign => sign.charCodeAt(0) & 255));
      stream.close();
      this.data = null;
      this.say(226, "Sent.");
    });
  }
}

function sessionOf(own: FtpSession): { take(command: FtpCommand): boolean; close(): void } {
  return {
    take({ name, rest }) {
      const file = rest
        .split(/[\\/:]/)
        .at(-1)!
        .toUpperCase();
      switch (name) {
        case "USER":
          own.isIn = true;
          own.say(230, "User logged in.");
          return true;
        case "PASS":
          own.isIn = true;
          own.say(230, "User logged in.");
          return true;
        case "QUIT":
          own.say(221, "Goodbye.");
          return false;
        case "NOOP":
        case "TYPE":
        case "MODE":
        case "STRU":
          own.say(200, "Well.");
          return true;
        case "SYST":
          own.say(215, "UNIX emulated by a virtual controller.");
          return true;
        default:
          break;
      }
      if (!own.isIn) {
        own.say(530, "Log in first.");
        return true;
      }
      switch (name) {
        case "PWD":
        case "XPWD":
          own.say(257, '"MD:\\" is the device.');
          return true;
        case "CWD":
          if (/^(md:?[\\/]?|[\\/]?)$/i.test(rest)) own.say(250, "MD:");
          else own.say(550, "There is the device MD: only.");
          return true;
        case "PASV":
          void own.passive();
          return true;
        case "STOR":
          own.store(file);
          return true;
        case "RETR": {
          const text = own.programs.read(file);
          if (text === undefined) own.say(550, `There is no file ${file}.`);
          else own.send(text);
          return true;
        }
        case "SIZE": {
          const text = own.programs.read(file);
          if (text === undefined) own.say(550, `There is no file ${file}.`);
          else own.say(213, String(text.length));
          return true;
        }
        case "DELE":
          if (own.programs.remove(file)) own.say(250, "Deleted.");
          else own.say(550, `There is no file ${file}.`);
          return true;
        case "NLST":
          own.send(own.programs.names.map(each => `${each}\r\n`).join(""));
          return true;
        case "LIST":
          own.send(
            own.programs.names
              .map(
                each =>
                  `-rw-rw-rw- 1 noone nogroup ${String(own.programs.read(each)!.length).padStart(8)} Jan  1 00:00 ${each.toLowerCase()}\r\n`,
              )
              .join(""),
          );
          return true;
        default:
          own.say(502, `${name} is not carried out here.`);
          return true;
      }
    },
    close() {
      own.isOver = true;
      own.shut();
    },
  };
}
