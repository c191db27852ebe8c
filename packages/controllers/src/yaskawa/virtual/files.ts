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
export function fileServer({
  files,
  now_s,
  fromOutside,
  isRunning,
}: FileOptions): (request: HsesRequest, from: string) => FileAnswer | null {
  const transfers = new Map<string, Transfer>();
  const refused = (added: number, block = LAST_BLOCK): FileAnswer => ({
    block,
    status: STATUS.refused,
    added,
    data: NOTHING,
  });
  const well = (block: number, data: Uint8Array = NOTHING): FileAnswer => ({
    block,
    status: STATUS.well,
    added: 0,
    data,
  });

  const unfit = (): number => (fromOutside() !== 0 ? ADDED.remoteOff : isRunning() ? ADDED.moving : 0);
  function begin(from: string, service: number, name: string, outgoing: Uint8Array | null): Transfer | null {
    for (const [client, { at_s }] of transfers) if (now_s() - at_s > PATIENCE_S) transfers.delete(client);
    if (transfers.size >= MOST_TRANSFERS && !transfers.has(from)) return null;
    const transfer: Transfer = { service, name, outgoing, incoming: [], bytes: 0, block: 0, at_s: now_s() };
    transfers.set(from, transfer);
    return transfer;
  }

  /** The block of that number, counted from 1. */
  function block(outgoing: Uint8Array, number: number): FileAnswer {
    const data = outgoing.subarray((number - 1) * BLOCK_BYTES, number * BLOCK_BYTES);
    return well(number * BLOCK_BYTES >= outgoing.length ? (number | LAST_BLOCK) >>> 0 : number, data);
  }

  function ask({ service, data }: HsesRequest, from: string): FileAnswer {
    const name = textAt(data, 0, data.length).trim();
    switch (service) {
      case SERVICE.listFiles: {
        const ending = /^\*(\.[A-Z]{3})$/.exec(name.toUpperCase())?.[1];
        if (ending === undefined) return refused(0xe2a7);
        const text = textBytes(
          files
            .names(ending)
            .map(each => `${each}\r\n`)
            .join(""),
        );
        return begin(from, service, name, text) ? block(text, 1) : refused(ADDED.busy);
      }
      case SERVICE.loadFile: {
        const text = files.read(name);
        if (text === undefined) return refused(ADDED.noSuchFile);
        const outgoing = textBytes(text);
        return begin(from, service, name, outgoing) ? block(outgoing, 1) : refused(ADDED.busy);
      }
      case SERVICE.saveFile: {
        const why = unfit();
        if (why !== 0) return refused(why);
        if (name === "") return refused(ADDED.badJobName);
        return begin(from, service, name, null) ? well(0) : refused(ADDED.busy);
      }
      case SERVICE.deleteFile: {
        const why = unfit();
        if (why !== 0) return refused(why);
        return files.remove(name) ? well(LAST_BLOCK) : refused(ADDED.noSuchFile);
      }
      default:
        return refused(ADDED.noCommand);
    }
  }

  /** An acknowledgement of what was sent, or a block of what is being received. */
  function go(request: HsesRequest, from: string): FileAnswer | null {
    const transfer = transfers.get(from);
    const number = (request.block & ~LAST_BLOCK) >>> 0;
    const isLast = request.block >= LAST_BLOCK;
    if (transfer === undefined || transfer.service !== request.service)
      return refused(ADDED.receiveTimeout, request.block);
    if (now_s() - transfer.at_s > PATIENCE_S) {
      transfers.delete(from);
      return refused(ADDED.receiveTimeout, request.block);
    }
    transfer.at_s = now_s();
    if (transfer.outgoing !== null) {
      if (isLast) {
        transfers.delete(from);
        return null;
      }
      return number * BLOCK_BYTES < transfer.outgoing.length
        ? block(transfer.outgoing, number + 1)
        : refused(0xe4a1, request.block);
    }
    // The answer to a block was lost: the same block once more.
    if (number === transfer.block) return well(request.block);
    if (number !== transfer.block + 1) {
      transfers.delete(from);
      return refused(0xe4a1, request.block);
    }
    transfer.bytes += request.data.length;
    if (transfer.bytes > MOST_BYTES) {
      transfers.delete(from);
      return refused(ADDED.memoryFull, request.block);
    }
    transfer.incoming.push(request.data.slice());
    transfer.block = number;
    if (!isLast) return well(request.block);
    const why =
      unfit() || files.save(transfer.name, transfer.incoming.map(bytes => textAt(bytes, 0, bytes.length)).join(""));
    transfer.incoming.length = 0;
    if (why !== 0) transfers.delete(from);
    return why === 0 ? well(request.block) : refused(why, request.block);
  }

  return (request, from) => (request.ack ? go(request, from) : ask(request, from));
}
