/** Types of Sparkplug B (Eclipse Sparkplug 3.0, section 6.4.16) that are said here. */
export const SPARKPLUG_TYPES = { Int64: 4, Double: 10, Boolean: 11, String: 12 } as const;
export interface Metric {
  /** Left out in data where the birth said it with an alias. */
  readonly name?: string;
  readonly alias?: number;
  readonly type: keyof typeof SPARKPLUG_TYPES;
  readonly value: number | boolean | string;
}
export interface Payload {
  readonly timestamp_ms: number;
  readonly metrics: readonly Metric[];
  /** Left out in NDEATH alone. */
  readonly seq?: number;
}

const VARINT = 0;
const FIXED64 = 1;
const BYTES = 2;

function varint(value: number | bigint): number[] {
  const out: number[] = [];
  let rest = BigInt.asUintN(64, BigInt(value));
  while (rest > 127n) {
    out.push(Number(rest & 127n) | 128);
    rest >>= 7n;
  }
  out.push(Number(rest));
  return out;
}
const field = (number: number, kind: number): number[] => varint((number << 3) | kind);
const whole = (number: number, value: number | bigint): number[] => [...field(number, VARINT), ...varint(value)];
const bytes = (number: number, value: Uint8Array | readonly number[]): number[] => [
  ...field(number, BYTES),
  ...varint(value.length),
  ...value,
];
function double(number: number, value: number): number[] {
  const out = Buffer.alloc(8);
  out.writeDoubleLE(value);
  return [...field(number, FIXED64), ...out];
}

function valueOf({ type, value }: Metric): number[] {
  switch (type) {
    case "Int64":
      return whole(11, BigInt(Math.trunc(Number(value))));
    case "Double":
      return double(13, Number(value));
    case "Boolean":
      return whole(14, value === true ? 1 : 0);
    case "String":
      return bytes(15, Buffer.from(String(value), "utf8"));
  }
}

/** The message `org.eclipse.tahu.protobuf.Payload` (protobuf, proto2). */
export function encodePayload({ timestamp_ms, metrics, seq }: Payload): Buffer {
  const out = whole(1, Math.trunc(timestamp_ms));
  for (const metric of metrics)
    out.push(
      ...bytes(2, [
        ...(metric.name === undefined ? [] : bytes(1, Buffer.from(metric.name, "utf8"))),
        ...(metric.alias === undefined ? [] : whole(2, metric.alias)),
        ...whole(3, Math.trunc(timestamp_ms)),
        ...whole(4, SPARKPLUG_TYPES[metric.type]),
        ...valueOf(metric),
      ]),
    );
  if (seq !== undefined) out.push(...whole(3, seq));
  return Buffer.from(out);
}

/** Whether a command asks for all births again: a metric `Node Control/Rebirth` that is true. */
export function asksForRebirth(payload: Uint8Array): boolean {
  return fieldsOf(payload).some(({ number, value }) => {
    if (number !== 2 || typeof value === "bigint") return false;
    const parts = fieldsOf(value);
    const name = parts.find(part => part.number === 1)?.value;
    const said = parts.find(part => part.number === 14)?.value;
    return name instanceof Uint8Array && Buffer.from(name).toString("utf8") === "Node Control/Rebirth" && said === 1n;
  });
}

interface Field {
  readonly number: number;
  readonly value: bigint | Uint8Array;
}
/** Fields of a protobuf message, as far as they can be read. */
function fieldsOf(message: Uint8Array): readonly Field[] {
  const out: Field[] = [];
  let at = 0;
  const next = (): bigint | null => {
    let value = 0n;
    for (let shift = 0n; at < message.length && shift < 70n; shift += 7n) {
      const byte = message[at++]!;
      value |= BigInt(byte & 127) << shift;
      if (byte < 128) return value;
    }
    return null;
  };
  while (at < message.length) {
    const key = next();
    if (key === null) return out;
    const number = Number(key >> 3n);
    const kind = Number(key & 7n);
    if (kind === VARINT) {
      const value = next();
      if (value === null) return out;
      out.push({ number, value });
      continue;
    }
    const length = kind === BYTES ? Number(next() ?? -1n) : kind === FIXED64 ? 8 : kind === 5 ? 4 : -1;
    if (length < 0 || at + length > message.length) return out;
    out.push({ number, value: message.subarray(at, at + length) });
    at += length;
  }
  return out;
}
