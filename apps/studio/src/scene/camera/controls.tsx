import { OrbitControls } from "@react-three/drei";
import type { CellDocument } from "@twincell/project";
import { useFrame, useThree } from "@react-three/fiber";
import { type ComponentRef, type RefObject, useEffect, useMemo, useRef } from "react";
import { type Group, PerspectiveCamera, TOUCH, Vector3 } from "three";
import { useStore } from "zustand";
import { markerViewStore } from "../../stores/marker-view.ts";
import { viewStore } from "../../stores/view.ts";
import type { Interaction } from "../interaction.ts";
import { contentBounds, fitDistance } from "./bounds.ts";
import { turnedView } from "./turned-view.ts";

/** From the front, a little to the robot's right and above: scene coordinates. */
const FIRST_LOOK = new Vector3(-1, -0.42, -0.62);
const FLIGHT_MS = 260;
/** After a pause the view does not jump [s]. */
const LONGEST_S = 0.05;

/** What the buttons around the viewport ask of its camera. */
export interface CameraWishes {
  fit: () => void;
  look: (direction: Vector3) => void;
}

/** Orbit, pan, zoom, and short flights to a wished view. One finger is left for selecting; two turn and zoom. */
export function Controls({
  wishes,
  world,
  document,
  interaction,
}: {
  readonly wishes: CameraWishes;
  readonly world: RefObject<Group | null>;
  readonly document: CellDocument;
  readonly interaction: Interaction;
}) {
  const controls = useRef<ComponentRef<typeof OrbitControls>>(null);
  const camera = useThree(state => state.camera);
  const size = useThree(state => state.size);
  const invalidate = useThree(state => state.invalidate);
  const close = useStore(viewStore, state => state.camera === "close");
  const inHeadset = useStore(viewStore, state => state.inHeadset);
  const onMarker = useStore(markerViewStore, state => state.on);
  const flight = useMemo(
    () => ({
      start_ms: 0,
      on: false,
      fromPlace: new Vector3(),
      fromTarget: new Vector3(),
      place: new Vector3(),
      target: new Vector3(),
    }),
    [],
  );
  const seen = useRef("");
  const pending = useRef<(() => void) | null>(null);

  useEffect(() => {
    if (!(camera instanceof PerspectiveCamera)) return;
    camera.fov = size.width < size.height * 1.1 ? 40 : 32;
    camera.updateProjectionMatrix();
  }, [camera, size]);

  useEffect(() => {
    const fly = (place: Vector3, target: Vector3, atOnce: boolean): void => {
      const orbit = controls.current;
      if (!orbit) return;
      flight.fromPlace.copy(camera.position);
      flight.fromTarget.copy(orbit.target);
      flight.place.copy(place);
      flight.target.copy(target);
      const still = window.matchMedia("(prefers-reduced-motion: reduce)").matches;
      flight.start_ms = atOnce || still ? -Infinity : performance.now();
      flight.on = true;
      invalidate();
    };
    const towards = (direction: Vector3, atOnce: boolean): void => {
      if (!world.current || !(camera instanceof PerspectiveCamera)) return;
      const bounds = contentBounds(world.current, document);
      const centre = bounds.getCenter(new Vector3());
      fly(
        centre.clone().addScaledVector(direction.clone().normalize(), -fitDistance(bounds, direction, camera)),
        centre,
        atOnce,
      );
    };
    // With the next frame: what has just come stands in its place only then.
    wishes.fit = () => {
      pending.current = () => {
        const orbit = controls.current;
        if (orbit) towards(orbit.target.clone().sub(camera.position), false);
      };
      invalidate();
    };
    wishes.look = direction => towards(direction, false);
    // Another cell is another place: look at all of it once.
    const place = `${document.name} ${document.robot.id} ${document.objects.length > 0}`;
    if (seen.current !== place) {
      seen.current = place;
      pending.current = () => towards(FIRST_LOOK, true);
      invalidate();
    }
  }, [camera, document, flight, invalidate, wishes, world]);

  useEffect(
    () =>
      viewStore.subscribe(({ turning }, before) => {
        if (turning !== before.turning) invalidate();
      }),
    [invalidate],
  );
  useFrame((_state, dt_s) => {
    const orbit = controls.current;
    const { turning } = viewStore.getState();
    if (orbit && (turning[0] !== 0 || turning[1] !== 0) && !close && !inHeadset && !onMarker) {
      flight.on = false;
      turnedView(camera.position, orbit.target, turning, Math.min(dt_s, LONGEST_S));
      orbit.update();
      interaction.dirty = true;
      invalidate();
    }
    pending.current?.();
    pending.current = null;
    if (!flight.on || !orbit || onMarker) return;
    const t = Math.min(1, (performance.now() - flight.start_ms) / FLIGHT_MS);
    const eased = 1 - (1 - t) ** 3;
    camera.position.lerpVectors(flight.fromPlace, flight.place, eased);
    orbit.target.lerpVectors(flight.fromTarget, flight.target, eased);
    orbit.update();
    interaction.dirty = true;
    if (t < 1) invalidate();
    else flight.on = false;
  }, -6);

  return (
    <OrbitControls
      ref={controls}
      makeDefault
      enabled={!close && !inHeadset && !onMarker}
      enableDamping={false}
      minDistance={0.15}
      maxDistance={14}
      maxPolarAngle={Math.PI * 0.94}
      zoomToCursor
      touches={{ TWO: TOUCH.DOLLY_ROTATE }}
      onStart={() => {
        flight.on = false;
      }}
      onChange={() => {
        interaction.dirty = true;
      }}
    />
  );
}
