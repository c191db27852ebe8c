import type { Pose, Vector3 as WorldVector } from "@twincell/core";
import { movedWith, type CellDocument, type Snapped } from "@twincell/project";
import { useThree } from "@react-three/fiber";
import { type RefObject, useEffect, useMemo } from "react";
import { type Group, Matrix4, Object3D, Quaternion, Vector3 } from "three";
import { TransformControls } from "three/examples/jsm/controls/TransformControls.js";
import { useStore } from "zustand";
import { buildStore, type BuildState } from "../../stores/build.ts";
import { commit } from "../../stores/document.ts";
import { selectionStore } from "../../stores/selection.ts";
import { words } from "../../messages/index.ts";
import { fixed } from "../../messages/numbers.ts";
import { type Interaction, type PointerLabel, sayAtPointer } from "../interaction.ts";
import { poseMatrix } from "../pose-matrix.ts";
import { snapped, takenOf, type Taken, withMoved } from "./moved.ts";
import { readTyped, typedOn } from "./typed.ts";

/** Share of three's own size, for 110 px on the screen. */
const SIZE = 0.85;
/** An object attracts within so many pixels of the screen, said as a share of the distance to the eye. */
const ATTRACTS_SHARE = 0.008;
const TURN_STEP_RAD = (5 * Math.PI) / 180;
/** Red, green, blue for x, y, z, and yellow for the handle that is held. */
const COLOURS = ["#ff6a5e", "#52c46a", "#5b9dff", "#ffd23f"] as const;
const LEAST_SCALE = 0.01;
const MODES = { move: "translate", turn: "rotate", scale: "scale" } as const;
const LETTERS = ["X", "Y", "Z"] as const;

/**
 * Handles on what is selected, to move, turn and scale it. While they are dragged the scene alone changes; letting go
 * makes one undo step. They hang on a pivot of their own in the group that holds the world, so that the axes are the
 * world's.
 */
export default function Gizmo({
  world,
  document,
  interaction,
  label,
}: {
  readonly world: RefObject<Group | null>;
  readonly document: CellDocument;
  readonly interaction: Interaction;
  readonly label: PointerLabel;
}) {
  const gl = useThree(state => state.gl);
  const camera = useThree(state => state.camera);
  const scene = useThree(state => state.scene);
  const orbit = useThree(state => state.controls);
  const invalidate = useThree(state => state.invalidate);
  const tool = useStore(buildStore, state => state.tool);
  const space = useStore(buildStore, state => state.space);
  const selection = useStore(selectionStore);
  const { selected, more } = selection;
  const taken = useMemo(() => takenOf(document, { selected, more, hovered: null }), [document, selected, more]);
  const mode = tool === "move" || tool === "turn" || tool === "scale" ? MODES[tool] : null;
  // Only one thing of a plain shape has an own size to change.
  const can = taken !== null && mode !== null && (mode !== "scale" || scales(taken));

  useEffect(() => {
    const root = world.current;
    if (!root || !can || mode === null || taken === null) return;
    const pivot = new Object3D();
    root.add(pivot);
    pivot.position.set(...taken.worldFromPivot.position);
    if (space === "local" || mode === "scale") pivot.quaternion.set(...taken.worldFromPivot.quaternion);
    const controls = new TransformControls(camera, gl.domElement);
    controls.setMode(mode);
    controls.setSpace("local");
    controls.setSize(SIZE);
    controls.setColors(...COLOURS);
    controls.attach(pivot);
    const helper = controls.getHelper();
    helper.userData.unpickable = true;
    scene.add(helper);
    const drag = new Drag(taken, pivot, controls, root, interaction, label);
    const enable = (on: boolean): void => {
      if (orbit && "enabled" in orbit) orbit.enabled = on;
    };
    let over = false;
    const begin = (): void => {
      over = false;
      enable(false);
      drag.begin();
      buildStore.setState({ dragging: true });
      window.addEventListener("keydown", onKey, { capture: true });
    };
    const end = (): void => {
      enable(true);
      window.removeEventListener("keydown", onKey, { capture: true });
      buildStore.setState({ dragging: false });
      over = true;
      drag.end();
    };
    const onKey = (event: KeyboardEvent): void => {
      if (!drag.key(event.key)) return;
      event.preventDefault();
      event.stopPropagation();
      invalidate();
    };
    const changed = (): void => {
      interaction.overGizmo = controls.axis !== null;
      invalidate();
    };
    controls.addEventListener("mouseDown", begin);
    controls.addEventListener("mouseUp", end);
    controls.addEventListener("objectChange", () => drag.moved());
    controls.addEventListener("change", changed);
    invalidate();
    return () => {
      if (controls.dragging && !over) {
        drag.cancel();
        end();
      }
      window.removeEventListener("keydown", onKey, { capture: true });
      interaction.overGizmo = false;
      controls.detach();
      helper.removeFromParent();
      controls.dispose();
      pivot.removeFromParent();
      invalidate();
    };
  }, [can, camera, gl, interaction, invalidate, label, mode, orbit, scene, space, taken, world]);
  return null;
}

const scales = ({ objects: [first, ...rest] }: Taken): boolean =>
  first !== undefined && rest.length === 0 && ["box", "cylinder", "revolved", "mesh"].includes(first.shape.kind);

const eye = new Vector3();

/** One drag of a handle, from taking it to letting it go. Numbers of the frame stay here. */
class Drag {
  private readonly taken: Taken;
  private readonly pivot: Object3D;
  private readonly controls: TransformControls;
  private readonly root: Group;
  private readonly interaction: Interaction;
  private readonly label: PointerLabel;
  private readonly start = { position: new Vector3(), quaternion: new Quaternion() };
  private readonly matrix = new Matrix4();
  private readonly size = new Matrix4();
  private typed = "";
  private given = false;

  constructor(
    taken: Taken,
    pivot: Object3D,
    controls: TransformControls,
    root: Group,
    interaction: Interaction,
    label: PointerLabel,
  ) {
    this.taken = taken;
    this.pivot = pivot;
    this.controls = controls;
    this.root = root;
    this.interaction = interaction;
    this.label = label;
  }

  begin(): void {
    this.typed = "";
    this.given = false;
    this.start.position.copy(this.pivot.position);
    this.start.quaternion.copy(this.pivot.quaternion);
  }

  /** The pointer moved a handle: what is attracted snaps, what was typed counts instead. */
  moved(): void {
    if (this.given) {
      this.restore();
      return;
    }
    const build = buildStore.getState();
    const free = !build.snap || this.interaction.shift;
    this.controls.setRotationSnap(free ? null : TURN_STEP_RAD);
    const typed = readTyped(this.typed);
    let onto: readonly Snapped[] = [];
    if (typed) this.apply(typed.value, typed.fromStart);
    else if (this.controls.mode === "translate" && !free) onto = this.snap(build);
    this.show();
    sayAtPointer(this.label, this.says(onto), "plain", this.interaction.px, this.interaction.py);
  }

  private snap(build: BuildState): readonly Snapped[] {
    const upright = this.start.quaternion.angleTo(new Quaternion()) < 1e-6;
    if (!upright) return this.snapAlong(build.grid_m);
    this.controls.camera.getWorldPosition(eye);
    const distance_m = eye.distanceTo(this.pivot.getWorldPosition(new Vector3()));
    const { add_m, onto } = snapped(this.taken, this.now(), {
      axes: this.axes(),
      grid_m: build.grid_m,
      tolerance_m: Math.max(0.004, distance_m * ATTRACTS_SHARE),
    });
    this.pivot.position.add(new Vector3(...add_m));
    return onto;
  }
  /** Along its own axes, the way since the start is counted in steps of the grid. */
  private snapAlong(step_m: number): readonly Snapped[] {
    if (step_m <= 0) return [];
    const way = this.pivot.position
      .clone()
      .sub(this.start.position)
      .applyQuaternion(this.start.quaternion.clone().invert());
    for (const k of [0, 1, 2] as const) way.setComponent(k, Math.round(way.getComponent(k) / step_m) * step_m);
    this.pivot.position.copy(this.start.position).add(way.applyQuaternion(this.start.quaternion));
    return [];
  }

  private axes(): readonly (0 | 1 | 2)[] {
    const axis: string = this.controls.axis ?? "";
    return ([0, 1, 2] as const).filter(k => axis.includes(LETTERS[k]));
  }

  /**
   * A typed number: millimetres or degrees. Along an axis of the world it is the new coordinate, else the way since the
   * start.
   */
  private apply(value: number, fromStart: boolean): void {
    const [axis] = this.axes();
    if (axis === undefined) return;
    const unit = new Vector3().setComponent(axis, 1);
    if (this.controls.mode === "translate") {
      const along = unit.applyQuaternion(this.start.quaternion);
      const world = this.start.quaternion.angleTo(new Quaternion()) < 1e-6;
      const from = world && !fromStart ? this.start.position.getComponent(axis) : 0;
      this.pivot.position.copy(this.start.position).addScaledVector(along, value / 1000 - from);
    } else if (this.controls.mode === "rotate") {
      const turn = new Quaternion().setFromAxisAngle(unit, (value * Math.PI) / 180);
      this.pivot.quaternion.copy(this.start.quaternion).multiply(turn);
    } else this.pivot.scale.setComponent(axis, Math.max(LEAST_SCALE, value / 100));
  }

  /** @returns whether the key was meant for the drag. */
  key(key: string): boolean {
    if (key === "Escape") {
      this.cancel();
      return true;
    }
    if (key === "Enter") {
      this.commit();
      this.given = true;
      return true;
    }
    const next = typedOn(this.typed, key);
    if (next === null) return false;
    this.typed = next;
    this.moved();
    return true;
  }

  /** Puts everything back where it was; the rest of the drag does nothing. */
  cancel(): void {
    this.given = true;
    this.restore();
    this.show();
  }
  private restore(): void {
    this.pivot.position.copy(this.start.position);
    this.pivot.quaternion.copy(this.start.quaternion);
    this.pivot.scale.set(1, 1, 1);
  }

  end(): void {
    sayAtPointer(this.label, "", "plain", 0, 0);
    if (!this.given) this.commit();
  }

  private commit(): void {
    const after = this.now();
    const scale = this.scale();
    const same =
      this.pivot.position.distanceTo(this.start.position) < 1e-9 &&
      this.pivot.quaternion.angleTo(this.start.quaternion) < 1e-9 &&
      scale.every(value => value === 1);
    if (same) return;
    const name = this.controls.mode === "scale" ? words.undo.scale : words.undo.moveObject;
    commit(name, before => withMoved(before, this.taken, after, scale));
  }

  private scale(): WorldVector {
    const { x, y, z } = this.pivot.scale;
    return [Math.max(LEAST_SCALE, x), Math.max(LEAST_SCALE, y), Math.max(LEAST_SCALE, z)];
  }
  /** Where the pivot of what was taken is now: the handles may be turned otherwise than it is. */
  private now(): Pose<"world", "pivot"> {
    const turn = this.pivot.quaternion.clone().multiply(this.start.quaternion.clone().invert());
    const [x, y, z, w] = this.taken.worldFromPivot.quaternion;
    const after = turn.multiply(new Quaternion(x, y, z, w)).normalize();
    const { x: px, y: py, z: pz } = this.pivot.position;
    return { position: [px, py, pz], quaternion: [after.x, after.y, after.z, after.w] };
  }

  /** Draws what is dragged where it is now, without the document. */
  private show(): void {
    const after = this.now();
    const scale = this.scale();
    for (const { id, worldFromObject } of this.taken.objects) {
      const group = this.root.children.find(
        child => child.userData.thing?.kind === "object" && child.userData.thing.id === id,
      );
      if (!group) continue;
      poseMatrix(movedWith(worldFromObject, this.taken.worldFromPivot, after), this.matrix);
      group.matrix.copy(this.matrix).multiply(this.size.makeScale(...scale));
      group.matrixWorldNeedsUpdate = true;
    }
  }

  /** The axis, the new value and the way since the start, and onto what it snapped. */
  private says(onto: readonly Snapped[]): string {
    const typed = this.typed === "" ? "" : `  ⌨ ${this.typed}`;
    if (this.controls.mode === "translate") {
      const parts = this.axes().map(k => {
        const at_mm = this.pivot.position.getComponent(k) * 1000;
        const by_mm = at_mm - this.start.position.getComponent(k) * 1000;
        return `${LETTERS[k]} ${number(at_mm)} (${by_mm < 0 ? "" : "+"}${number(by_mm)}) mm`;
      });
      const found = onto
        .filter(({ kind }) => kind !== "grid")
        .map(({ kind, name }) =>
          kind === "face" || kind === "middle" ? words.build.onto[kind](name) : words.build.onto.floor,
        );
      return [...parts, ...found].join(" · ") + typed;
    }
    if (this.controls.mode === "rotate") {
      const angle = (this.pivot.quaternion.angleTo(this.start.quaternion) * 180) / Math.PI;
      return `R${(this.controls.axis ?? "").toLowerCase()} ${number(angle)}°${typed}`;
    }
    return (
      this.scale()
        .map((value, k) => `${LETTERS[k]} ${number(value * 100)} %`)
        .join(" · ") + typed
    );
  }
}
const number = (value: number): string => fixed(Math.abs(value) < 0.05 ? 0 : value, 1).replace("-", "−");
