/**
 * FANUC's Remote Motion Interface (option R912): JSON objects, each ended by CR LF, over TCP. A client asks at 16001
 * for a connection, is told another port and goes there. An object is a Communication, a Command (carried out at once,
 * answered in order) or an Instruction (appended to the program RMI_MOVE, answered when it has been carried out); its
 * answer has the same key, an ErrorID and, of an instruction, its SequenceID. Angles are degrees, lengths millimetres.
 */
export const RMI_PORT = 16_001;
export const RMI_SESSION_PORT = 16_002;
/** Instructions that may wait at the controller. */
export const MAX_WAITING = 8;

/**
 * RMIT-001 is 2556929. Anchors 2556938 and 2556957 are from records of real controllers, the order of the others from
 * the list of the manual as remembered.
 */
export const RMI_ERROR = {
  ok: 0,
  override: 2556933,
  program: 2556934,
  servoOff: 2556935,
  pendant: 2556936,
  notRunning: 2556937,
  notPaused: 2556938,
  command: 2556941,
  failed: 2556942,
  instruction: 2556948,
  value: 2556949,
  position: 2556951,
  hold: 2556952,
  connected: 2556954,
  sequence: 2556957,
} as const;
const WORDS: Readonly<Record<number, string>> = {
  2556933: "the override is out of range",
  2556934: "the program cannot be carried out",
  2556935: "the servos are off",
  2556936: "the teach pendant is enabled",
  2556937: "the interface does not run",
  2556938: "the program is not paused",
  2556941: "there is no such command",
  2556942: "the command failed",
  2556948: "there is no such instruction",
  2556949: "a value does not fit",
  2556951: "the position does not fit",
  2556952: "the interface is held",
  2556954: "another client is connected",
  2556957: "the sequence number is not the next one",
};
export const rmiErrorWords = (id: number): string => WORDS[id] ?? `error ${id}`;

export type RmiKey = "Communication" | "Command" | "Instruction";
export interface RmiPacket {
  readonly key: RmiKey;
  readonly name: string;
  readonly fields: Readonly<Record<string, unknown>>;
}
const KEYS: readonly RmiKey[] = ["Communication", "Command", "Instruction"];
const LONGEST = 65_536;
const CR = 13;
const LF = 10;

export const rmiText = ({ key, name, fields }: RmiPacket): string =>
  `${JSON.stringify({ [key]: name, ...fields })}\r\n`;
export const rmiBytes = (packet: RmiPacket): Uint8Array =>
  Uint8Array.from(rmiText(packet), sign => {
    const code = sign.charCodeAt(0);
    return code < 128 ? code : 63;
  });

/** Null when it is no packet. */
export function readRmi(text: string): RmiPacket | null {
  let read: unknown;
  try {
    read = JSON.parse(text);
  } catch {
    return null;
  }
  if (typeof read !== "object" || read === null || Array.isArray(read)) return null;
  const object = read as Readonly<Record<string, unknown>>;
  const keys = KEYS.filter(key => typeof object[key] === "string");
  const key = keys[0];
  if (key === undefined || keys.length !== 1) return null;
  const { [key]: name, ...fields } = object;
  return { key, name: name as string, fields };
}

/** Cuts a stream into lines, however it arrives, and holds at most one of them. One per connection. */
export class RmiReader {
  private readonly line = new Uint8Array(LONGEST);
  private filled = 0;
  /** @returns why the stream cannot go on, or null. Saying false from `onPacket` ends the reading. */
  push(lent: Uint8Array, onPacket: (packet: RmiPacket) => boolean): string | null {
    for (const byte of lent) {
      if (byte !== LF) {
        if (this.filled >= LONGEST) return `A line of more than ${LONGEST} characters came.`;
        this.line[this.filled++] = byte;
        continue;
      }
      let end = this.filled;
      let text = "";
      this.filled = 0;
      if (end > 0 && this.line[end - 1] === CR) end--;
      for (let i = 0; i < end; i++) text += String.fromCharCode(this.line[i]!);
      if (text.trim() === "") continue;
      const packet = readRmi(text);
      if (!packet) return "A line came that is no packet of the interface.";
      if (!onPacket(packet)) return null;
    }
    return null;
  }
}

/** A field that is a finite number, else NaN. */
export function rmiNumber(fields: Readonly<Record<string, unknown>>, name: string): number {
  const value = fields[name];
  return typeof value === "number" && Number.isFinite(value) ? value : NaN;
}
/** A field that is an object, else an empty one. */
export function rmiPart(fields: Readonly<Record<string, unknown>>, name: string): Readonly<Record<string, unknown>> {
  const value = fields[name];
  return typeof value === "object" && value !== null && !Array.isArray(value)
    ? (value as Readonly<Record<string, unknown>>)
    : {};
}
/** J1 … J6 [deg] of a packet into `out`, under either name that controllers give them; false when one is missing. */
export function rmiJoints(fields: Readonly<Record<string, unknown>>, out: Float64Array): boolean {
  const joints = rmiPart(fields, "JointAngle" in fields ? "JointAngle" : "JointAngles");
  for (let i = 0; i < 6; i++) out[i] = rmiNumber(joints, `J${i + 1}`);
  return out.every(value => Number.isFinite(value));
}
export const jointPart = (j_deg: ArrayLike<number>, digits: number): Readonly<Record<string, number>> =>
  Object.fromEntries(Array.from({ length: 9 }, (_, i) => [`J${i + 1}`, Number((j_deg[i] ?? 0).toFixed(digits)) + 0]));
