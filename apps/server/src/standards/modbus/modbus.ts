import { createServer, type AddressInfo, type Socket } from "node:net";
import type { StandardContext, StartedStandard } from "../standard.ts";
import { modbusAnswers } from "./frames.ts";
import { modbusTable, readModbusLines } from "./table.ts";

const MOST_CLIENTS = 32;
/** A client that does not read its answers is let go [bytes]. */
const MOST_WAITING = 1 << 16;

/** States, lines and stops of all robots for controllers that speak Modbus TCP. */
export async function startModbus(
  context: StandardContext,
  port: number,
  linesFile: string | undefined,
): Promise<StartedStandard> {
  const { host, certificate } = context;
  const given = linesFile === undefined ? new Map<string, readonly string[]>() : readModbusLines(linesFile);
  const table = modbusTable(context, given, certificate === null);
  const open = new Set<Socket>();
  const server = createServer({ noDelay: true }, socket => {
    if (open.size >= MOST_CLIENTS) {
      socket.destroy();
      return;
    }
    open.add(socket);
    socket.once("close", () => open.delete(socket));
    socket.on("error", () => {
      socket.destroy();
    });
    const hear = modbusAnswers(table, bytes => {
      if (socket.writableLength > MOST_WAITING) socket.destroy();
      else if (socket.writable) socket.write(bytes);
    });
    socket.on("data", (bytes: Buffer) => {
      if (!hear(bytes)) socket.destroy();
    });
  });
  await new Promise<void>((resolve, reject) => {
    server.once("error", reject);
    server.listen(port, host, resolve);
  });
  return {
    address: `Modbus TCP: ${host}:${(server.address() as AddressInfo).port}`,
    close() {
      table.close();
      server.close();
      for (const socket of open) socket.destroy();
    },
  };
}
