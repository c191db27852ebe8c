export { canBeLeft, canBeMet, type JerkLimits } from "./task.ts";
export { JerkMotion, MOST_PIECES } from "./motion.ts";
export { JerkPlanner, type JerkAnswer, type JerkState } from "./plan-jerk.ts";
