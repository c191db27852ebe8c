import type { ByteStream } from "../../transport/index.ts";
import { lineBytes } from "../codec/lines.ts";
import { PACKAGE, primaryPackages, readMessage, type PrimaryMessage } from "../codec/primary.ts";

export interface PrimaryClient {
  /** Sends a program; a line end is added where it has none. */
  script(text: string): void;
  close(): void;
}

/** Messages of the controller, and the door for programs. States are read from RTDE. */
export function primaryClient(
  stream: ByteStream,
  onMessage: (message: PrimaryMessage) => void,
  onLost: (sentence: string) => void,
): PrimaryClient {
  const packages = primaryPackages();
  let over = false;
  const end = (sentence: string | null): void => {
    if (over) return;
    over = true;
    stream.close();
    if (sentence !== null) onLost(sentence);
  };
  stream.onEnd(ending => {
    end(ending.sentence);
  });
  stream.onBytes(lent => {
    const why = packages.push(lent, (type, body) => {
      const message = type === PACKAGE.message && !over ? readMessage(body) : null;
      if (message) onMessage(message);
    });
    if (why !== null) end(why);
  });
  return {
    script(text) {
      if (!over) stream.send(lineBytes(text.replace(/\n$/, "")));
    },
    close() {
      end(null);
    },
  };
}
