import { remark } from "./names.ts";
import { BlockWriter } from "./text-writer.ts";
/** Writes lists of steps with their names and groups as remarks: `== group` before its steps, the name before the step. */
export class StepWriter {
    place;
    /** Where the arm is before the next step, where that is known. */
    near;
    /** The move before the next step, if nothing lies between them at which the robot stands. */
    before;
    group = "";
    constructor(place) {
        this.place = place;
        this.near = place.robot.home_rad;
    }
    /** What is said at one place holds nowhere else: routines and blocks say it anew. */
    begin() { this.before = undefined; }
    steps(steps) {
        const outer = this.group;
        for (const [i, step] of steps.entries()) {
            this.heading(step);
            // Nobody stops for a remark.
            let next = i + 1;
            while (steps[next]?.type === "comment")
                next++;
            this.step(step, steps[next]);
            if (step.type !== "comment" && step.type !== "wait")
                this.before = step.type === "move" ? step : undefined;
        }
        this.group = outer;
    }
    heading(step) {
        const { groups } = this.place.program, group = step.group === undefined ? "" : remark(groups[step.group]?.name ?? step.group);
        if (group !== this.group)
            this.remark(`== ${group}`.trimEnd(), step.id);
        this.group = group;
        const name = remark(step.name ?? "");
        if (name !== "" && step.type !== "comment")
            this.remark(` ${name}`, step.id);
    }
}
/** Writes steps into blocks that words open and close. */
export class BlockStepWriter extends StepWriter {
    out = new BlockWriter();
    /** The steps inside a block. */
    inside(steps, _step) {
        this.begin();
        this.steps(steps);
    }
    loop(head, end, step) {
        this.out.block(head, end, step.id, () => { this.inside(step.steps, step.id); });
        this.begin();
    }
    choice(step, head, otherwise, end) {
        const { out } = this;
        out.add(head, step.id);
        out.indented(() => { this.inside(step.then, step.id); });
        if (step.else !== undefined) {
            out.add(otherwise, step.id);
            out.indented(() => { this.inside(step.else, step.id); });
        }
        out.add(end, step.id);
        this.begin();
    }
}
