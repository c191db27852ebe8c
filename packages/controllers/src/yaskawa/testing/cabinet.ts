import {
  COMMAND,
  SERVICE,
  noStatus,
  pulsesOf,
  readStatus,
  word,
  writePulseMove,
  writeSelection,
  type Status,
} from "../codec/index.ts";
import type { VirtualYaskawaOptions } from "../virtual/index.ts";
import { bench, rawClient } from "./bench.ts";

export const OK = { status: 0, added: 0 };
export const refused = (added: number) => ({ status: 0x1f, added });

/** A virtual controller and a client that sends packets as it is told. */
export async function cabinet(options: Partial<VirtualYaskawaOptions> = {}) {
  const made = await bench(options, {}, false);
  const { scheduler, virtual } = made;
  const raw = await rawClient(made);
  const filing = await rawClient(made, true);
  let id = 0;
  const order = (
    command: number,
    instance: number,
    data: Uint8Array,
    attribute = 1,
    service: number = SERVICE.setOne,
  ) => raw.ask({ id: ++id & 255, command, instance, attribute, service, data });
  const read = (command: number, instance: number, attribute = 0) =>
    raw.ask({
      id: ++id & 255,
      command,
      instance,
      attribute,
      service: attribute === 0 ? SERVICE.getAll : SERVICE.getOne,
    });
  const move = (q_rad: ArrayLike<number>, speed = 10_000, path = 1) =>
    order(
      COMMAND.movePulse,
      path,
      writePulseMove({
        robot: 1,
        station: 0,
        speedClass: path === 1 ? 0 : 1,
        speed,
        axes: pulsesOf(q_rad, virtual.scale, new Int32Array(8)),
        tool: 0,
      }),
      1,
      SERVICE.setAll,
    );
  const status = async (): Promise<Status> => {
    const out = noStatus();
    readStatus((await read(COMMAND.status, 1))!.data, out);
    return out;
  };
  const start = () => order(COMMAND.start, 1, word(1));
  const select = (name: string, line = 0) => order(COMMAND.select, 1, writeSelection(name, line), 0, SERVICE.setAll);
  const hold = (on: boolean) => order(COMMAND.power, 1, word(on ? 1 : 2));
  const servo = (on: boolean) => order(COMMAND.power, 2, word(on ? 1 : 2));
  const j1 = (): number => virtual.neutral.jointAngle(1);
  return { ...made, raw, filing, order, read, move, status, start, select, hold, servo, j1, scheduler };
}
