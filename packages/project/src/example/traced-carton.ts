import {
  compose,
  edgeNearPoint,
  featureEdges,
  fromMatrix,
  SHARP_RAD,
  lerp,
  pose,
  transformPoint,
  type Group,
  type MoveStep,
  type Pose,
  type Program,
  type Quaternion,
  type Speed,
  type Step,
  type Vector3,
} from "@twincell/core";
import type { StepsCell } from "../document.ts";
import { shapeMesh } from "../mesh/index.ts";
import { edgeTraceCell } from "./edge-trace.ts";

/** What is this near to the middle of an edge is that edge. */
const NEAR_M = 0.001;
/** How far the tool stays back from an edge before and after it. */
const LEAD_M = 0.06;
const APPROACH_RATIO = 0.3;
const TRACE: Speed = { mps: 0.05 };

/** The corners of the carton's top in its frame, and the way out of the side that begins at each. */
const CORNERS: readonly Vector3[] = [
  [0, 0, 0],
  [0.3, 0, 0],
  [0.3, 0.4, 0],
  [0, 0.4, 0],
];
const EDGES: readonly { readonly name: string; readonly out: readonly [number, number] }[] = [
  { name: "Right edge", out: [0, -1] },
  { name: "Far edge", out: [1, 0] },
  { name: "Left edge", out: [0, 1] },
  { name: "Near edge", out: [-1, 0] },
];

/** Tool axis into the carton, 45° down from the outside; its x axis along the edge. */
function orientation([x, y]: readonly [number, number]): Quaternion {
  const s = Math.SQRT1_2;
  const [qx, qy, qz, qw] = fromMatrix([-y, x * s, -x * s, x, y * s, -y * s, 0, -s, -s]);
  // No minus before zero: a file does not keep it.
  return [qx + 0, qy + 0, qz + 0, qw + 0];
}

/**
 * The cell of the edge trace with the traced program in it, ready to be played: all four top edges at 45°, one after
 * the other.
 */
export function tracedCartonCell(): StepsCell {
  const cell = edgeTraceCell();
  const tool = cell.tools[0]!;
  const frame = cell.frames[0]!;
  const home = cell.programs[0]!;
  const carton = cell.objects.find(object => object.id === frame.attachedTo?.object)!;
  const cartonFromFrame = frame.attachedTo!.objectFromFrame;
  const features = featureEdges(shapeMesh(carton.shape), SHARP_RAD);
  const steps: Step[] = [];
  const groups: Record<string, Group> = {};
  const atHome = (id: string): MoveStep => ({
    id,
    name: "Home",
    type: "move",
    path: "ptp",
    target: { q: [0, -Math.PI / 2, Math.PI / 2, 0, 0, 0], tool: tool.name },
    speed: { ratio: APPROACH_RATIO },
    blend_m: 0,
  });
  const move = (group: string, name: string, path: MoveStep["path"], to: Pose<"frame", "tcp">, speed: Speed): void => {
    steps.push({
      id: `s${steps.length + 1}`,
      name,
      group,
      type: "move",
      path,
      speed,
      blend_m: 0,
      target: {
        pose: to,
        frame: frame.name,
        tool: tool.name,
        branch: { shoulder: "front", elbow: "up", wrist: "positive" },
      },
    });
  };
  steps.push(atHome("s1"));
  for (const [i, { name, out }] of EDGES.entries()) {
    const group = `g${i + 1}`;
    const quaternion = orientation(out);
    const from: Pose<"frame", "tcp"> = pose(CORNERS[i]!, quaternion);
    const to: Pose<"frame", "tcp"> = pose(CORNERS[(i + 1) % 4]!, quaternion);
    const back: Pose<"tcp", "tcp"> = pose([0, 0, -LEAD_M]);
    const middle = transformPoint(cartonFromFrame, lerp(CORNERS[i]!, CORNERS[(i + 1) % 4]!, 0.5));
    const edge = edgeNearPoint(features, middle, NEAR_M)!.chain.id;
    move(group, `${name}, before`, "ptp", compose(from, back), { ratio: APPROACH_RATIO });
    const first = steps.length;
    move(group, `${name}, start`, "lin", from, TRACE);
    move(group, `${name}, end`, "lin", to, TRACE);
    groups[group] = {
      name,
      recipe: { object: carton.id, edge, edgeSteps: steps.slice(first).map(({ id }) => id) },
    };
    move(group, `${name}, after`, "lin", compose(to, back), TRACE);
  }
  steps.push(atHome(`s${steps.length + 1}`));
  const program: Program = {
    ...home,
    groups,
    steps,
    tools: { [tool.name]: tool.flangeFromTcp },
    frames: { [frame.name]: frame.worldFromFrame },
  };
  return { ...cell, name: "Traced carton", programs: [program] };
}
