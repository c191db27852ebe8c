import type { Interpreted } from "@twincell/core";
import { textSteps } from "../../runner/index.ts";
import type { VirtualController } from "../../virtual/index.ts";
import { commTimeout_s, EVENT, isStreamed } from "../codec/index.ts";
import type { VirtualPendant } from "./cabinet.ts";

/** Of the task: at its beginning or end, on its way, stopped on its way. */
export type Execution = "read" | "star" | "stop";
export type Cycle = "once" | "forever";
/** Who carries out a module that is guided from outside. */
export interface Streamed {
  start(commTimeout_s?: number): void;
  stop(): void;
}

const MOST_MODULES = 100;
const NAME = /^\s*MODULE\s+([A-Za-z][A-Za-z0-9_]{0,31})\b/im;
const MAIN = /^\s*PROC\s+main\s*\(/im;

/**
 * The modules of the one task, its program pointer, and the text that is being executed. Why something cannot be is a
 * sentence; null when it was done.
 */
export class Programs {
  private readonly arm: VirtualController;
  private readonly cabinet: VirtualPendant;
  private readonly guided: Streamed;
  private readonly interpret: (text: string) => Interpreted;
  private readonly modules = new Map<string, { readonly name: string; readonly text: string }>();
  private state: Execution = "read";
  private ready: Extract<Interpreted, { kind: "ready" }> | null = null;
  private isPointed = false;
  private isOnArm = false;
  private run = 0;
  cycle: Cycle = "forever";

  constructor(
    arm: VirtualController,
    virtualPendant: VirtualPendant,
    guided: Streamed,
    interpret: (text: string) => Interpreted,
  ) {
    this.arm = arm;
    this.cabinet = virtualPendant;
    this.guided = guided;
    this.interpret = interpret;
    virtualPendant.speedChanged = () => {
      this.pace();
    };
  }

  get execution(): Execution {
    return this.state;
  }
  get isRunning(): boolean {
    return this.state === "star";
  }
  /** Whether a text has the arm, also while it is stopped on its way. */
  get hasArm(): boolean {
    return this.isOnArm;
  }
  get names(): string[] {
    return [...this.modules.values()].map(({ name }) => name);
  }
  /** Whether the module with PROC main is one that is guided. */
  get isGuided(): boolean {
    const main = this.main;
    return main !== undefined && isStreamed(main.text);
  }
  text(name: string): string | undefined {
    return this.modules.get(name.toUpperCase())?.text;
  }
  get texts(): IterableIterator<{ readonly name: string; readonly text: string }> {
    return this.modules.values();
  }
  private get main(): { readonly name: string; readonly text: string } | undefined {
    return [...this.modules.values()].find(({ text }) => MAIN.test(text));
  }

  load(text: string, replace: boolean): string | null {
    const name = NAME.exec(text)?.[1];
    if (this.isRunning) return "The program is running.";
    if (name === undefined) return "The file holds no module.";
    if (this.modules.has(name.toUpperCase()) && !replace) return `The module ${name} is loaded already.`;
    if (this.modules.size >= MOST_MODULES) return "The memory of the task is full.";
    const { main } = this;
    if (main && main.name.toUpperCase() !== name.toUpperCase() && MAIN.test(text))
      return `The module ${main.name} has a PROC main already.`;
    this.modules.set(name.toUpperCase(), { name, text });
    this.lose();
    return null;
  }
  unload(name: string): string | null {
    if (this.isRunning) return "The program is running.";
    if (!this.modules.delete(name.toUpperCase())) return `There is no module ${name}.`;
    this.lose();
    return null;
  }
  /** A datum of a module has another value; a text that is being executed keeps its own. */
  change(name: string, text: string): void {
    this.modules.set(name.toUpperCase(), { name: this.modules.get(name.toUpperCase())?.name ?? name, text });
  }

  /** The program pointer to PROC main. */
  reset(): string | null {
    if (this.isRunning) return "The program is running.";
    const { main } = this;
    if (!main) return "No module of the task has a PROC main.";
    this.lose();
    this.ready = null;
    if (!isStreamed(main.text)) {
      const read = this.interpret(
        [main, ...[...this.modules.values()].filter(module => module !== main)].map(({ text }) => text).join("\n"),
      );
      if (read.kind === "not-understood") {
        const [fault] = read.faults;
        const sentence = `${main.name}, line ${fault?.line ?? 1}: ${fault?.sentence ?? "not understood"}`;
        this.cabinet.log(EVENT.failed, 3, "Program error", sentence);
        return sentence;
      }
      this.ready = read;
    }
    this.isPointed = true;
    this.state = "read";
    return null;
  }
  start(cycle: Cycle | null): string | null {
    const { main, cabinet: virtualPendant } = this;
    if (virtualPendant.state !== "motoron") return `The controller is in the state ${virtualPendant.state}.`;
    if (virtualPendant.key !== "AUTO") return "In manual mode the program is started at the pendant.";
    if (this.isRunning) return "The program is running.";
    if (!main || !this.isPointed) return "The program pointer is not set.";
    if (!isStreamed(main.text) && !this.isOnArm && this.arm.isMoving()) return "The robot has not come to rest.";
    if (cycle) this.cycle = cycle;
    this.state = "star";
    virtualPendant.log(EVENT.started, 1, "Program started", `Execution of ${main.name} was started.`);
    if (isStreamed(main.text)) this.guided.start(commTimeout_s(main.text));
    else if (!this.isOnArm) this.begin();
    this.pace();
    return null;
  }
  /** Stops on the path; the start goes on from there. */
  stop(because = "The program was stopped from outside."): void {
    if (!this.isRunning) return;
    this.state = "stop";
    this.cabinet.log(EVENT.stopped, 1, "Program stopped", because);
    if (this.isGuided) this.guided.stop();
    this.pace();
  }
  /** Something took the robot from its program: it brakes as hard as it can, and goes on from PROC main only. */
  interrupted(because: string): void {
    if (this.isRunning) this.cabinet.log(EVENT.stopped, 1, "Program stopped", because);
    if (this.isGuided) this.guided.stop();
    this.lose();
  }

  private begin(): void {
    const mine = ++this.run;
    const { ready } = this;
    if (!ready) return;
    this.isOnArm = true;
    void this.arm.run(textSteps(() => ready.run(this.arm.signals)).steps, ready.context).then(outcome => {
      if (mine !== this.run) return;
      this.isOnArm = false;
      if (outcome.kind === "done" && this.cycle === "forever" && this.isRunning) {
        this.begin();
        return;
      }
      this.state = outcome.kind === "done" ? "read" : "stop";
      this.isPointed = outcome.kind === "done";
      if (outcome.kind === "done") this.cabinet.log(EVENT.ready, 1, "Program stopped", "The task is ready.");
      else this.cabinet.log(EVENT.failed, 3, "Program stopped", outcome.why.sentence);
    });
  }
  /** Nothing points anywhere any more; what moved comes to rest. */
  private lose(): void {
    this.run++;
    if (this.isOnArm) this.arm.stop();
    this.isOnArm = this.isPointed = false;
    if (this.state === "star") this.state = "stop";
    this.pace();
  }
  private pace(): void {
    this.arm.setSpeed(this.isOnArm && !this.isRunning ? 0 : this.cabinet.speedRatio);
  }
}
