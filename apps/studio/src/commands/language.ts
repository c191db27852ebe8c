import { language, words } from "../messages/index.ts";
import { chooseLanguage, languages, nameOf } from "../messages/languages.ts";
import { cellStore } from "../stores/cell.ts";
import type { Command } from "../stores/commands.ts";
import { controlStore } from "../stores/control.ts";
import { notify } from "../stores/notices.ts";
import { stationStore } from "../stores/stations.ts";

/** Every language the studio speaks, as a command each. */
export const languageCommands = (): readonly Command[] =>
  languages.map(each => ({
    id: `language.${each}`,
    group: "view",
    words: words.language.command(nameOf(each)),
    aliases: ["Language", nameOf(each)],
    run: () => speak(each),
  }));

/** Another language loads the page again: nothing may move meanwhile, and the cell is kept before. */
function speak(wanted: string): void {
  if (wanted === language) return;
  const connected = stationStore.getState().stations.some(({ link }) => link.state !== "closed");
  if (connected || controlStore.getState().running) {
    notify("info", words.language.busy, words.language.busyHint);
    return;
  }
  const isKept = (): boolean => {
    const { kind } = cellStore.getState().saving;
    return kind === "saved" || kind === "problem";
  };
  if (isKept()) {
    chooseLanguage(wanted);
    return;
  }
  const stop = cellStore.subscribe(() => {
    if (!isKept()) return;
    stop();
    chooseLanguage(wanted);
  });
}
