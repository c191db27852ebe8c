import type { IncomingMessage } from "node:http";
import { LONGEST_MESSAGE, type RobotServer } from "@twincell/protocol";
import type { RoleAt } from "../people/gate.ts";
import type { Route } from "../sockets/doors.ts";
import { roleFilter } from "./role-filter.ts";

/** States that wait for a slow page beyond this many bytes are left out; the next one tells more anyway. */
const MAX_WAITING = 1 << 20;
const STATES = ['{"type":"sample"', '{"type":"pendant"'];
export const STATIONS_PATH = "/stations";

/**
 * Lets pages of this server into the host of the stations.
 *
 * @param nameOf  the name of whoever asks, where it is known; others are numbered.
 * @param roleOf  what they may do; null: everything.
 */
export function connectionRoute(
  host: Pick<RobotServer, "join">,
  nameOf: (request: IncomingMessage) => string | null = () => null,
  roleOf: (request: IncomingMessage) => RoleAt | null = () => null,
): Route {
  let count = 0;
  return {
    path: STATIONS_PATH,
    longest: LONGEST_MESSAGE,
    welcome(socket, request) {
      const send = (text: string): void => {
        if (socket.bufferedAmount < MAX_WAITING || !STATES.some(state => text.startsWith(state))) socket.send(text);
      };
      const who = named(nameOf(request), ++count);
      const role = roleOf(request);
      const commander = host.join(who, {
        send,
        close() {
          socket.close();
        },
      });
      const hear = role === null ? commander.hear : roleFilter(role, who, commander.hear, send);
      socket.on("message", (data, binary) => {
        if (binary) socket.close(1003);
        else hear(String(data as Buffer));
      });
      socket.on("close", commander.leave);
      socket.on("error", commander.leave);
    },
  };
}

/** A guard knows commanders by name: two connections of one person are told apart by their number. */
const named = (name: string | null, count: number): string =>
  name === null ? `studio ${count}` : `${name} (${count})`;
