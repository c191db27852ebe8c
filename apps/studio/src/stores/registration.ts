import { compose, inverse, pose, registerBase, TIP_NOISE, type BaseRegistration, type Touch } from "@twincell/core";
import { createStore } from "zustand/vanilla";
import { words } from "../messages/index.ts";
import { cellStore } from "./cell.ts";
import { commit } from "./document.ts";

/** A point of the cell that the robot's tip was driven to. */
export interface RegistrationPoint extends Touch {
  readonly id: number;
}
/** What is taken to find where a real robot stands in the cell. It stays while the page is open. */
export interface RegistrationState {
  readonly points: readonly RegistrationPoint[];
  /** How well the tip is brought to a point: one standard deviation [m]. */
  readonly touch_m: number;
  /** What a point that was touched again said. */
  readonly checked: string;
}
export const registrationStore = createStore<RegistrationState>(() => ({
  points: [],
  touch_m: TIP_NOISE.position_m,
  checked: "",
}));
export const MAX_POINTS = 6;

/** What the points say, by the noise that a touch has. */
export const registrationOf = ({ points, touch_m }: RegistrationState): BaseRegistration =>
  registerBase(points, [], { ...TIP_NOISE, position_m: touch_m });

let last = 0;
/** Adds the point at which the tool stands now. @param worldFromTcp as the cell draws it */
export function addRegistrationPoint(worldFromTcp: Parameters<typeof compose>[1], now_s: number): void {
  const { document } = cellStore.getState();
  if (!document) return;
  const { position: base } = compose(inverse(document.robot.worldFromBase), pose(worldFromTcp.position, [0, 0, 0, 1]));
  const [x, y, z] = worldFromTcp.position;
  registrationStore.setState(({ points }) => ({
    points: [...points, { id: ++last, base, world: [x, y, z], at_s: now_s }],
    checked: "",
  }));
}
export function changeRegistrationPoint(id: number, axis: number, value_m: number): void {
  registrationStore.setState(({ points }) => ({
    points: points.map(point =>
      point.id === id
        ? {
            ...point,
            world: [
              axis === 0 ? value_m : point.world[0],
              axis === 1 ? value_m : point.world[1],
              axis === 2 ? value_m : point.world[2],
            ],
          }
        : point,
    ),
    checked: "",
  }));
}
export const removeRegistrationPoint = (id: number): void =>
  registrationStore.setState(({ points }) => ({ points: points.filter(point => point.id !== id), checked: "" }));

/** Rounded up to what the field of the registration error shows [m]. */
const SHOWN_M = 1e-4;
export const keptError = (bound_m: number): number => Math.ceil(bound_m / SHOWN_M) * SHOWN_M;
/**
 * Puts the robot where it was found, and keeps what is not known of that in the cell: the guard and every check add it
 * to what they keep clear (row T-64).
 *
 * @param bound_m the largest 95 % bound at the base and at the points
 */
export function applyRegistration(worldFromBase: Parameters<typeof inverse>[0], bound_m: number): void {
  commit(words.undo.registration, document => ({
    ...document,
    robot: { ...document.robot, worldFromBase: pose(worldFromBase.position, worldFromBase.quaternion) },
    errors: { ...document.errors, registration_m: keptError(bound_m) },
  }));
}
