import type { IncomingMessage } from "node:http";
import type { WebSocket } from "ws";
import type { StandardContext } from "../standard.ts";

/** A reader that has this much waiting misses messages until it has caught up [bytes]. */
const MAX_WAITING = 1 << 20;

/** One who is connected. */
export interface RosClient {
  readonly who: string;
  readonly request: IncomingMessage;
  send(message: object): void;
  onGone(listen: () => void): () => void;
}

export function clientOf(
  context: StandardContext,
  socket: WebSocket,
  request: IncomingMessage,
  count: number,
): RosClient {
  const gone = new Set<() => void>();
  socket.on("close", () => {
    for (const listen of gone) listen();
  });
  const entered = context.enter(request, "look");
  const name = entered.kind === "in" && entered.named ? entered.who : "ROS";
  return {
    who: `${name} (rosbridge ${count})`,
    request,
    send(message) {
      if (socket.readyState !== socket.OPEN) return;
      if ("msg" in message && "topic" in message && socket.bufferedAmount > MAX_WAITING) return;
      socket.send(JSON.stringify(message));
    },
    onGone(listen) {
      gone.add(listen);
      return () => gone.delete(listen);
    },
  };
}
