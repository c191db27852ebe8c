import {
  checkHand,
  compose,
  freshStepIds,
  inferPallet,
  inverse,
  palletSlots,
  rotate,
  type Demonstration,
  type HandCheck,
  type InferredPallet,
  type InferRefusal,
  type Pose,
  type SceneBox,
  type Step,
  type Vector3,
} from "@twincell/core";
import { isTextProgram, shapeBounds, type CellDocument, type ObjectRecord } from "@twincell/project";
import { cellStore } from "../../stores/cell.ts";
import { flangeFromTcpOf, robotOf } from "../../stores/document.ts";
import { demonstrationStore, type OpenDemonstration } from "../../stores/demonstration.ts";
import { notify } from "../../stores/notices.ts";
import { addSteps } from "../../stores/program.ts";
import { theLive } from "../live.ts";
import { words } from "../../messages/index.ts";
import { closeDemonstration } from "./demonstrating.ts";

/** z of a box may lean this much and still points up: cosine of 2°. */
const UPRIGHT = Math.cos((2 * Math.PI) / 180);

/** The box around an object along its own axes; undefined for one that leans. */
function boxOf(object: ObjectRecord, name: string): SceneBox | undefined {
  if (rotate(object.worldFromObject.quaternion, [0, 0, 1])[2] < UPRIGHT) return undefined;
  const { lower, upper } = shapeBounds(object.shape);
  const middle = lower.map((value, k) => (value + upper[k]!) / 2) as Vector3;
  return {
    name,
    worldFromBox: compose(object.worldFromObject, { position: middle, quaternion: [0, 0, 0, 1] } as Pose<
      "object",
      "box"
    >),
    size_m: upper.map((value, k) => value - lower[k]!) as Vector3,
  };
}

/** A name that no frame or pallet of the cell has: that of the object, with a number where it is taken. */
function frameNames(document: CellDocument): (object: ObjectRecord) => string {
  const taken = new Set([
    "world",
    ...document.frames.map(({ name }) => name),
    ...document.programs.flatMap(each =>
      isTextProgram(each) ? [] : [...Object.keys(each.frames), ...Object.keys(each.pallets)],
    ),
  ]);
  return ({ name }) => {
    let free = name;
    for (let n = 2; taken.has(free) || taken.has(`${free} places`); n++) free = `${name} ${n}`;
    taken.add(free);
    return free;
  };
}

interface Inferred {
  readonly answer: InferredPallet | InferRefusal;
  /** By the name of the frame that it gets. */
  readonly surfaces: ReadonlyMap<string, ObjectRecord>;
}

function inferred(document: CellDocument, demonstration: Demonstration, places: number | undefined): Inferred {
  const name = frameNames(document);
  const surfaces = new Map<string, ObjectRecord>();
  const under: SceneBox[] = [];
  const parts: SceneBox[] = [];
  for (const object of document.objects) {
    if (object.role === "workpiece") {
      const part = boxOf(object, object.name);
      if (part) parts.push(part);
    } else if (object.role !== "wall") {
      const frame = name(object);
      const surface = boxOf(object, frame);
      if (!surface) continue;
      surfaces.set(frame, object);
      under.push(surface);
    }
  }
  const answer = inferPallet(demonstration, {
    parts,
    surfaces: under,
    places,
    tool: document.tool,
    flangeFromTcp: flangeFromTcpOf(document),
    robot: document.robot.id,
    name: words.demonstration.title,
  });
  return { answer, surfaces };
}

/** Whether the robot of the cell could follow a recorded hand with its tool; null without a robot. */
export function checkOpenHand(demonstration: Demonstration): HandCheck | null {
  const { document } = cellStore.getState();
  const robot = robotOf(document);
  return document && robot
    ? checkHand(demonstration, robot, document.robot.worldFromBase, flangeFromTcpOf(document), theLive().q_rad)
    : null;
}

/** Whether the hand closed and opened the gripper at all: only then a whole pallet can be made of it. */
export const showsCycle = ({ closed }: Demonstration): boolean => closed.some((is, i) => !is && closed[i - 1] === true);

/** Looks for the grid that explains what is open, with so many places; undefined: as many as explain it best. */
export function inferWholePallet(places: number | undefined): void {
  const { open } = demonstrationStore.getState();
  const { document } = cellStore.getState();
  if (!open || !document || !showsCycle(open.demonstration)) return;
  const { answer } = inferred(document, open.demonstration, places);
  const places_m =
    answer.kind === "program"
      ? palletSlots(answer.pallet).map(
          slot =>
            compose(answer.program.frames[answer.pallet.frame]!, slot as Pose<string, string> as Pose<"frame", "place">)
              .position,
        )
      : [];
  demonstrationStore.setState({ open: { ...open, places, pallet: answer, places_m } satisfies OpenDemonstration });
}

/**
 * Puts the inferred program into the one being taught, as one undo step: a frame on the surface, that moves with it,
 * the pallet in that frame, and the cycle done at each of its places.
 */
export function teachWholePallet(): void {
  const { open } = demonstrationStore.getState();
  const { document } = cellStore.getState();
  if (!open || !document) return;
  const { answer, surfaces } = inferred(document, open.demonstration, open.places);
  if (answer.kind !== "program") return;
  const [pallet] = answer.program.steps;
  const object = surfaces.get(answer.surface);
  if (pallet?.type !== "pallet" || !object) return;
  const worldFromFrame = answer.program.frames[answer.surface]!;
  const made = addSteps(
    words.undo.demonstration,
    program => {
      const ids = freshStepIds(program, pallet.steps.length + 1, "d");
      return [{ ...pallet, id: ids[0]!, steps: pallet.steps.map((step, i): Step => ({ ...step, id: ids[i + 1]! })) }];
    },
    program => ({ ...program, pallets: { ...program.pallets, [pallet.pallet]: answer.pallet } }),
    undefined,
    cell => ({
      ...cell,
      frames: [
        ...cell.frames,
        {
          name: answer.surface,
          worldFromFrame,
          attachedTo: { object: object.id, objectFromFrame: compose(inverse(object.worldFromObject), worldFromFrame) },
        },
      ],
    }),
  );
  if (!made) return;
  notify("done", words.demonstration.palletMade(answer.places, object.name));
  closeDemonstration();
}
