/**
 * The file transfer protocol as far as a controller's files need it (RFC 959): lines ended by CR LF over one
 * connection, the bytes of a file over another one that the client opens where PASV told it to.
 */
export const FTP_PORT = 21;
/** Longest line, and lines of one answer, that are taken. */
const LONGEST = 1024;
const MOST_LINES = 100;
/** Bytes of a file. */
export const MAX_FILE = 4_000_000;

export interface FtpReply {
  readonly code: number;
  readonly text: string;
}

/** Cuts a stream into lines, however it arrives, and holds at most one of them. */
export class FtpLines {
  private line = "";
  /** @returns why the stream cannot go on, or null. Saying false from `onLine` ends the reading. */
  push(lent: Uint8Array, onLine: (line: string) => boolean): string | null {
    for (const byte of lent) {
      if (byte === 10) {
        const line = this.line.endsWith("\r") ? this.line.slice(0, -1) : this.line;
        this.line = "";
        if (!onLine(line)) return null;
        continue;
      }
      if (byte === 0 || byte === 255) return "A byte came that stands in no line of the protocol.";
      if (this.line.length >= LONGEST) return `A line of more than ${LONGEST} characters came.`;
      this.line += String.fromCharCode(byte);
    }
    return null;
  }
}

/** Answers out of lines: `226 text`, or `220-text` and further lines up to one that begins with `220 `. */
export class FtpReplies {
  private open = "";
  private text: string[] = [];
  /** @returns the answer that this line ends, nothing when it goes on, or why the line is none. */
  take(line: string): FtpReply | string | null {
    const match = /^([1-5][0-9]{2})([ -])(.*)$/.exec(line);
    if (this.open === "" && !match) return "A line came that is no answer of the protocol.";
    this.text.push(match?.[3] ?? line);
    if (this.text.length > MOST_LINES) return `An answer of more than ${MOST_LINES} lines came.`;
    if (this.open === "" && match![2] === "-") {
      this.open = match![1]!;
      return null;
    }
    if (this.open !== "" && (match?.[1] !== this.open || match[2] !== " ")) return null;
    const text = this.text.join("\n");
    this.open = "";
    this.text = [];
    return { code: Number(match![1]), text };
  }
}

export interface FtpCommand {
  readonly name: string;
  readonly rest: string;
}
/** Null when the line is no command. */
export function readCommand(line: string): FtpCommand | null {
  const match = /^([A-Za-z]{3,4})(?: (.*))?$/.exec(line);
  return match ? { name: match[1]!.toUpperCase(), rest: match[2] ?? "" } : null;
}

export const passiveText = (host: string, port: number): string =>
  `Entering Passive Mode (${host.split(".").join(",")},${port >> 8},${port & 255})`;
/**
 * The port of a 227; NaN when there is none. The address is that of the controller itself: what another one says is not
 * followed.
 */
export function passivePort(text: string): number {
  const parts = /\(?((?:[0-9]{1,3},){5}[0-9]{1,3})\)?/.exec(text)?.[1]?.split(",").map(Number);
  return parts?.every(part => part <= 255) ? parts[4]! * 256 + parts[5]! : NaN;
}
export const lineBytes = (line: string): Uint8Array =>
  Uint8Array.from(`${line.replace(/[\r\n]/g, " ")}\r\n`, sign => {
    const code = sign.charCodeAt(0);
    return code < 256 ? code : 63;
  });

/** Name of the program that a listing holds, from `/PROG  NAME`; "" when it is none. */
export const programOf = (listing: string): string =>
  /^\s*\/PROG\s+([A-Za-z][A-Za-z0-9_]{0,35})\b/.exec(listing)?.[1]?.toUpperCase() ?? "";
