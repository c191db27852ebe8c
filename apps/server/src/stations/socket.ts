import { LONGEST_MESSAGE, type Host } from "@twincell/messages";
import type { Door } from "../sockets/doors.ts";

/** States that wait for a slow page beyond this many bytes are left out; the next one tells more anyway. */
const MOST_WAITING = 1 << 20;
const STATES = ['{"type":"sample"', '{"type":"pendant"'];
export const STATIONS_PATH = "/stations";

/** Lets pages of this server into the host of the stations. */
export function stationDoor(host: Pick<Host, "join">): Door {
  let count = 0;
  return {
    path: STATIONS_PATH,
    longest: LONGEST_MESSAGE,
    welcome(socket) {
      const seat = host.join(`studio ${++count}`, {
        send(text) {
          if (socket.bufferedAmount < MOST_WAITING || !STATES.some(state => text.startsWith(state))) socket.send(text);
        },
        close() {
          socket.close();
        },
      });
      socket.on("message", (data, binary) => {
        if (binary) socket.close(1003);
        else seat.hear(String(data as Buffer));
      });
      socket.on("close", seat.leave);
      socket.on("error", seat.leave);
    },
  };
}
