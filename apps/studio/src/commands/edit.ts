import { chooseTool } from "../stores/build.ts";
import { cellStore } from "../stores/cell.ts";
import type { Command } from "../stores/commands.ts";
import { commit, redo, undo } from "../stores/document.ts";
import { clearMate, mateStore } from "../stores/mate.ts";
import { clearMeasure, measureStore } from "../stores/measure.ts";
import { notify } from "../stores/notices.ts";
import { stopEverything } from "../stores/stop.ts";
import { select, selectionStore } from "../stores/selection.ts";
import { picksSurfaces } from "../stores/surface.ts";
import { traceStore } from "../stores/trace.ts";
import { words } from "../messages/index.ts";

export const editCommands = (): readonly Command[] => [
  { id: "stop", group: "jog", words: words.commands.stop, keys: ["Pause"], run: stop },
  {
    id: "edit.undo",
    group: "edit",
    words: words.commands.undo,
    keys: ["Mod+Z"],
    can: () => cellStore.getState().undo.length > 0,
    run: () => {
      const label = undo();
      if (label) notify("info", words.undo.done(label));
    },
  },
  {
    id: "edit.redo",
    group: "edit",
    words: words.commands.redo,
    keys: ["Mod+Shift+Z", "Mod+Y"],
    can: () => cellStore.getState().redo.length > 0,
    run: () => {
      const label = redo();
      if (label) notify("info", words.undo.redone(label));
    },
  },
  { id: "edit.leave", group: "edit", words: words.commands.deselect, keys: ["Escape"], run: leave },
  {
    id: "cell.box",
    group: "edit",
    words: words.commands.box,
    run: () => {
      const id = freshObjectId();
      commit(words.undo.addObject, document => ({
        ...document,
        objects: [
          ...document.objects,
          {
            id,
            name: `Box ${id.slice(4)}`,
            role: "workpiece",
            worldFromObject: { position: [0.6, 0.4, 0.1], quaternion: [0, 0, 0, 1] },
            shape: { kind: "box", size_m: [0.2, 0.2, 0.2] },
            color: "#9aa7b0",
          },
        ],
      }));
      select({ kind: "object", id });
    },
  },
];

function freshObjectId(): string {
  const taken = new Set(cellStore.getState().document?.objects.map(object => object.id));
  let n = 1;
  while (taken.has(`box-${n}`)) n++;
  return `box-${n}`;
}
/** Esc leaves one thing at a time: the chosen edges, the trace tool, the selection. */
function leave(): void {
  const trace = traceStore.getState();
  if (trace.active && trace.chosen.length > 0) traceStore.setState({ chosen: [], hovered: null });
  else if (trace.active) traceStore.setState({ active: false, hovered: null });
  else if (measureStore.getState().picks.length > 0) clearMeasure();
  else if (mateStore.getState().moving) clearMate();
  else if (picksSurfaces()) chooseTool("select");
  else if (selectionStore.getState().selected) select(null);
}
function stop(): void {
  const problems = stopEverything();
  if (problems.length > 0) notify("bad", `${words.top.stopTrouble} ${problems.join(" ")}`);
  notify("warn", words.top.stopped, words.top.stoppedHint);
}
