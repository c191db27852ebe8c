import { LARGEST_PICTURE, VIDEO_PATH, type VideoRelay } from "@twincell/protocol";
import type { Route } from "../sockets/doors.ts";

/** Words that wait beyond this many bytes are not read any more: that line is dead [bytes]. */
const MAX_WAITING = 8 * 1024 * 1024;

/**
 * Lets cameras and viewers into the relay: a line and a memory of their own, apart from the stations'. What a viewer
 * has not taken is bounded by the relay (two pictures); what it does not take at all ends its line.
 */
export function videoRoute(relay: VideoRelay): Route {
  return {
    path: VIDEO_PATH,
    longest: LARGEST_PICTURE,
    welcome(socket) {
      const enough = (): boolean => {
        if (socket.bufferedAmount < MAX_WAITING) return true;
        socket.terminate();
        return false;
      };
      const commander = relay.join({
        send(text) {
          if (enough()) socket.send(text);
        },
        picture(bytes) {
          if (enough()) socket.send(bytes);
        },
        close() {
          socket.close();
        },
      });
      socket.on("message", (data, binary) => {
        if (binary) commander.hearPicture(data as Buffer);
        else commander.hear(String(data as Buffer));
      });
      socket.on("close", commander.leave);
      socket.on("error", commander.leave);
    },
  };
}
