import type { Pose } from "@twincell/core";
import { TextError, type DeclaredCell } from "../../parser/index.ts";
import type { Expression } from "../../parser/structured/index.ts";
import type { Source } from "../read/grammar.ts";
import type { ControllerArm } from "./arm.ts";
import { inverted, times, toPose, type Frame } from "./frame.ts";
import { asFrame, asRecord, type Value } from "./values.ts";

/** Which frame a work object is for the steps, and where it is in the base of the robot. */
export interface WorkObject {
  readonly name: string;
  readonly base: Frame;
}
/** wobj0 */
export const WORLD: WorkObject = { name: "world", base: { mm: [0, 0, 0], wxyz: [1, 0, 0, 0] } };

/** The work objects of a program as frames of the cell. */
export class WorkObjects {
  /** Those that are frames although they change: the places of a pallet that is being read. */
  readonly places = new Set<string>();
  private readonly source: Source;
  private readonly changing: ReadonlySet<string>;
  private readonly declared: DeclaredCell;
  private readonly arm: ControllerArm;

  /** @param changing  data that get a value while the program runs. */
  constructor(source: Source, changing: ReadonlySet<string>, declared: DeclaredCell, arm: ControllerArm) {
    this.source = source;
    this.changing = changing;
    this.declared = declared;
    this.arm = arm;
  }

  /** The frame that a work object is; one that changes is none of its own, its points are in the world. */
  of(object: Expression, evaluate: (of: Expression) => Value): WorkObject {
    if (object.kind === "variable" && object.name === "wobj0") return WORLD;
    const [holds, , , user, own] = asRecord(evaluate(object), object, 5, "a work object");
    if (holds !== false)
      throw new TextError(
        object,
        "a work object that stands still",
        "Work objects that the robot holds are not executed here.",
      );
    const base = times(asFrame(user, object), asFrame(own, object));
    if (object.kind !== "variable") return { name: "world", base };
    const spelt = this.spelt(object.name);
    if (this.places.has(spelt)) return { name: spelt, base };
    if (this.changing.has(object.name)) return { name: "world", base };
    this.declared.frames[spelt] ??= this.arm.world(base);
    return { name: spelt, base };
  }

  /** The place that a work object is, in the frame whose user frame it shares. */
  placeIn(
    variable: string,
    value: Value | undefined,
    globals: ReadonlyMap<string, Value>,
  ): { readonly frame: string; readonly pose: Pose<"frame", "place"> } | undefined {
    if (typeof value !== "object" || value.length !== 5 || !this.changing.has(variable)) return undefined;
    const at = { line: 1, column: 1 };
    const user = asFrame(value[3], at);
    const own = asFrame(value[4], at);
    const partsOf = (name: string): readonly Value[] => asRecord(globals.get(name), at, 5, "a work object");
    const like = this.source.data.find(
      ({ type, name }) =>
        type === "wobjdata" &&
        name !== variable &&
        !this.changing.has(name) &&
        JSON.stringify(partsOf(name)[3]) === JSON.stringify(value[3]),
    );
    if (like === undefined) return { frame: "world", pose: this.arm.world(times(user, own)) };
    const shared = asFrame(partsOf(like.name)[4], at);
    const spelt = this.spelt(like.name);
    this.declared.frames[spelt] ??= this.arm.world(times(user, shared));
    return { frame: spelt, pose: toPose(times(inverted(shared), own)) };
  }

  private spelt(name: string): string {
    return this.source.spelling.get(name) ?? name;
  }
}
