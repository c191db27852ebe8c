import "@fontsource-variable/inter/wght.css";
import { createRoot } from "react-dom/client";
import { createClient } from "@twincell/protocol";
import { createVirtualPendantLink, type VirtualPendantLink } from "./virtual-pendant/link.ts";
import { PendantPage } from "./virtual-pendant/PendantPage.tsx";
import { say, words } from "./messages/index.ts";
import "./tokens.css";
import "./app.css";

/**
 * The pendant of one virtual controller on a page of its own. Whoever served the page is its host: `twincell virtual`,
 * or a server with stations, one of which `?station=` names.
 */
document.title = `${words.cabinet.title} · ${words.app.name}`;
const wanted = new URL(location.href).searchParams.get("station");
const root = createRoot(document.getElementById("root")!);
const address = new URL("/stations", location.href);
address.protocol = location.protocol === "https:" ? "wss:" : "ws:";
const socket = new WebSocket(address);
let link: VirtualPendantLink | null = null;
const show = (sentence: string | null): void => {
  root.render(<PendantPage link={link} sentence={sentence} />);
};
const client = createClient(
  {
    send: text => {
      if (socket.readyState === WebSocket.OPEN) socket.send(text);
    },
    close: () => {
      socket.close();
    },
  },
  () => performance.now() / 1000,
  message => {
    switch (message.type) {
      case "hello": {
        const station =
          wanted === null
            ? message.stations.find(({ virtual }) => virtual)
            : message.stations.find(({ id }) => id === wanted);
        if (station) link = createVirtualPendantLink(station.id, client);
        show(station ? null : "");
        break;
      }
      case "pendant":
        link?.take(message);
        break;
      case "closed":
        if (link && message.station === link.station) link.gone();
        break;
      case "fault":
        link?.gone();
        show(say(message.sentence));
        break;
      default:
    }
  },
);
socket.addEventListener("message", ({ data }: MessageEvent<string>) => {
  client.hear(data);
});
socket.addEventListener("close", () => {
  client.gone();
  link?.gone();
});
show(null);
