import type { VirtualController } from "../../virtual/index.ts";

export type LineKind = "DI" | "DO" | "AI" | "AO";
export interface Line {
  readonly name: string;
  readonly kind: LineKind;
  readonly value: boolean | number;
}

/** The output that closes the gripper, as programs have it. */
const GRIPPER = "doGripper";
const EACH = 8;
const MOST_LINES = 500;

/**
 * The lines of a controller by the names of its configuration; small and capital letters are the same. A text brings
 * its own with it.
 */
export class Lines {
  private readonly arm: VirtualController;
  private readonly known = new Map<string, { readonly name: string; readonly kind: LineKind }>();
  private closed = false;
  private seen = 0;

  constructor(arm: VirtualController) {
    this.arm = arm;
    for (const kind of ["DI", "DO"] as const) for (let i = 1; i <= EACH; i++) this.add(`${kind}${i}`, kind);
    this.add("AI1", "AI");
    this.add("AO1", "AO");
    this.add(GRIPPER, "DO");
  }
  private add(name: string, kind: LineKind): void {
    if (this.known.size < MOST_LINES) this.known.set(name.toUpperCase(), { name, kind });
  }

  get all(): Line[] {
    return [...this.known.values()].map(line => this.valued(line));
  }
  find(name: string): Line | undefined {
    const line = this.known.get(name.toUpperCase());
    return line && this.valued(line);
  }
  private valued({ name, kind }: { readonly name: string; readonly kind: LineKind }): Line {
    const value = this.arm.signals.read(name);
    return {
      name,
      kind,
      value: kind.startsWith("D") ? value === true || (typeof value === "number" && value !== 0) : Number(value),
    };
  }
  /** Why not, or null. */
  write(name: string, value: number): string | null {
    const line = this.find(name);
    if (!line) return `There is no signal ${name}.`;
    if (line.kind.startsWith("D") && value !== 0 && value !== 1) return `The signal ${line.name} takes 0 and 1.`;
    if (!line.kind.endsWith("O")) return `The signal ${line.name} is an input.`;
    this.arm.signals.write(line.name, line.kind === "DO" ? value === 1 : value);
    return null;
  }
  /** What is connected to it. */
  setInput(name: string, value: boolean | number): void {
    if (!this.known.has(name.toUpperCase())) this.add(name, typeof value === "boolean" ? "DI" : "AI");
    this.arm.signals.write(this.known.get(name.toUpperCase())?.name ?? name, value);
  }
  /** What the arm says of itself in each of its samples: lines that a text spoke of are there from then on. */
  take(gripperClosed: boolean, signals: ReadonlyMap<string, boolean | number> | undefined): void {
    if (gripperClosed !== this.closed) {
      this.closed = gripperClosed;
      this.arm.signals.write(GRIPPER, gripperClosed);
    }
    if (!signals || signals.size === this.seen) return;
    this.seen = signals.size;
    for (const [name, value] of signals)
      if (!this.known.has(name.toUpperCase())) this.add(name, typeof value === "boolean" ? "DO" : "AO");
  }
}
