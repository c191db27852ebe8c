import { IK_METHODS, solveBy, type IkMethod, type Pose, type Robot } from "@twincell/core";
import { UseFault } from "./usage.ts";

/** `--method`: undefined for the closed form with all its branches. */
export function methodOf(name: string | undefined): readonly IkMethod[] | undefined {
  if (name === undefined || name === "closed") return undefined;
  if (name === "compare") return IK_METHODS;
  const method = IK_METHODS.find(each => each === name);
  if (method === undefined)
    throw new UseFault(`There is no method "${name}".`, `Methods: ${IK_METHODS.join(", ")}, compare.`);
  return [method];
}

/** What each method makes of one pose, from the start angles, with the time it took. */
export function tried(
  methods: readonly IkMethod[],
  robot: Robot,
  baseFromFlange: Pose<"base", "flange">,
  start: ArrayLike<number>,
): Record<string, unknown>[] {
  return methods.map(method => {
    const began = performance.now();
    const { q_rad, position_m, angle_rad, iterations, jump_rad, sentence } = solveBy(
      method,
      robot,
      baseFromFlange,
      start,
    );
    const took_ms = performance.now() - began;
    const numbers =
      q_rad === null
        ? {}
        : { q: Array.from(q_rad), position_error_m: position_m, angle_error_rad: angle_rad, iterations, jump_rad };
    return { method, ...numbers, took_ms, sentence };
  });
}
