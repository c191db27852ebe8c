import type { CellDocument } from "@twincell/project";
import { useFrame } from "@react-three/fiber";
import { type RefObject, useMemo } from "react";
import { type Group, Quaternion, Raycaster, Vector3 } from "three";
import { useStore } from "zustand";
import { traceStore } from "../../stores/trace.ts";
import type { Ray } from "../handle/drag-maths.ts";
import { chosenEdges, hoverEdges, nearestEdge, takeEdges } from "../pick/edges.ts";
import { nearestThing } from "../pick/raycast.ts";
import { toWorld } from "../world-space.ts";
import type { KeyAim } from "./grabber.ts";
import { feel } from "./haptics.ts";

/** So far off the ray an edge is taken for the one that is meant [rad]: 21 mm at 1.5 m. */
const TOLERANCE_RAD = 0.014;
const turn = new Quaternion();

/** While edges are chosen, the ray of the right hand shows the one it points at and the trigger takes it. */
export function EdgePointing(props: {
  readonly document: CellDocument;
  readonly world: RefObject<Group | null>;
  readonly origin: RefObject<Group | null>;
  readonly keys: KeyAim;
}) {
  const active = useStore(traceStore, state => state.active);
  return active ? <Pointing {...props} /> : null;
}

function Pointing({
  document,
  world,
  origin,
  keys,
}: {
  readonly document: CellDocument;
  readonly world: RefObject<Group | null>;
  readonly origin: RefObject<Group | null>;
  readonly keys: KeyAim;
}) {
  const work = useMemo(
    () => ({
      caster: new Raycaster(),
      ray: { origin: [0, 0, 0], direction: [0, 0, 0] } satisfies Ray,
      pressed: new WeakMap<XRInputSource, boolean>(),
      from: new Vector3(),
      way: new Vector3(),
    }),
    [],
  );
  useFrame(({ gl }, _dt, frame: XRFrame | undefined) => {
    const space = gl.xr.getReferenceSpace();
    const session = gl.xr.getSession();
    if (!frame || !space || !session || !origin.current || !world.current) return;
    if (keys.size > 0) {
      hoverEdges(null, []);
      return;
    }
    let shown = false;
    for (const source of session.inputSources) {
      const pose = frame.getPose(source.targetRaySpace, space);
      if (!pose) continue;
      const { position, orientation } = pose.transform;
      work.from.set(position.x, position.y, position.z).applyMatrix4(origin.current.matrixWorld);
      work.way
        .set(0, 0, -1)
        .applyQuaternion(turn.set(orientation.x, orientation.y, orientation.z, orientation.w))
        .transformDirection(origin.current.matrixWorld);
      work.caster.set(work.from, work.way);
      toWorld(work.from, work.ray.origin);
      toWorld(work.way, work.ray.direction);
      const depth_m = nearestThing(work.caster, world.current)?.hit.distance ?? Infinity;
      const picked = nearestEdge(document, work.ray, depth_m, TOLERANCE_RAD);
      const edges = picked ? chosenEdges(picked.object, picked.pick, traceStore.getState().wholeLoop) : [];
      const pressed = source.targetRayMode === "transient-pointer" || source.gamepad?.buttons[0]?.pressed === true;
      if (picked && !shown) {
        hoverEdges(picked.object.id, edges);
        shown = true;
      }
      if (picked && pressed && work.pressed.get(source) !== true) {
        takeEdges(edges);
        feel(source, "grasp");
      }
      work.pressed.set(source, pressed);
    }
    if (!shown) hoverEdges(null, []);
  }, -22);
  return null;
}
