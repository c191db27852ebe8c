import { isPassedOver, type MoveStep, type Step } from "@twincell/core";
import { remark } from "./names.ts";
import type { Place } from "./place.ts";
import { BlockWriter } from "./text-writer.ts";

/**
 * Writes lists of steps with their names and groups as remarks: `== group` before its steps, the name before the step.
 */
export abstract class StepWriter {
  protected readonly place: Place;
  /** Where the arm is before the next step, where that is known. */
  protected near: readonly number[] | undefined;
  /** The move before the next step, if nothing lies between them at which the robot stands. */
  protected before: MoveStep | undefined;
  private group = "";

  constructor(place: Place) {
    this.place = place;
    this.near = place.robot.home_rad;
  }

  /** What is said at one place holds nowhere else: routines and blocks say it anew. */
  protected begin(): void {
    this.before = undefined;
  }
  protected abstract remark(text: string, step: string): void;
  /** @param next  what is done after the step, if anything. */
  protected abstract step(step: Step, next: Step | undefined): void;

  protected steps(steps: readonly Step[]): void {
    const outer = this.group;
    for (const [i, step] of steps.entries()) {
      this.heading(step);
      // Nobody stops for a remark, or for what is computed.
      let next = i + 1;
      for (let after = steps[next]; after !== undefined && isPassedOver(after); after = steps[next]) next++;
      this.step(step, steps[next]);
      if (!isPassedOver(step) && step.type !== "wait") this.before = step.type === "move" ? step : undefined;
    }
    this.group = outer;
  }

  private heading(step: Step): void {
    const { groups } = this.place.program;
    const group = step.group === undefined ? "" : remark(groups[step.group]?.name ?? step.group);
    if (group !== this.group) this.remark(`== ${group}`.trimEnd(), step.id);
    this.group = group;
    const name = remark(step.name ?? "");
    if (name !== "" && step.type !== "comment") this.remark(` ${name}`, step.id);
  }
}

/** Writes steps into blocks that words open and close. */
export abstract class BlockStepWriter extends StepWriter {
  protected out = new BlockWriter();

  /** The steps inside a block. */
  protected inside(steps: readonly Step[], _step: string): void {
    this.begin();
    this.steps(steps);
  }

  protected loop(head: string, end: string, step: Extract<Step, { type: "repeat" | "while" }>): void {
    this.out.block(head, end, step.id, () => {
      this.inside(step.steps, step.id);
    });
    this.begin();
  }

  protected choice(step: Extract<Step, { type: "if" }>, head: string, otherwise: string, end: string): void {
    const { out } = this;
    out.add(head, step.id);
    out.indented(() => {
      this.inside(step.then, step.id);
    });
    if (step.else !== undefined) {
      out.add(otherwise, step.id);
      out.indented(() => {
        this.inside(step.else!, step.id);
      });
    }
    out.add(end, step.id);
    this.begin();
  }
}
