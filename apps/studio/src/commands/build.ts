import { buildStore, chooseTool, type BuildTool } from "../stores/build.ts";
import type { Command } from "../stores/commands.ts";
import { deleteObjects, duplicateObject, toggleHidden } from "../stores/objects.ts";
import { selectedObjects } from "../stores/selection.ts";
import { viewStore } from "../stores/view.ts";
import { words } from "../messages/index.ts";

const inCell = (): boolean => viewStore.getState().mode === "cell";
const tool = (which: BuildTool, text: string, key: string): Command => ({
  id: `build.${which}`,
  group: "edit",
  words: text,
  keys: [key],
  can: inCell,
  run: () => chooseTool(which),
});
const withSelected = (
  id: string,
  text: string,
  keys: readonly string[],
  run: (ids: readonly string[]) => void,
): Command => ({
  id,
  group: "edit",
  words: text,
  keys,
  can: () => inCell() && selectedObjects().length > 0,
  run: () => run(selectedObjects()),
});

/** What the keys do in Cell mode: W moves, E turns, R scales what is selected. */
export const buildCommands = (): readonly Command[] => [
  tool("move", words.commands.moveTool, "W"),
  tool("turn", words.commands.turnTool, "E"),
  tool("scale", words.commands.scaleTool, "R"),
  tool("measure", words.commands.measureTool, "M"),
  tool("mate", words.commands.mateTool, "J"),
  { ...tool("rig", words.commands.rigTool, ""), keys: [] },
  {
    id: "build.snap",
    group: "edit",
    words: words.commands.snap,
    keys: ["S"],
    can: inCell,
    run: () => buildStore.setState(({ snap }) => ({ snap: !snap })),
  },
  {
    id: "build.space",
    group: "edit",
    words: words.commands.handleAxes,
    keys: ["L"],
    can: inCell,
    run: () => buildStore.setState(({ space }) => ({ space: space === "world" ? "local" : "world" })),
  },
  withSelected("build.hide", words.tree.hide, ["H"], ids => ids.forEach(id => toggleHidden(id))),
  withSelected("build.duplicate", words.common.duplicate, ["Mod+D"], ids => ids.forEach(id => duplicateObject(id))),
  withSelected("build.delete", words.tree.deleteObject, ["Delete"], deleteObjects),
];
