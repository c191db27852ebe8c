import type { Command } from "../stores/commands.ts";
import { openDocs } from "./docs.ts";
import { openDialog } from "../stores/dialogs.ts";
import { headsetStore } from "../stores/headset.ts";
import { openMarkerView } from "../stores/marker-view.ts";
import {
  showMode,
  toggleCamera,
  toggleClosePlacement,
  toggleMuted,
  toggleTheme,
  viewStore,
  wishHeadset,
  type StudioMode,
} from "../stores/view.ts";
import { words } from "../messages/index.ts";

const MODES: readonly StudioMode[] = ["cell", "teach", "check", "run", "history"];

export const viewCommands = (): readonly Command[] => [
  ...MODES.map(
    (mode, i): Command => ({
      id: `view.${mode}`,
      group: "view",
      words: words.commands[mode],
      keys: [String(i + 1)],
      run: () => showMode(mode),
    }),
  ),
  { id: "view.camera", group: "view", words: words.commands.camera, keys: ["C"], run: toggleCamera },
  { id: "view.closePlacement", group: "view", words: words.commands.closePlacement, run: toggleClosePlacement },
  {
    id: "view.plots",
    group: "view",
    words: words.commands.plots,
    run: () => viewStore.setState(({ plots }) => ({ plots: !plots })),
  },
  { id: "view.theme", group: "view", words: words.commands.theme, aliases: ["Dark", "Light"], run: toggleTheme },
  { id: "view.mute", group: "view", words: words.commands.mute, aliases: ["Mute"], keys: ["M"], run: toggleMuted },
  {
    id: "view.headset",
    group: "view",
    words: words.commands.headset,
    can: () => headsetStore.getState().ready === true,
    run: wishHeadset,
  },
  {
    id: "help.palette",
    group: "help",
    words: words.commands.palette,
    keys: ["Mod+K"],
    run: () => openDialog("palette"),
  },
  {
    id: "help.shortcuts",
    group: "help",
    words: words.commands.shortcuts,
    keys: ["?"],
    run: () => openDialog("shortcuts"),
  },
  { id: "help.docs", group: "help", words: words.commands.docs, keys: ["F1"], run: () => void openDocs() },
  { id: "help.device", group: "help", words: words.device.command, run: () => openDialog("device") },
  { id: "help.controls", group: "help", words: words.commands.controls, run: () => openDialog("controls") },
  { id: "view.people", group: "view", words: words.people.command, run: () => openDialog("people") },
  { id: "view.together", group: "view", words: words.together.command, run: () => openDialog("together") },
  { id: "view.fleet", group: "view", words: words.fleet.command, run: () => openDialog("fleet") },
  { id: "view.cameras", group: "view", words: words.video.command, run: () => openDialog("cameras") },
  {
    id: "view.marker",
    group: "view",
    words: words.marker.command,
    aliases: ["Augmented reality"],
    run: openMarkerView,
  },
  { id: "view.registration", group: "view", words: words.registration.command, run: () => openDialog("registration") },
  { id: "view.collision", group: "view", words: words.commands.collision, run: () => openDialog("collision") },
  { id: "help.coach", group: "help", words: words.commands.coach, run: () => viewStore.setState({ coachDone: false }) },
  { id: "cell.robot", group: "edit", words: words.commands.anotherRobot, run: () => openDialog("robots") },
  { id: "export.open", group: "file", words: words.commands.export, keys: ["Mod+E"], run: () => openDialog("export") },
  { id: "export.import", group: "file", words: words.commands.import, run: () => openDialog("import") },
];
