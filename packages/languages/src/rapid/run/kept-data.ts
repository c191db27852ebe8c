import type { Pose, Robot, Signals } from "@twincell/core";
import { TextError, type DeclaredCell } from "../../parser/index.ts";
import { BlockMachine, type Expression, type Routine } from "../../parser/structured/index.ts";
import type { Source } from "../read/grammar.ts";
import { ControllerArm } from "./arm.ts";
import type { Frame } from "./frame.ts";
import { Lines } from "./lines.ts";
import { predefined } from "./predefined.ts";
import { WorkObjects } from "./work-objects.ts";
import { placeOf, type Value } from "./values.ts";
import { ownName, type DataDeclaration } from "../read/statements.ts";

/** Records whose orientation a program may leave unset. */
const UNSET = new Set(["num", "dnum", "bool", "string", "byte", "clock", "intnum"]);

const MOST_ITEMS = 100_000;

/** Data of RAPID: made as they are declared, found by the module that asks for them. */
export abstract class KeptData extends BlockMachine<Value> {
  readonly arm: ControllerArm;
  readonly declared: DeclaredCell;
  protected readonly source: Source;
  private readonly known: ReadonlyMap<string, Value>;
  protected readonly objects: WorkObjects;
  protected readonly lines: Lines;
  protected acceleration = 1;
  protected override = 1;
  protected fastest_mmps = Infinity;
  protected asksConfiguration = true;
  protected tool: Frame;
  protected readonly types = new Map<string, string>();
  private making: string | undefined;
  /** Why nobody knows where the robot is: a sentence. */
  protected lost: string | undefined;
  protected readonly triggers = new Map<
    string,
    { readonly signal: string; readonly to: boolean | number; readonly distance_mm: number }
  >();
  /** Data that something outside gave a value. */
  protected readonly foreign = new Set<string>();

  /** Work objects that are frames although they change: the places of a pallet that is being read. */
  get places(): Set<string> {
    return this.objects.places;
  }

  /** @param changing  data that get a value while the program runs. */
  constructor(
    source: Source,
    changing: ReadonlySet<string>,
    robot: Robot,
    worldFromBase: Pose<"world", "base">,
    declared: DeclaredCell,
    signals?: Signals,
  ) {
    super(source.routines);
    this.source = source;
    this.known = predefined(robot.maxTcpSpeed_mps);
    this.arm = new ControllerArm(robot, worldFromBase);
    this.declared = declared;
    this.lines = new Lines(
      declared.signals,
      signals,
      name => this.handedLine(name) ?? this.spelt(name),
      name => this.isHeldElsewhere(name) || this.handedLine(name) !== undefined,
    );
    this.objects = new WorkObjects(source, changing, declared, this.arm);
    this.tool = { mm: [0, 0, 0], wxyz: [1, 0, 0, 0] };
    for (const { name, module, type } of source.data)
      this.types.set(module !== undefined && source.own.size > 0 ? ownName(name, module) : name, type);
    this.makeAll(source.data);
  }

  /** Data may count on others that stand further down, or in a module behind: these are made first. */
  private makeAll(data: readonly DataDeclaration[]): void {
    let waiting = data;
    let fault: TextError | undefined;
    do {
      const before = waiting.length;
      fault = undefined;
      const again: DataDeclaration[] = [];
      for (const datum of waiting) {
        const { name, module } = datum;
        const key = module !== undefined && this.source.own.size > 0 ? ownName(name, module) : name;
        this.making = module;
        try {
          this.make(datum, this.globals, key);
        } catch (cause) {
          if (!(cause instanceof TextError)) throw cause;
          fault ??= cause;
          again.push(datum);
        }
      }
      waiting = again;
      if (again.length === before) break;
    } while (waiting.length > 0);
    this.making = undefined;
    // In another file it matters where the datum is asked for.
    if (fault !== undefined && this.source.own.size === 0) throw fault;
  }

  private make(datum: DataDeclaration, into: Map<string, Value>, key = datum.name): void {
    const { type, value, sizes } = datum;
    if (value !== undefined) into.set(key, this.evaluate(value));
    else if (sizes.length > 0) into.set(key, this.empty(sizes, type));
    else {
      const unset = this.unset(type);
      if (unset !== undefined) into.set(key, unset);
    }
  }

  /** What a datum that is given no value begins with; undefined where that is nothing that could be used. */
  private unset(type: string, depth = 0): Value | undefined {
    if (UNSET.has(type)) return unsetValue(type);
    if (Object.hasOwn(EMPTY, type)) return EMPTY[type];
    const components = this.source.records.get(type);
    if (components === undefined || depth > RECORD_DEPTH) return undefined;
    return components.map(each => this.unset(each.type, depth + 1) ?? 0);
  }

  /** The declared type of what an expression stands for, where it is a record of the text. */
  private typeOf(expression: Expression): string | undefined {
    switch (expression.kind) {
      case "variable": {
        const routine = this.scopes.at(-1)?.routine ?? "";
        const local = this.source.local.get(routine)?.find(({ name }) => name === expression.name);
        const parameter = this.source.routines.get(routine)?.parameters.find(({ name }) => name === expression.name);
        return local?.type ?? parameter?.type ?? this.types.get(this.globalKey(expression.name));
      }
      case "index":
        return this.typeOf(expression.of);
      case "component": {
        const components = this.source.records.get(this.typeOf(expression.of) ?? "");
        return components?.find(({ name }) => name === expression.name)?.type;
      }
      default:
        return undefined;
    }
  }

  /** Where a component stands in its record: one that the text declares, or one of the controller. */
  protected componentOf(of: Expression, record: readonly Value[], name: string): number | undefined {
    const components = this.source.records.size > 0 ? this.source.records.get(this.typeOf(of) ?? "") : undefined;
    const at = components?.findIndex(each => each.name === name) ?? -1;
    return at >= 0 ? at : placeOf(record, name);
  }

  /** The module of the routine that is carried out. */
  private get module(): string | undefined {
    const routine = this.scopes.at(-1)?.routine;
    return routine === undefined ? this.making : this.source.moduleOf.get(routine);
  }

  /** The name under which a datum of all or of the module is kept. */
  protected globalKey(name: string): string {
    if (this.source.own.size === 0) return name;
    const { module } = this;
    return module !== undefined && this.source.own.get(module)?.has(name) === true ? ownName(name, module) : name;
  }

  override routine(name: string): Routine | undefined {
    return super.routine(this.globalKey(name)) ?? super.routine(name);
  }

  private empty(sizes: readonly Expression[], type: string): Value {
    const [size, ...rest] = sizes;
    const length = this.numberOf(size!);
    if (!Number.isInteger(length) || length < 1 || length > MOST_ITEMS)
      throw new TextError(size!, `a size from 1 to ${MOST_ITEMS}`, `An array of ${length} items cannot be made.`);
    return Array.from({ length }, (): Value => (rest.length > 0 ? this.empty(rest, type) : (this.unset(type) ?? 0)));
  }

  protected override prepare(routine: Routine, names: Map<string, Value>): void {
    for (const datum of this.source.local.get(routine.name) ?? []) this.make(datum, names);
  }

  variable(name: string): Value | undefined {
    return this.scopes.at(-1)?.names.get(name) ?? this.globals.get(this.globalKey(name)) ?? this.known.get(name);
  }

  /** The line that a parameter of a routine stands for. */
  protected handedLine(name: string): string | undefined {
    const scope = this.scopes.at(-1);
    const value = scope?.names.get(name);
    if (scope === undefined || typeof value !== "string") return undefined;
    const parameter = this.source.routines.get(scope.routine)?.parameters.find(each => each.name === name);
    return parameter !== undefined && SIGNAL_TYPE.test(parameter.type) ? value : undefined;
  }

  protected isDatum(name: string): boolean {
    return (
      this.types.has(this.globalKey(name)) ||
      this.source.local.get(this.scopes.at(-1)?.routine ?? "")?.some(each => each.name === name) === true
    );
  }

  spelt(name: string): string {
    return this.source.spelling.get(name) ?? name;
  }

  protected isHeldElsewhere(name: string): boolean {
    return this.variable(name) === undefined && !this.isDatum(name) && !this.foreign.has(name);
  }
}

export const SIGNAL_TYPE = /^signal[dag][io]$/;

const RECORD_DEPTH = 10;

const unsetValue = (type: string): Value => (type === "bool" ? false : type === "string" ? "" : 0);

const POSE_0: Value = [
  [0, 0, 0],
  [0, 0, 0, 0],
];

const NO_EXTERNAL: Value = [0, 0, 0, 0, 0, 0];

/** Records of the controller that are given no value: all nought. */
const EMPTY: Readonly<Record<string, Value>> = {
  pos: [0, 0, 0],
  orient: [0, 0, 0, 0],
  pose: POSE_0,
  confdata: [0, 0, 0, 0],
  robjoint: [0, 0, 0, 0, 0, 0],
  extjoint: NO_EXTERNAL,
  robtarget: [[0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0], NO_EXTERNAL],
  jointtarget: [[0, 0, 0, 0, 0, 0], NO_EXTERNAL],
  speeddata: [0, 0, 0, 0],
  wobjdata: [false, true, "", POSE_0, POSE_0],
};
