import type { MoveStep, Pose, Robot, Signals, Target, TextPlace } from "@twincell/core";
import { TextError, type DeclaredCell, type Notices } from "../../parser/index.ts";
import type { Do, Expression } from "../../parser/structured/index.ts";
import type { Motion, Point } from "../read/actions.ts";
import type { PositionRecord } from "../read/listing.ts";
import type { Source } from "../read/source.ts";
import { fromSix, inverted, moved, times, toPose, type Matrix } from "./matrix.ts";
import { FASTEST, planned, speedOf } from "./pace.ts";
import { RegisterMachine } from "./registers.ts";
import { isJoints, isSix, type Value } from "./values.ts";

/** $WAITTMOUT counts hundredths of a second; 30 s when nobody has set it. */
const TIMEOUT = 3000;

/** Motions of TP programs: positions, offsets, additional axes and speeds. */
export abstract class Motions extends RegisterMachine {
  /** Registers that hold how far the place of a pallet is off, while the pallet is read as one. */
  readonly places = new Set<string>();
  private readonly writesDown: boolean;
  protected timeout = TIMEOUT;
  protected skip: Expression | undefined;
  protected offset: string | undefined;
  protected toolOffset: string | undefined;
  /** Where the further axes stood at the last taught position. */
  protected others: string | undefined;
  protected jump: number | undefined;
  protected jumpFrom: TextPlace = { line: 1, column: 1 };

  /**
   * @param notices     takes what only the controller knows, as registers that no file holds; without, such a thing is
   *   refused.
   * @param writesDown  the program becomes steps to be kept: poses stay poses, whatever turn of an axis the text asks
   *   for.
   */
  constructor(
    source: Source,
    robot: Robot,
    worldFromBase: Pose<"world", "base">,
    declared: DeclaredCell,
    signals: Signals | undefined,
    writesDown: boolean,
    notices?: Notices,
  ) {
    super(source, robot, worldFromBase, declared, signals, notices);
    this.writesDown = writesDown;
  }

  /** Whether the program goes on at the label of a search in one of its two ends. */
  protected leads({ jumpsWhenMet }: Motion, at: Do): boolean {
    const fate = this.source.fates.get(at);
    return this.skip !== undefined && fate !== "on" && (jumpsWhenMet === true || fate !== "abort");
  }

  private record({ register, number }: Point, at: TextPlace): PositionRecord {
    const n = this.numberOf(number);
    if (register === "pr") {
      return this.fromValue(this.register(`pr${n}`, at), `PR[${n}]`, at);
    }
    const moved = this.moved.get(this.positionKey(n));
    if (moved !== undefined) return this.fromValue(moved, `P[${n}]`, at);
    const record = this.listed(n, at);
    if (record.remote)
      throw new TextError(
        at,
        "a position of a tool that the robot carries",
        `P[${n}] was taught with a tool that stands in the cell (RX, RY, RZ), which is not executed here.`,
      );
    for (const [word, taught, used] of [
      ["UFRAME", record.uf, this.setups.inUse.uframe],
      ["UTOOL", record.ut, this.setups.inUse.utool],
    ] as const) {
      if (used !== undefined && taught !== undefined && used !== taught)
        throw new TextError(
          at,
          `a position of ${word} ${used}`,
          `P[${n}] was taught with ${word} ${taught}, and ${used} is in use.`,
        );
    }
    return record;
  }

  /** The value of a register as a position in the frame and the tool that are in use. */
  private fromValue(value: Value, name: string, at: TextPlace): PositionRecord {
    if (!isSix(value) && !isJoints(value)) throw new TextError(at, "a position", `${name} holds no position.`);
    return {
      uf: this.setups.inUse.uframe,
      ut: this.setups.inUse.utool,
      joints: isJoints(value),
      config: undefined,
      remote: false,
      values: isJoints(value) ? value.joints_deg : value,
      line: at.line,
      column: at.column,
      others: "",
    };
  }

  /** How fast a motion is; what only the controller knows of it is said. */
  private pace(motion: Motion, at: TextPlace): MoveStep["speed"] {
    const { speed, unit, path } = motion;
    if (unit === "max_speed") return path === "J" ? { ratio: 1 } : FASTEST;
    const before = this.unknowns;
    const value = speed === undefined ? 0 : this.numberOf(speed);
    const isGiven = speed !== undefined && (this.unknowns === before || value > 0);
    if (this.notices !== undefined && (!isGiven || (!(value > 0) && speed.kind !== "number"))) {
      const { said, assumed } = planned(unit, path);
      this.notices.notGiven(at, `The speed of line ${at.line} is in none of the files: it is planned at ${said}.`);
      return assumed;
    }
    if (speed === undefined)
      throw new TextError(at, "a speed", `${unit.toUpperCase()} is in none of the files: the speed is not known.`);
    return speedOf(value, { unit, path }, at);
  }

  protected motion(motion: Motion, at: Do, id: string): MoveStep {
    const { path, goal, via, cnt, acceleration, offset } = motion;
    const shifted = this.shift(offset, at);
    const inTool = this.toolShift(motion.toolOffset, at);
    this.further(motion, at);
    const speed = this.pace(motion, at);
    const ratio = acceleration === undefined ? 1 : Math.min(1, this.numberOf(acceleration) / 100);
    const share = cnt === undefined ? 0 : this.numberOf(cnt) / 100;
    if (!(share >= 0 && share <= 1)) throw new TextError(at, "CNT0 … CNT100", `CNT${share * 100} is no share of 100.`);
    const passing = via === undefined ? {} : { via: this.target(via, shifted, inTool, "on-the-way", at) };
    const common = {
      id,
      type: "move",
      speed,
      ...(ratio < 1 ? { acceleration: { ratio } } : {}),
      blend_m: 0,
      ...(share > 0 ? { blend_ratio: share } : {}),
    } as const;
    const how = path === "J" ? "by-joints" : "by-path";
    const target =
      motion.incremental === true ? this.further_by(goal, how, at) : this.target(goal, shifted, inTool, how, at);
    return {
      ...common,
      path: path === "J" ? "ptp" : path === "L" ? "lin" : "circ",
      target,
      ...passing,
      ...this.search(motion, at),
    };
  }

  private search(motion: Motion, at: Do): Pick<MoveStep, "until"> {
    const { skip } = motion;
    if (skip === undefined) return {};
    const when = this.skip === undefined ? undefined : this.condition(this.skip);
    const fate = this.source.fates.get(at);
    if (when === undefined && this.notices !== undefined) {
      this.notices.add(
        at,
        "a condition of one line",
        `The search of line ${at.line} has no condition of one line: the motion goes to its end.`,
      );
      return {};
    }
    if (when === undefined)
      throw new TextError(at, "SKIP CONDITION of one line before it", "The search has no condition of one line.");
    if (this.notices !== undefined && this.leads(motion, at)) return { until: { when, missing: "continue" } };
    if (motion.jumpsWhenMet === true || fate === "elsewhere" || fate === undefined)
      throw new TextError(
        at,
        "a label in the next line, or one before ABORT",
        "A search that goes on elsewhere is not executed here.",
      );
    return { until: { when, missing: fate === "abort" ? "fault" : "continue" } };
  }

  /** How far the positions of a motion are shifted along the axes of the frame in use, and by which register. */
  private shift(
    offset: Motion["offset"],
    at: TextPlace,
  ): { readonly mm: readonly [number, number, number]; readonly register: string } | undefined {
    if (offset === undefined) return undefined;
    const register = offset.register === undefined ? this.offset : `pr${this.numberOf(offset.register)}`;
    const six = register === undefined ? undefined : this.register(register, at);
    if (register === undefined || six === undefined || !isSix(six))
      throw new TextError(at, "Offset,PR[n]", "The offset is in no register.");
    if (six.slice(3).some(angle_deg => Math.abs(angle_deg - 360 * Math.round(angle_deg / 360)) > 1e-6))
      throw new TextError(at, "an offset that does not turn", "Offsets that turn are not executed here.");
    return { mm: [six[0]!, six[1]!, six[2]!], register };
  }

  /** Tool_Offset,PR[n]: the point is shifted and turned as it is seen from itself. */
  private toolShift(offset: Motion["toolOffset"], at: TextPlace): Matrix | undefined {
    if (offset === undefined) return undefined;
    const register = offset.register === undefined ? this.toolOffset : `pr${this.numberOf(offset.register)}`;
    const six = register === undefined ? undefined : this.register(register, at);
    if (six === undefined || !isSix(six))
      throw new TextError(at, "Tool_Offset,PR[n]", "The offset of the tool is in no register.");
    return fromSix(six);
  }

  /** Further axes are not moved: a motion that keeps its place on what they carry is refused when they do. */
  private further({ goal, coordinated }: Motion, at: TextPlace): void {
    if (goal.register !== "p") return;
    const { others } = this.record(goal, at);
    if (coordinated && this.others !== undefined && this.others !== others)
      throw new TextError(
        at,
        "a coordinated motion whose other group stands still",
        `With COORD the robot follows the other group, which goes from ${this.others || "nowhere"} to ${others || "nowhere"}: other groups are not moved here.`,
      );
    this.others = others;
  }

  /** INC: from where the robot stands, along the axes of the frame, or by joint angles. */
  private further_by(point: Point, how: "by-joints" | "by-path", at: TextPlace): Target {
    const record = this.record(point, at);
    const { values } = record;
    if (values === undefined)
      throw new TextError(at, "a position that was taught", "The position was never taught: it is ********.");
    const ut = this.setups.inUse.utool ?? record.ut ?? 0;
    const tool = this.setups.of("utool", ut, at);
    const name = this.setups.toolName(tool);
    if (record.joints)
      return { q: this.arm.atShown(this.arm.shown().map((angle, i) => angle + values[i]!)), tool: name };
    if (values.slice(3).some(angle => angle !== 0))
      throw new TextError(at, "a position that does not turn", "INC with a turn of the tool is not executed here.");
    const frame = this.setups.of("uframe", this.setups.inUse.uframe ?? record.uf ?? 0, at);
    const standing = times(times(inverted(frame.matrix), this.arm.flange), tool.matrix);
    const seen = moved(standing, [values[0]!, values[1]!, values[2]!]);
    const named = this.setups.frameName(frame);
    const reached = this.arm.atFlange(times(times(frame.matrix, seen), inverted(tool.matrix)), undefined);
    if (how === "by-joints" && reached.q !== undefined && !this.writesDown) return { q: reached.q, tool: name };
    return {
      pose: named === "world" ? this.arm.cell<"frame", "tcp">(times(frame.matrix, seen)) : toPose<"frame", "tcp">(seen),
      frame: named,
      tool: name,
      ...(reached.branch === undefined ? {} : { branch: reached.branch }),
    };
  }

  /** The frame and the tool that a position is seen with: those in use, else its own. */
  private numbersOf(record: Pick<PositionRecord, "uf" | "ut">): { readonly uf: number; readonly ut: number } {
    const { uframe, utool } = this.setups.inUse;
    return { uf: uframe ?? record.uf ?? 0, ut: utool ?? record.ut ?? 0 };
  }

  private anglesOf(shown: readonly number[], how: "by-joints" | "by-path" | "on-the-way"): readonly number[] {
    const before = this.arm.remember();
    const q_rad = this.arm.atShown(shown);
    if (how === "on-the-way") before();
    return q_rad;
  }

  private target(
    point: Point,
    shifted: ReturnType<Motions["shift"]>,
    inTool: Matrix | undefined,
    how: "by-joints" | "by-path" | "on-the-way",
    at: TextPlace,
  ): Target {
    const record = this.record(point, at);
    const { values, config } = record;
    const { uf, ut } = this.numbersOf(record);
    if (values === undefined)
      throw new TextError(at, "a position that was taught", "The position was never taught: it is ********.");
    const frame = this.setups.of("uframe", uf, at);
    const tool = this.setups.of("utool", ut, at);
    const name = this.setups.toolName(tool);
    if (record.joints) {
      if (shifted !== undefined || inTool !== undefined)
        throw new TextError(at, "a position of X, Y, Z", "A position of joint angles is not shifted here.");
      return { q: this.anglesOf(values, how), tool: name };
    }
    const six = fromSix(values);
    const written = inTool === undefined ? six : times(six, inTool);
    const seen = shifted === undefined ? written : moved(written, shifted.mm);
    const named = this.setups.frameName(frame);
    const inPlace = shifted === undefined ? undefined : this.atPlace(shifted.register, written);
    const plain = {
      pose: named === "world" ? this.arm.cell<"frame", "tcp">(times(frame.matrix, seen)) : toPose<"frame", "tcp">(seen),
      frame: named,
      tool: name,
    };
    const target = inPlace === undefined ? plain : { ...plain, ...inPlace };
    if (how === "on-the-way") return target;
    const reached = this.arm.atFlange(times(times(frame.matrix, seen), inverted(tool.matrix)), config);
    if (how === "by-joints" && !reached.fits) this.notInConfiguration(at);
    if (how === "by-joints" && reached.turned && !this.writesDown) return { q: reached.q!, tool: name };
    return { ...target, ...(reached.branch === undefined ? {} : { branch: reached.branch }) };
  }

  private notInConfiguration(at: TextPlace): void {
    const expected = "a configuration that reaches the position";
    if (this.notices === undefined)
      throw new TextError(at, expected, "The position is not reached in its configuration.");
    this.notices.add(
      at,
      expected,
      `Line ${at.line}: this robot does not reach the position in its configuration; the nearest posture is taken.`,
    );
  }

  /** A taught point as it is seen from the place of a pallet that is being read as one. */
  private atPlace(
    register: string,
    written: Matrix,
  ): { readonly pose: Pose<"frame", "tcp">; readonly frame: string } | undefined {
    const difference = this.differences.get(register);
    const first = difference === undefined ? undefined : this.globals.get(difference.first);
    if (!this.places.has(this.spelt(register)) || first === undefined || !isSix(first)) return undefined;
    return { pose: toPose(times(inverted(fromSix(first)), written)), frame: this.spelt(register) };
  }
}
