import { useStore } from "zustand";
import { cellStore } from "../../stores/cell.ts";
import { runCommand } from "../../stores/commands.ts";
import { watchStore } from "../../stores/watch.ts";
import { showNumber } from "../../ui/expression.ts";
import { words } from "../../messages/index.ts";
import { solidName } from "../../messages/phrases.ts";

/** Beyond this there is plenty of room, and the watch does not measure [m]. */
const PLENTY_M = 0.25;
const NEAR_M = 0.02;

/** How near the robot is to the cell at this moment, and what to; a click opens what should happen there. */
export function ClearanceTag() {
  const clearance_m = useStore(watchStore, state => state.clearance_m);
  const nearest = useStore(watchStore, state => state.nearest);
  const contact = useStore(watchStore, state => state.contacts[0]);
  const objects = useStore(cellStore, state => state.document?.objects);
  if (clearance_m === null || objects === undefined) return null;
  const touching = contact !== undefined || clearance_m === 0;
  const [a, b] = contact ?? nearest;
  const tone = touching ? "bad" : clearance_m < NEAR_M ? "near" : "";
  const says = touching
    ? words.collide.contact
    : Number.isFinite(clearance_m)
      ? `${showNumber(clearance_m, "length", clearance_m < 0.1 ? 1 : 0)} mm`
      : words.collide.plenty(`${showNumber(PLENTY_M, "length", 0)} mm`);
  return (
    <button
      className="clearance float"
      data-tone={tone}
      title={words.collide.menu}
      onClick={() => runCommand("view.collision")}
    >
      <span className="dim">{words.collide.clearance}</span> <b>{says}</b>
      {a !== "" && a !== undefined && b !== undefined && (touching || Number.isFinite(clearance_m)) && (
        <span className="clearance-pair">{words.collide.nearest(solidName(a, objects), solidName(b, objects))}</span>
      )}
    </button>
  );
}
