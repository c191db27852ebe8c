import { cellStore } from "../../stores/cell.ts";
import type { Command } from "../../stores/commands.ts";
import { connectionStore } from "../../stores/connection.ts";
import { notify } from "../../stores/notices.ts";
import { words } from "../../messages/index.ts";
import {
  connectCellRobot,
  disconnectCellRobot,
  fetchFromThere,
  sendThere,
  showAs,
  tellRefused,
} from "./cell-connection.ts";
import { DRIVER_LIST, type OfferedDriver } from "./driver-list.ts";

/** The virtual controllers that drive the robot of the cell. */
export function virtualControllers(): readonly OfferedDriver[] {
  const robot = cellStore.getState().document?.robot.id;
  return DRIVER_LIST.filter(({ port, robots }) => port === null && robots.some(({ id }) => id === robot));
}
const isConnected = (): boolean => connectionStore.getState().station !== null;

/** What the pendant does with the one connection, for palette and headset. */
export const connectionCommands = (): readonly Command[] => [
  {
    id: "connection.connect",
    group: "jog",
    words: words.commands.connectNext,
    can: () => !isConnected() && virtualControllers().length > 0,
    run: () => {
      const [driver] = virtualControllers();
      if (!driver) return;
      void connectCellRobot(driver.id, "page").then(outcome => {
        if (outcome.kind !== "done") notify("bad", outcome.why.sentence, outcome.why.hint);
      });
    },
  },
  {
    id: "connection.disconnect",
    group: "jog",
    words: words.commands.disconnect,
    can: isConnected,
    run: () => void disconnectCellRobot(),
  },
  { id: "connection.live", group: "jog", words: words.commands.showLive, can: isConnected, run: () => showAs("live") },
  {
    id: "connection.clone",
    group: "jog",
    words: words.commands.showClone,
    can: isConnected,
    run: () => showAs("clone"),
  },
  {
    id: "connection.send",
    group: "jog",
    words: words.commands.sendRobot,
    can: isConnected,
    run: () => {
      if (connectionStore.getState().enabled) tellRefused(sendThere());
      else notify("info", words.connection.holdFirst, words.connection.holdFirstHint);
    },
  },
  {
    id: "connection.fetch",
    group: "jog",
    words: words.commands.fetchRobot,
    can: isConnected,
    run: fetchFromThere,
  },
];
