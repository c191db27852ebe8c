/** What a Modbus request may read and write; addresses from 0. A write that is not done gives its exception code. */
export interface ModbusTable {
  /** Whether there is such an address; null where there is none. */
  readonly coil: (address: number) => boolean | null;
  readonly input: (address: number) => boolean | null;
  readonly holding: (address: number) => number | null;
  readonly inputRegister: (address: number) => number | null;
  readonly writeCoil: (address: number, on: boolean) => Promise<number> | number;
  readonly writeRegister: (address: number, value: number) => Promise<number> | number;
}
export const MODBUS_DONE = 0;
export const ILLEGAL_FUNCTION = 1;
export const ILLEGAL_ADDRESS = 2;
export const ILLEGAL_VALUE = 3;
export const DEVICE_FAILURE = 4;
const LONGEST = 254;
const HEADER = 7;

/**
 * Answers of a Modbus TCP server (MODBUS Messaging on TCP/IP V1.0b, MODBUS Application Protocol V1.1b3): functions 1 to
 * 6, 15 and 16. Requests may come in any pieces; answers leave in their order.
 *
 * @returns takes bytes; false when they are no Modbus and the connection must end.
 */
export function modbusAnswers(table: ModbusTable, send: (bytes: Buffer) => void): (bytes: Uint8Array) => boolean {
  let waiting = Buffer.alloc(0);
  let before: Promise<void> = Promise.resolve();
  return bytes => {
    waiting = Buffer.concat([waiting, bytes]);
    while (waiting.length >= HEADER + 1) {
      const length = waiting.readUInt16BE(4);
      if (waiting.readUInt16BE(2) !== 0 || length < 2 || length > LONGEST) return false;
      if (waiting.length < 6 + length) return true;
      const request = Buffer.from(waiting.subarray(0, 6 + length));
      waiting = waiting.subarray(6 + length);
      before = before.then(async () => {
        const body = await answerOf(table, request.subarray(HEADER));
        const head = Buffer.alloc(HEADER);
        request.copy(head, 0, 0, 4);
        head.writeUInt16BE(body.length + 1, 4);
        head[6] = request[6]!;
        send(Buffer.concat([head, body]));
      });
    }
    return true;
  };
}

const failed = (code: number, why: number): Buffer => Buffer.from([code | 0x80, why]);

async function answerOf(table: ModbusTable, ask: Buffer): Promise<Buffer> {
  const code = ask[0]!;
  if (![1, 2, 3, 4, 5, 6, 15, 16].includes(code)) return failed(code, ILLEGAL_FUNCTION);
  if (ask.length < 5) return failed(code, ILLEGAL_VALUE);
  const address = ask.readUInt16BE(1);
  const count = ask.readUInt16BE(3);
  if (code <= 2) return readBits(code, address, count, code === 1 ? table.coil : table.input);
  if (code <= 4) return readRegisters(code, address, count, code === 3 ? table.holding : table.inputRegister);
  if (code === 5) {
    if (count !== 0xff00 && count !== 0) return failed(code, ILLEGAL_VALUE);
    const why = table.coil(address) === null ? ILLEGAL_ADDRESS : await table.writeCoil(address, count !== 0);
    return why === MODBUS_DONE ? ask.subarray(0, 5) : failed(code, why);
  }
  if (code === 6) {
    const why = table.holding(address) === null ? ILLEGAL_ADDRESS : await table.writeRegister(address, count);
    return why === MODBUS_DONE ? ask.subarray(0, 5) : failed(code, why);
  }
  return writeMany(table, code, ask, address, count);
}

function readBits(code: number, at: number, count: number, bit: (address: number) => boolean | null): Buffer {
  if (count < 1 || count > 2000) return failed(code, ILLEGAL_VALUE);
  const bytes = Math.ceil(count / 8);
  const out = Buffer.alloc(2 + bytes);
  out[0] = code;
  out[1] = bytes;
  for (let i = 0; i < count; i++) {
    const value = bit(at + i);
    if (value === null) return failed(code, ILLEGAL_ADDRESS);
    if (value) out[2 + (i >> 3)]! |= 1 << (i & 7);
  }
  return out;
}

function readRegisters(code: number, at: number, count: number, word: (address: number) => number | null): Buffer {
  if (count < 1 || count > 125) return failed(code, ILLEGAL_VALUE);
  const out = Buffer.alloc(2 + 2 * count);
  out[0] = code;
  out[1] = 2 * count;
  for (let i = 0; i < count; i++) {
    const value = word(at + i);
    if (value === null) return failed(code, ILLEGAL_ADDRESS);
    out.writeUInt16BE(value & 0xffff, 2 + 2 * i);
  }
  return out;
}

async function writeMany(table: ModbusTable, code: number, ask: Buffer, at: number, count: number): Promise<Buffer> {
  const bits = code === 15;
  const bytes = bits ? Math.ceil(count / 8) : 2 * count;
  if (count < 1 || count > (bits ? 1968 : 123) || ask[5] !== bytes || ask.length !== 6 + bytes)
    return failed(code, ILLEGAL_VALUE);
  // All addresses are looked at before the first is written.
  for (let i = 0; i < count; i++)
    if ((bits ? table.coil(at + i) : table.holding(at + i)) === null) return failed(code, ILLEGAL_ADDRESS);
  for (let i = 0; i < count; i++) {
    const why = bits
      ? await table.writeCoil(at + i, (ask[6 + (i >> 3)]! & (1 << (i & 7))) !== 0)
      : await table.writeRegister(at + i, ask.readUInt16BE(6 + 2 * i));
    if (why !== MODBUS_DONE) return failed(code, why);
  }
  return ask.subarray(0, 5);
}
