import type { IncomingMessage } from "node:http";
import { LONGEST_MESSAGE, type RobotServer } from "@twincell/protocol";
import type { Route } from "../sockets/doors.ts";

/** States that wait for a slow page beyond this many bytes are left out; the next one tells more anyway. */
const MAX_WAITING = 1 << 20;
const STATES = ['{"type":"sample"', '{"type":"pendant"'];
export const STATIONS_PATH = "/stations";

/**
 * Lets pages of this server into the host of the stations.
 *
 * @param nameOf  the name of whoever asks, where it is known; others are numbered.
 */
export function connectionRoute(
  host: Pick<RobotServer, "join">,
  nameOf: (request: IncomingMessage) => string | null = () => null,
): Route {
  let count = 0;
  return {
    path: STATIONS_PATH,
    longest: LONGEST_MESSAGE,
    welcome(socket, request) {
      const commander = host.join(named(nameOf(request), ++count), {
        send(text) {
          if (socket.bufferedAmount < MAX_WAITING || !STATES.some(state => text.startsWith(state))) socket.send(text);
        },
        close() {
          socket.close();
        },
      });
      socket.on("message", (data, binary) => {
        if (binary) socket.close(1003);
        else commander.hear(String(data as Buffer));
      });
      socket.on("close", commander.leave);
      socket.on("error", commander.leave);
    },
  };
}

/** A guard knows commanders by name: two connections of one person are told apart by their number. */
const named = (name: string | null, count: number): string =>
  name === null ? `studio ${count}` : `${name} (${count})`;
