import { partById, partNumbers, shapeBounds, toGrid } from "@twincell/project";
import type { Vector3 as WorldVector } from "@twincell/core";
import { useThree } from "@react-three/fiber";
import { type RefObject, useEffect } from "react";
import {
  BoxGeometry,
  EdgesGeometry,
  type Group,
  LineBasicMaterial,
  LineSegments,
  Plane,
  Raycaster,
  Vector2,
  Vector3,
} from "three";
import { placePart } from "../../runtime/parts.ts";
import { buildStore } from "../../stores/build.ts";
import { nearestThing } from "../pick/raycast.ts";
import { toWorld } from "../world-space.ts";

/** A face that leans more than this is no place to stand on: cosine to the vertical. */
const UPRIGHT = 0.7;
const FLOOR = new Plane(new Vector3(0, 1, 0), 0);
const GUIDE = "#ff6bb5";

/**
 * Takes parts that are dragged from the library into the view: a frame shows where one will stand, on the floor or on
 * what is there.
 */
export function PartDrop({ world }: { readonly world: RefObject<Group | null> }) {
  const gl = useThree(state => state.gl);
  const camera = useThree(state => state.camera);
  const invalidate = useThree(state => state.invalidate);
  useEffect(() => {
    const canvas = gl.domElement;
    const caster = new Raycaster();
    const at = new Vector2();
    const spot = new Vector3();
    const normal = new Vector3();
    let frame: LineSegments | null = null;
    let shown = "";

    const under = (event: DragEvent): WorldVector | null => {
      const box = canvas.getBoundingClientRect();
      at.set(((event.clientX - box.left) / box.width) * 2 - 1, 1 - ((event.clientY - box.top) / box.height) * 2);
      caster.setFromCamera(at, camera);
      const hit = world.current ? nearestThing(caster, world.current)?.hit : undefined;
      const stands =
        hit?.face !== undefined && hit.face !== null
          ? normal.copy(hit.face.normal).transformDirection(hit.object.matrixWorld).y > UPRIGHT
          : false;
      const found = hit && stands ? spot.copy(hit.point) : caster.ray.intersectPlane(FLOOR, spot);
      if (!found) return null;
      const place = toWorld(spot, [0, 0, 0]);
      const { snap, grid_m } = buildStore.getState();
      const step = snap && !event.shiftKey ? grid_m : 0;
      return [toGrid(place[0], step), toGrid(place[1], step), Math.max(0, place[2])];
    };
    const leave = (): void => {
      frame?.removeFromParent();
      frame?.geometry.dispose();
      frame = null;
      shown = "";
      invalidate();
    };
    const frameOf = (part: string): LineSegments | null => {
      const kind = partById(part);
      if (!kind) return null;
      const { lower, upper } = shapeBounds({ kind: "part", part, parameters: partNumbers(kind, {}) });
      const size = upper.map((value, k) => value - lower[k]!);
      const box = new BoxGeometry(size[0], size[1], size[2]);
      box.translate((lower[0] + upper[0]) / 2, (lower[1] + upper[1]) / 2, (lower[2] + upper[2]) / 2);
      const lines = new LineSegments(
        new EdgesGeometry(box),
        new LineBasicMaterial({ color: GUIDE, toneMapped: false }),
      );
      box.dispose();
      lines.raycast = () => undefined;
      lines.userData.unpickable = true;
      return lines;
    };
    const over = (event: DragEvent): void => {
      const { carrying } = buildStore.getState();
      if (carrying === null) return;
      event.preventDefault();
      if (event.dataTransfer) event.dataTransfer.dropEffect = "copy";
      if (shown !== carrying) {
        leave();
        frame = frameOf(carrying);
        shown = carrying;
        if (frame) world.current?.add(frame);
      }
      const place = under(event);
      if (frame) frame.visible = place !== null;
      if (place) frame?.position.set(...place);
      invalidate();
    };
    const drop = (event: DragEvent): void => {
      const { carrying } = buildStore.getState();
      if (carrying === null) return;
      event.preventDefault();
      leave();
      const place = under(event);
      buildStore.setState({ carrying: null });
      if (place) placePart(carrying, place);
    };
    canvas.addEventListener("dragover", over);
    canvas.addEventListener("dragleave", leave);
    canvas.addEventListener("drop", drop);
    return () => {
      canvas.removeEventListener("dragover", over);
      canvas.removeEventListener("dragleave", leave);
      canvas.removeEventListener("drop", drop);
      leave();
    };
  }, [gl, camera, world, invalidate]);
  return null;
}
