import { compose, copyPose, identity, inverse, type Pose, rotate, type Vector3 } from "@twincell/core";
import { groupOf, type CellDocument } from "@twincell/project";
import { useFrame, useThree } from "@react-three/fiber";
import { type RefObject, useEffect, useMemo } from "react";
import { type Group, type Mesh, PerspectiveCamera, Raycaster, Vector3 as V } from "three";
import { beginDrag, dragTcp } from "../../runtime/jog/drag.ts";
import { theLive } from "../../runtime/live.ts";
import { lookAt } from "../../runtime/planning/look-at.ts";
import { alsoSelect, hover, select, selectionStore, selectObjects, type Thing } from "../../stores/selection.ts";
import { buildStore } from "../../stores/build.ts";
import { pickToMate } from "../../stores/mate.ts";
import { pickToMeasure } from "../../stores/measure.ts";
import { pickForRig } from "../../stores/rig.ts";
import { hoverSurface, picksSurfaces, surfaceStore } from "../../stores/surface.ts";
import { jogStore } from "../../stores/jog.ts";
import { playStore } from "../../stores/play.ts";
import { pointAt } from "../../stores/together.ts";
import { traceStore } from "../../stores/trace.ts";
import { viewStore } from "../../stores/view.ts";
import type { FrameMeter } from "../frame-meter.ts";
import { dragged, restrained, type Grip, type Ray } from "../handle/drag-maths.ts";
import { handleAxes } from "../handle/tcp-handle.tsx";
import { type HandlePart, type Interaction, type PointerLabel, sayAtPointer } from "../interaction.ts";
import { toWorld } from "../world-space.ts";
import { HandWatch } from "../handle/hand-watch.ts";
import { theRobot } from "../../stores/document.ts";
import { WORDS } from "../words.ts";
import { chosenEdges, hoverEdges, nearestEdge, takeEdges } from "./edges.ts";
import { measurePoint } from "./measure-point.ts";
import { surfaceUnder } from "./surface.ts";
import { pathUnder } from "./path-under.ts";
import { nearestThing } from "./raycast.ts";
import { thingWords } from "./thing-words.ts";
import { fixed } from "../../messages/numbers.ts";
import { say } from "../../messages/index.ts";

const CLICK_PX = 5;
const EDGE_TOLERANCE_PX = 9;
const SNAP_M = 0.005;
/** Corners and edges this near to the pointer are picked to be measured: a share of the distance to the eye. */
const MEASURE_SHARE = 0.012;
const SNAP_RAD = (5 * Math.PI) / 180;

/** Says what is under the pointer, selects it, drags the handle, chooses edges. One look per frame at most. */
export function Pointer({
  interaction,
  label,
  world,
  handle,
  document,
  meter,
}: {
  readonly interaction: Interaction;
  readonly label: PointerLabel;
  readonly world: RefObject<Group | null>;
  readonly handle: { current: readonly Mesh[] };
  readonly document: CellDocument;
  readonly meter: FrameMeter;
}) {
  const gl = useThree(state => state.gl);
  const camera = useThree(state => state.camera);
  const controls = useThree(state => state.controls);
  const invalidate = useThree(state => state.invalidate);
  const work = useMemo(
    () => ({
      caster: new Raycaster(),
      ray: { origin: [0, 0, 0], direction: [0, 0, 1] } as { origin: Vector3; direction: Vector3 },
      view: new V(),
      grip: null as Grip | null,
      end: (): void => undefined,
      downX: 0,
      downY: 0,
      down: false,
      touches: 0,
      pose: identity<"world", "tcp">(),
    }),
    [],
  );

  useEffect(() => {
    const canvas = gl.domElement;
    const place = (event: PointerEvent): void => {
      const box = canvas.getBoundingClientRect();
      interaction.px = event.clientX - box.left;
      interaction.py = event.clientY - box.top;
      interaction.ndc.set((interaction.px / box.width) * 2 - 1, 1 - (interaction.py / box.height) * 2);
      interaction.inside = true;
      interaction.shift = event.shiftKey;
      interaction.dirty = true;
    };
    const timed =
      (react: (event: PointerEvent) => void) =>
      (event: PointerEvent): void => {
        const start = performance.now();
        react(event);
        meter.addScript(performance.now() - start);
        invalidate();
      };
    const enable = (on: boolean): void => {
      if (controls && "enabled" in controls) controls.enabled = on;
    };
    const onDown = timed(event => {
      place(event);
      if (event.pointerType === "touch") work.touches++;
      work.down = true;
      work.downX = event.clientX;
      work.downY = event.clientY;
      if (event.button !== 0 || work.touches > 1) {
        drop();
        return;
      }
      look();
      const part = interaction.hoveredPart;
      if (!part) return;
      enable(false); // before the camera's own listener hears of it
      const { worldFromTcp } = theLive();
      work.grip = {
        part,
        worldFromTcp: copyPose(worldFromTcp),
        axes: [...(handleAxes(worldFromTcp) ?? [0, 0, 0, 1])],
        ray: { origin: [...work.ray.origin], direction: [...work.ray.direction] },
        view: toWorld(camera.getWorldDirection(work.view), [0, 0, 0]),
      };
      interaction.draggedPart = part;
      work.end = beginDrag(drop);
      canvas.setPointerCapture(event.pointerId);
    });
    const onMove = timed(event => {
      place(event);
      interaction.turning =
        work.down &&
        !work.grip &&
        event.buttons !== 0 &&
        Math.hypot(event.clientX - work.downX, event.clientY - work.downY) > CLICK_PX;
    });
    const drop = (): void => {
      if (!work.grip) return;
      work.grip = null;
      interaction.draggedPart = null;
      interaction.wanting = false;
      interaction.dirty = true;
      enable(true);
      work.end();
      sayAtPointer(label, "", "plain", 0, 0);
    };
    const onUp = timed(event => {
      if (event.pointerType === "touch") work.touches = Math.max(0, work.touches - 1);
      const held = work.grip !== null;
      const click =
        work.down &&
        event.button === 0 &&
        Math.hypot(event.clientX - work.downX, event.clientY - work.downY) <= CLICK_PX;
      drop();
      work.down = false;
      interaction.turning = false;
      if (click && !held && !interaction.overGizmo) {
        place(event);
        look();
        choose(event.ctrlKey || event.metaKey || event.shiftKey);
      }
      if (event.pointerType === "touch") leave();
    });
    const leave = (): void => {
      pointAt(null);
      interaction.inside = false;
      interaction.hoveredPart = null;
      if (selectionStore.getState().hovered) hover(null);
      if (traceStore.getState().hovered) traceStore.setState({ hovered: null });
      hoverSurface(null);
      sayAtPointer(label, "", "plain", 0, 0);
      canvas.style.cursor = "";
      invalidate();
    };
    const onCancel = (event: PointerEvent): void => {
      if (event.pointerType === "touch") work.touches = 0;
      work.down = false;
      drop();
      leave();
    };
    const onLeave = (): void => {
      if (!work.grip) leave();
    };
    canvas.addEventListener("pointerdown", onDown, { capture: true });
    canvas.addEventListener("pointermove", onMove);
    canvas.addEventListener("pointerup", onUp);
    canvas.addEventListener("pointercancel", onCancel);
    canvas.addEventListener("pointerleave", onLeave);
    const onBlur = (): void => {
      drop();
    };
    window.addEventListener("blur", onBlur);
    return () => {
      canvas.removeEventListener("pointerdown", onDown, { capture: true });
      canvas.removeEventListener("pointermove", onMove);
      canvas.removeEventListener("pointerup", onUp);
      canvas.removeEventListener("pointercancel", onCancel);
      canvas.removeEventListener("pointerleave", onLeave);
      window.removeEventListener("blur", onBlur);
      drop();
    };
  });

  /** The pointer's ray in the world, and in `work.caster` in the scene. */
  const aim = (): Ray => {
    work.caster.setFromCamera(interaction.ndc, camera);
    toWorld(work.caster.ray.origin, work.ray.origin);
    toWorld(work.caster.ray.direction, work.ray.direction);
    return work.ray;
  };

  /** What is under the pointer now: a part of the handle, an edge to trace, or a thing. */
  const look = (): void => {
    interaction.dirty = false;
    const root = world.current;
    if (!root || viewStore.getState().camera !== "main") return;
    const ray = aim();
    const part = partUnder(work.caster, handle.current);
    interaction.hoveredPart = part;
    if (interaction.overGizmo) {
      if (selectionStore.getState().hovered) hover(null);
      sayAtPointer(label, "", "plain", 0, 0);
      gl.domElement.style.cursor = "grab";
      return;
    }
    const found = part !== null ? null : nearestThing(work.caster, root);
    const thing: Thing | null = found?.holder.userData.thing ?? null;
    pointAt(found ? toWorld(found.hit.point, [0, 0, 0]) : null);
    if (traceStore.getState().active) lookForEdge(ray, found?.hit.distance ?? Infinity, part !== null);
    if (picksSurfaces()) hoverSurface(found ? surfaceUnder(document, found, found.hit.distance * MEASURE_SHARE) : null);
    const { hovered } = selectionStore.getState();
    if (JSON.stringify(hovered) !== JSON.stringify(thing)) hover(thing);
    const edge = traceStore.getState().hovered;
    const text = part !== null ? WORDS.handle[part] : edge ? "" : thing ? thingWords(thing, document) : "";
    sayAtPointer(label, text, "plain", interaction.px, interaction.py);
    gl.domElement.style.cursor = part !== null ? "grab" : edge || thing || pathAt(ray) ? "pointer" : "";
  };

  /** In Check mode: the place of the path under the pointer. */
  const pathAt = (ray: Ray) =>
    viewStore.getState().mode === "check" ? pathUnder(playStore.getState().path, ray, tolerance_rad()) : undefined;

  const lookForEdge = (ray: Ray, depth_m: number, hidden: boolean): void => {
    const picked = hidden ? null : edgeAt(ray, depth_m);
    const whole = interaction.shift || traceStore.getState().wholeLoop;
    hoverEdges(picked?.object.id ?? null, picked ? chosenEdges(picked.object, picked.pick, whole) : []);
  };
  /** How far off the pointer a line may be seen. */
  const tolerance_rad = (): number => {
    const fov = camera instanceof PerspectiveCamera ? (camera.fov * Math.PI) / 180 : 0.6;
    return (EDGE_TOLERANCE_PX * fov) / gl.domElement.clientHeight;
  };
  const edgeAt = (ray: Ray, depth_m: number) => nearestEdge(document, ray, depth_m, tolerance_rad());

  /** A click: takes the edge while edges are being chosen, selects the thing otherwise. */
  const choose = (more: boolean): void => {
    const trace = traceStore.getState();
    if (!trace.active) {
      const place = pathAt(aim());
      if (place) {
        lookAt(place.step, place.at_s);
        return;
      }
      const { hovered } = selectionStore.getState();
      if (viewStore.getState().mode === "cell" && buildStore.getState().tool === "measure") {
        const found = world.current ? nearestThing(work.caster, world.current) : null;
        if (found) pickToMeasure(measurePoint(document, found, found.hit.distance * MEASURE_SHARE));
        return;
      }
      if (picksSurfaces()) {
        const { hovered: surface } = surfaceStore.getState();
        if (surface && buildStore.getState().tool === "rig") pickForRig(surface);
        else if (surface) pickToMate(surface);
        return;
      }
      if (more && viewStore.getState().mode === "cell") {
        if (hovered?.kind === "object") alsoSelect(hovered.id);
      } else if (hovered?.kind === "object" && viewStore.getState().mode === "cell")
        selectObjects(groupOf(document, hovered.id));
      else select(hovered);
      return;
    }
    const hit = world.current ? nearestThing(work.caster, world.current) : null;
    const picked = edgeAt(aim(), hit?.hit.distance ?? Infinity);
    if (!picked) return;
    takeEdges(chosenEdges(picked.object, picked.pick, interaction.shift || trace.wholeLoop));
  };

  useFrame(() => {
    if (gl.xr.isPresenting) return;
    if (work.grip) {
      drag(work.grip);
      return;
    }
    if (interaction.dirty && interaction.inside && !interaction.turning) look();
  }, -20);

  const drag = (grip: Grip): void => {
    dragged(grip, aim(), interaction.shift ? SNAP_M : 0, interaction.shift ? SNAP_RAD : 0, interaction.wanted);
    const { dragScale, locks } = jogStore.getState();
    restrained(grip, dragScale, locks, interaction.wanted);
    const outcome = dragTcp(interaction.wanted);
    interaction.wanting = outcome.kind === "blocked";
    if (outcome.kind === "on-the-way") invalidate();
    gl.domElement.style.cursor = "grabbing";
    sayAtPointer(
      label,
      outcome.kind === "blocked"
        ? say(outcome.sentence)
        : `${moveWords(grip, theLive().worldFromTcp)}  ${watched(theLive())}`,
      outcome.kind === "blocked" ? "blocked" : "plain",
      interaction.px,
      interaction.py,
    );
  };
  return null;
}

/** Where parts of the handle cover one another, what is smaller wins: the ball, then arrows, squares, rings. */
function partUnder(caster: Raycaster, targets: readonly Mesh[]): HandlePart | null {
  let best: HandlePart | null = null;
  let rank = Infinity;
  for (const target of targets) {
    const part: HandlePart = target.userData.part;
    const ranked = part === "free" ? 0 : part.length === 1 ? 1 : part.startsWith("r") ? 3 : 2;
    if (ranked < rank && caster.intersectObject(target, false).length > 0) {
      best = part;
      rank = ranked;
    }
  }
  return best;
}

/** How far the tool went since it was taken, in the coordinate that is dragged. */
function moveWords(grip: Grip, now: Pose<"world", "tcp">): string {
  const delta = [0, 1, 2].map(i => (now.position[i]! - grip.worldFromTcp.position[i]!) * 1000);
  if (!grip.part.startsWith("r")) {
    const local = rotate(
      [-grip.axes[0], -grip.axes[1], -grip.axes[2], grip.axes[3]],
      [delta[0]!, delta[1]!, delta[2]!],
    );
    const axes = grip.part === "free" ? "xyz" : grip.part;
    return [...axes].map(axis => `Δ${axis.toUpperCase()} ${signed(local["xyz".indexOf(axis)]!)} mm`).join("  ");
  }
  const turn = compose(now, inverse(grip.worldFromTcp)).quaternion;
  const axis = rotate(grip.axes, [grip.part === "rx" ? 1 : 0, grip.part === "ry" ? 1 : 0, grip.part === "rz" ? 1 : 0]);
  const angle = 2 * Math.atan2(turn[0] * axis[0] + turn[1] * axis[1] + turn[2] * axis[2], turn[3]);
  return `ΔR${grip.part[1]!.toUpperCase()} ${signed((Math.atan2(Math.sin(angle), Math.cos(angle)) * 180) / Math.PI)}°`;
}
/** How fast the joints are dragged, against what the robot can: named when it is too fast (rows L-26, L-33). */
const watch = new HandWatch();
function watched({ q_rad, revision }: { readonly q_rad: Float64Array; readonly revision: number }): string {
  const robot = theRobot();
  if (!robot) return "";
  const fastest = watch.look(robot.arm.joints, q_rad, revision, performance.now());
  if (fastest === null) return "";
  return fastest.share > 1
    ? WORDS.tooFast(fastest.joint, Math.round(fastest.share * 100))
    : WORDS.handSpeed(Math.round(fastest.share * 100));
}
const signed = (value: number): string => `${value < -0.05 ? "−" : "+"}${fixed(Math.abs(value), 1)}`;
