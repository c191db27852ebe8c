import {
  orientationPresetAxis,
  orientationPreset,
  nextOrientationPreset,
  type Pose,
  type Vector3,
} from "@twincell/core";
import { cellStore } from "../../stores/cell.ts";
import { theRobot } from "../../stores/document.ts";
import { jogStore } from "../../stores/jog.ts";
import { notify } from "../../stores/notices.ts";
import { selectionStore } from "../../stores/selection.ts";
import { sound } from "../../stores/sound.ts";
import { words } from "../../messages/index.ts";
import { interpolateTo } from "./joint-interpolation.ts";
import { tcpNow, theLive } from "../live.ts";
import { solveTcp } from "./solve.ts";

/** The piece the aids belong to: the selected object, else the first work piece; the world when there is none. */
function pieceNow(): Pose<"world", "object"> {
  const objects = cellStore.getState().document?.objects ?? [];
  const { selected } = selectionStore.getState();
  const piece =
    (selected?.kind === "object" ? objects.find(object => object.id === selected.id) : undefined) ??
    objects.find(object => object.role === "workpiece");
  return piece?.worldFromObject ?? { position: [0, 0, 0], quaternion: [0, 0, 0, 1] };
}

const axis: Vector3 = [0, 0, 0];
/** Tool axis in the world of the aid that is chosen, lent until the next call; null when the tool is free. */
export function chosenPresetAxis(): Readonly<Vector3> | null {
  const { aid } = jogStore.getState();
  return aid === null ? null : orientationPresetAxis(pieceNow(), aid, axis);
}

/**
 * Turns the tool to the next or previous orientation aid about its tip (rows N-31, N-35, N-52); says why when it
 * cannot.
 */
export function cycleOrientationPreset(by: 1 | -1): void {
  const robot = theRobot();
  const now = jogStore.getState().aid;
  if (!robot) return;
  const aid = now === null ? (by > 0 ? 0 : nextOrientationPreset(0, -1)) : nextOrientationPreset(now, by);
  const tcp = tcpNow();
  const near = theLive().q_rad;
  // Round tools leave the turn about their axis open: the least turn is tried first, the turn along the edge second.
  const ways = [orientationPreset(pieceNow(), aid, tcp.quaternion), orientationPreset(pieceNow(), aid)];
  const solved = ways.map(quaternion => solveTcp({ position: tcp.position, quaternion }, near));
  const there = solved.find(each => each.kind === "reached");
  jogStore.setState({ aid });
  if (there?.kind === "reached") {
    jogStore.setState({ blocked: null });
    interpolateTo(robot, there.q_rad);
    return;
  }
  const [first] = solved;
  sound("limit");
  if (first?.kind === "not") notify("warn", words.jog.aidUnreachable(aid + 1, first.sentence));
}
