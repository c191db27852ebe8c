import {
  compose,
  emptyProgram,
  identity,
  inverse,
  rotate,
  type CallStep,
  type Group,
  type Pallet,
  type Pose,
  type Program,
  type Quaternion,
  type Robot,
  type Step,
  type TextFault,
  type Vector3,
} from "@twincell/core";
import { proveText } from "../../prove.ts";
import { interpretWhole } from "../interpret.ts";
import { fromTrans, toPose } from "../run/transform.ts";
import { TextError } from "../../parser/index.ts";
import { outlineOf, type Node, type Pattern, type Structure } from "./outline.ts";

type Structured =
  | { readonly kind: "program"; readonly program: Program }
  | { readonly kind: "not-understood"; readonly faults: readonly TextFault[] };

/**
 * The program of a text with its loops, calls, decisions and pallets. The lines between them are executed once, from
 * top to bottom, which says what each of them does; then the whole is compared with the text being executed. Undefined
 * when the structure is no neutral program's, or does not mean the same: then only executing it says what it does.
 */
export function structuredProgram(
  text: string,
  lines: readonly string[],
  robot: Robot,
  worldFromBase: Pose<"world", "base">,
  name: string,
): Structured | undefined {
  const structure = outlineOf(lines);
  if (structure === undefined) return undefined;
  const interpreted = interpretWhole(structure.flat, robot, worldFromBase);
  const steps = new Map<number, Step[]>();
  if (interpreted.kind === "not-understood") return structure.plain ? interpreted : undefined;
  try {
    const run = interpreted.run();
    for (let next = run.next(); next.done !== true; next = run.next()) {
      const { line, step } = next.value;
      if (step !== undefined) steps.set(line, [...(steps.get(line) ?? []), step]);
    }
  } catch (cause) {
    if (!(cause instanceof TextError)) throw cause;
    return structure.plain ? { kind: "not-understood", faults: [cause.fault] } : undefined;
  }
  const builder = new Builder(structure, steps, lines, compose(worldFromBase, robot.baseFromVendorWorld));
  const main = builder.list(structure.main, []);
  const routines = Object.fromEntries(
    Array.from(structure.programs.values(), ({ title, outline }) => [title, builder.routine(outline)]),
  );
  const { groups, pallets, frames, signals } = builder;
  const program: Program = {
    ...emptyProgram(robot.id, name),
    tools: interpreted.context.tools,
    frames,
    groups,
    pallets,
    routines,
    signals: { ...signals, ...interpreted.context.signals },
    steps: main,
  };
  if (structure.plain) return { kind: "program", program };
  const proof = proveText({ interpret: interpretWhole }, { name: "", text }, program, robot, worldFromBase);
  return proof.kind === "proven" ? { kind: "program", program } : undefined;
}

/** Makes steps of an outline. */
class Builder {
  readonly groups: Record<string, Group> = {};
  readonly pallets: Record<string, Pallet> = {};
  readonly frames: Record<string, Pose<"world", "frame">> = {};
  readonly signals: Record<string, Program["signals"][string]> = {};
  private readonly structure: Structure;
  private readonly stepsOf: ReadonlyMap<number, readonly Step[]>;
  private readonly lines: readonly string[];
  private readonly worldFromVendor: Pose<"world", "vendor-world">;
  private count = 0;
  private name = "";
  private group: string | undefined;

  constructor(
    structure: Structure,
    stepsOf: ReadonlyMap<number, readonly Step[]>,
    lines: readonly string[],
    worldFromVendor: Pose<"world", "vendor-world">,
  ) {
    this.structure = structure;
    this.stepsOf = stepsOf;
    this.lines = lines;
    this.worldFromVendor = worldFromVendor;
  }

  routine(outline: readonly Node[]): readonly Step[] {
    this.group = undefined;
    this.name = "";
    return this.list(outline, []);
  }

  /** @param places  variables of the pallets around. */
  list(outline: readonly Node[], places: readonly string[]): readonly Step[] {
    return outline.flatMap(node => this.node(node, places));
  }

  private node(node: Node, places: readonly string[]): readonly Step[] {
    switch (node.kind) {
      case "name":
        if (node.text !== "") this.name = node.text;
        return [];
      case "group":
        this.group = node.text === "" ? undefined : `g${Object.keys(this.groups).length + 1}`;
        if (this.group !== undefined) this.groups[this.group] = { name: node.text };
        return [];
      case "comment":
        return [{ ...this.base(), type: "comment", text: node.text }];
      case "line":
        return (this.stepsOf.get(node.line) ?? []).map(step =>
          this.atPlace({ ...step, ...this.base() }, node.line, places),
        );
      case "call": {
        const call: CallStep = {
          ...this.base(),
          type: "call",
          routine: this.structure.programs.get(node.program)?.title ?? node.program,
        };
        return [call];
      }
      case "stop":
        return [{ ...this.base(), type: "stop" }];
      case "repeat":
        return [{ ...this.base(), type: "repeat", times: node.times, steps: this.list(node.inside, places) }];
      case "if": {
        const base = this.base();
        const when = { signal: this.signal(node.signal), is: node.is };
        const then = this.list(node.then, places);
        return [
          {
            ...base,
            type: "if",
            when,
            then,
            ...(node.else === undefined ? {} : { else: this.list(node.else, places) }),
          },
        ];
      }
      case "pallet": {
        const base = this.base();
        const { place } = node.pattern;
        this.pallets[place] = this.pallet(node.pattern);
        return [{ ...base, type: "pallet", pallet: place, steps: this.list(node.inside, [...places, place]) }];
      }
    }
  }

  private base(): { readonly id: string; readonly name?: string; readonly group?: string } {
    const { name, group } = this;
    this.name = "";
    return { id: `s${++this.count}`, ...(name === "" ? {} : { name }), ...(group === undefined ? {} : { group }) };
  }

  /**
   * A motion to `place:…` counts from the place; the flat text had the place in the origin of the controller's world.
   */
  private atPlace(step: Step, line: number, places: readonly string[]): Step {
    const place = /^\s*MOVES?\s+(\w+):/i.exec(this.lines[line - 1] ?? "")?.[1]?.toLowerCase();
    if (step.type !== "move" || place === undefined || !places.includes(place) || !("pose" in step.target)) return step;
    const placeFromTcp = compose(inverse(this.worldFromVendor) as Pose, step.target.pose as Pose) as Pose<
      "frame",
      "tcp"
    >;
    return { ...step, target: { ...step.target, frame: place, pose: placeFromTcp } };
  }

  private signal(named: string): string {
    const isNumber = /^[0-9]/.test(named);
    const address = isNumber ? Number(named) : this.structure.numbers.get(named);
    const input = address !== undefined && address > 1000 && address <= 2000;
    const name = isNumber ? `${input ? "in" : "out"}_${named}` : named;
    this.signals[name] = { kind: input ? "digital-in" : "digital-out", ...(address === undefined ? {} : { address }) };
    return name;
  }

  private pallet({
    place,
    origin,
    rows,
    columns,
    layers,
    byRows,
    zigzag,
    shifted,
    column_mm,
    row_mm,
    layer_mm,
  }: Pattern): Pallet {
    const [x, y, z, yaw, pitch, roll] = origin;
    const worldFromPlace = compose(
      this.worldFromVendor,
      toPose<"vendor-world", "place">(fromTrans(x!, y!, z!, yaw!, pitch!, roll!)),
    );
    const inWorld = ([a, b, c]: readonly number[]): Vector3 =>
      rotate(this.worldFromVendor.quaternion, [a! / 1000, b! / 1000, c! / 1000], [0, 0, 0]);
    const up = inWorld(layer_mm);
    const layer_m = Math.hypot(...up);
    const flat = Math.hypot(up[0], up[1]) <= 1e-12 + 1e-9 * layer_m;
    // Layers stack along z of a frame: where that is not the world's, the pallet gets one of its own.
    const frame = flat ? "world" : `${place} plane`;
    const worldFromFrame: Pose<"world", "frame"> = flat
      ? identity()
      : { position: [0, 0, 0], quaternion: ontoZ(up, layer_m) };
    if (!flat) this.frames[frame] = worldFromFrame;
    const frameFromPlace = compose(inverse(worldFromFrame), worldFromPlace);
    const p = frameFromPlace.position;
    const frameFromWorld = inverse(worldFromFrame).quaternion;
    const end = (pitch_mm: readonly number[], count: number): Vector3 => {
      const d = rotate(frameFromWorld, inWorld(pitch_mm), [0, 0, 0]);
      return [p[0] + d[0] * (count - 1), p[1] + d[1] * (count - 1), p[2] + d[2] * (count - 1)];
    };
    return {
      frame,
      origin: frameFromPlace,
      rowEnd: end(column_mm, columns),
      columnEnd: end(row_mm, rows),
      rows,
      columns,
      layers,
      layer_m: flat ? up[2] : layer_m,
      ...(shifted ? { interleave: "odd-rows-shifted" } : {}),
      order: `${byRows ? "rows" : "columns"}${zigzag ? "-zigzag" : ""}`,
    };
  }
}

/** The least turn that brings z onto a direction. */
function ontoZ([x, y, z]: Vector3, length: number): Quaternion {
  const w = 1 + z / length;
  if (w < 1e-9) return [1, 0, 0, 0];
  const size = Math.hypot(y, x, w * length);
  return [-y / size, x / size, 0, (w * length) / size];
}
