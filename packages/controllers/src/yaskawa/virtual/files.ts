import { ADDED, LAST_BLOCK, SERVICE, STATUS, textAt, textBytes, type HsesRequest } from "../codec/index.ts";
import type { Files } from "./jobs.ts";

/** Bytes of a block on its way to a client. */
const BLOCK_BYTES = 400;
/** A transfer that stands still for this long is dropped [s]. */
const PATIENCE_S = 10;
/** Transfers at once, bytes of one that is being received. */
const MOST_TRANSFERS = 16;
const MOST_BYTES = 1_000_000;

export interface FileAnswer {
  readonly block: number;
  readonly status: number;
  readonly added: number;
  readonly data: Uint8Array;
}
interface Transfer {
  readonly service: number;
  readonly name: string;
  readonly outgoing: Uint8Array | null;
  readonly incoming: Uint8Array[];
  bytes: number;
  block: number;
  at_s: number;
}

export interface FileOptions {
  readonly files: Files;
  readonly now_s: () => number;
  /** Why a command that changes something is not heard, or 0. */
  readonly fromOutside: () => number;
  readonly isRunning: () => boolean;
}

const NOTHING = new Uint8Array(0);

/** Answers of division 2, block by block; null where nothing is to be said. `from` tells clients apart. */
export function fileServer(options: FileOptions): (request: HsesRequest, from: string) => FileAnswer | null {
  return fileServerOf(new FileTransfers(options));
}

class FileTransfers {
  readonly files: Files;
  readonly now_s: () => number;
  readonly fromOutside: () => number;
  readonly isRunning: () => boolean;
  readonly transfers = new Map<string, Transfer>();

  constructor({ files, now_s, fromOutside, isRunning }: FileOptions) {
    this.files = files;
    this.now_s = now_s;
    this.fromOutside = fromOutside;
    this.isRunning = isRunning;
  }

  refused(added: number, block = LAST_BLOCK): FileAnswer {
    return {
      block,
      status: STATUS.refused,
      added,
      data: NOTHING,
    };
  }

  well(block: number, data: Uint8Array = NOTHING): FileAnswer {
    return {
      block,
      status: STATUS.well,
      added: 0,
      data,
    };
  }

  unfit(): number {
    return this.fromOutside() !== 0 ? ADDED.remoteOff : this.isRunning() ? ADDED.moving : 0;
  }

  begin(from: string, service: number, name: string, outgoing: Uint8Array | null): Transfer | null {
    for (const [client, { at_s }] of this.transfers)
      if (this.now_s() - at_s > PATIENCE_S) this.transfers.delete(client);
    if (this.transfers.size >= MOST_TRANSFERS && !this.transfers.has(from)) return null;
    const transfer: Transfer = { service, name, outgoing, incoming: [], bytes: 0, block: 0, at_s: this.now_s() };
    this.transfers.set(from, transfer);
    return transfer;
  }

  /** The block of that number, counted from 1. */
  block(outgoing: Uint8Array, number: number): FileAnswer {
    const data = outgoing.subarray((number - 1) * BLOCK_BYTES, number * BLOCK_BYTES);
    return this.well(number * BLOCK_BYTES >= outgoing.length ? (number | LAST_BLOCK) >>> 0 : number, data);
  }

  ask({ service, data }: HsesRequest, from: string): FileAnswer {
    const name = textAt(data, 0, data.length).trim();
    switch (service) {
      case SERVICE.listFiles: {
        const ending = /^\*(\.[A-Z]{3})$/.exec(name.toUpperCase())?.[1];
        if (ending === undefined) return this.refused(0xe2a7);
        const text = textBytes(
          this.files
            .names(ending)
            .map(each => `${each}\r\n`)
            .join(""),
        );
        return this.begin(from, service, name, text) ? this.block(text, 1) : this.refused(ADDED.busy);
      }
      case SERVICE.loadFile: {
        const text = this.files.read(name);
        if (text === undefined) return this.refused(ADDED.noSuchFile);
        const outgoing = textBytes(text);
        return this.begin(from, service, name, outgoing) ? this.block(outgoing, 1) : this.refused(ADDED.busy);
      }
      case SERVICE.saveFile: {
        const why = this.unfit();
        if (why !== 0) return this.refused(why);
        if (name === "") return this.refused(ADDED.badJobName);
        return this.begin(from, service, name, null) ? this.well(0) : this.refused(ADDED.busy);
      }
      case SERVICE.deleteFile: {
        const why = this.unfit();
        if (why !== 0) return this.refused(why);
        return this.files.remove(name) ? this.well(LAST_BLOCK) : this.refused(ADDED.noSuchFile);
      }
      default:
        return this.refused(ADDED.noCommand);
    }
  }

  /** An acknowledgement of what was sent, or a block of what is being received. */
  go(request: HsesRequest, from: string): FileAnswer | null {
    const transfer = this.transfers.get(from);
    const number = (request.block & ~LAST_BLOCK) >>> 0;
    const isLast = request.block >= LAST_BLOCK;
    if (transfer === undefined || transfer.service !== request.service)
      return this.refused(ADDED.receiveTimeout, request.block);
    if (this.now_s() - transfer.at_s > PATIENCE_S) {
      this.transfers.delete(from);
      return this.refused(ADDED.receiveTimeout, request.block);
    }
    transfer.at_s = this.now_s();
    if (transfer.outgoing !== null) {
      if (isLast) {
        this.transfers.delete(from);
        return null;
      }
      return number * BLOCK_BYTES < transfer.outgoing.length
        ? this.block(transfer.outgoing, number + 1)
        : this.refused(0xe4a1, request.block);
    }
    // The answer to a block was lost: the same block once more.
    if (number === transfer.block) return this.well(request.block);
    if (number !== transfer.block + 1) {
      this.transfers.delete(from);
      return this.refused(0xe4a1, request.block);
    }
    transfer.bytes += request.data.length;
    if (transfer.bytes > MOST_BYTES) {
      this.transfers.delete(from);
      return this.refused(ADDED.memoryFull, request.block);
    }
    transfer.incoming.push(request.data.slice());
    transfer.block = number;
    if (!isLast) return this.well(request.block);
    const why =
      this.unfit() ||
      this.files.save(transfer.name, transfer.incoming.map(bytes => textAt(bytes, 0, bytes.length)).join(""));
    transfer.incoming.length = 0;
    if (why !== 0) this.transfers.delete(from);
    return why === 0 ? this.well(request.block) : this.refused(why, request.block);
  }
}

function fileServerOf(own: FileTransfers): (request: HsesRequest, from: string) => FileAnswer | null {
  return (request, from) => (request.ack ? own.go(request, from) : own.ask(request, from));
}
