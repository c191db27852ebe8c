export { canBeLeft, canBeReached, type JerkLimits } from "./task.ts";
export { JerkMotion, MAX_PIECES } from "./motion.ts";
export { JerkPlanner, type JerkAnswer, type JerkState } from "./plan-jerk.ts";
