import { branchOf } from "@twincell/core";
import { fixed } from "../../writing/index.ts";
/** A tenth of a micrometre, and a hundred-thousandth of a degree. */
const DECIMALS = { mm: 4, deg: 5, part: 7 };
export const mm = (value_m) => fixed(value_m * 1000, DECIMALS.mm);
export const deg = (value_rad) => fixed(value_rad / Math.PI * 180, DECIMALS.deg);
export const part = (value) => fixed(value, DECIMALS.part);
export const posText = (position_m) => `[${Array.from(position_m, mm).join(",")}]`;
/**
 * q1 … q4 = w, x, y, z with the first that is not 0 positive. Cut digits shorten a quaternion and the controller makes it
 * whole again: the digits written are those that this leaves as they are.
 */
export function orientText([x, y, z, w]) {
    const first = [w, x, y, z].find(value => Math.abs(value) > 1e-7) ?? 1, sign = first < 0 ? -1 : 1;
    let parts = [w, x, y, z].map(value => value * sign), text = "";
    for (let i = 0; i < 8; i++) {
        const size = Math.hypot(...parts), next = parts.map(value => part(value / size));
        if (next.join(",") === text)
            break;
        text = next.join(",");
        parts = next.map(Number);
    }
    return `[${text}]`;
}
export const poseText = ({ position, quaternion }) => `[${posText(position)},${orientText(quaternion)}]`;
/** No axis outside the robot. */
export const NO_AXES = "[9E9,9E9,9E9,9E9,9E9,9E9]";
/** Quarters of a turn of axes 1, 4 and 6 and, for a spherical wrist, which of the eight postures it is. */
export function confText(robot, q_rad, hasCfx) {
    if (q_rad === undefined)
        return "[0,0,0,0]";
    const quarter = (joint) => Math.floor(Number(deg(q_rad[joint])) / 90), branch = hasCfx ? branchOf(robot, q_rad) : undefined;
    const isBack = branch?.shoulder === "back", isUnder = branch !== undefined && (branch.elbow === "up") === isBack;
    return `[${quarter(0)},${quarter(3)},${quarter(5)},${(isBack ? 4 : 0) + (isUnder ? 2 : 0) + (branch?.wrist === "negative" ? 1 : 0)}]`;
}
export const targetText = (pose, conf) => `[${posText(pose.position)},${orientText(pose.quaternion)},${conf},${NO_AXES}]`;
export const jointsText = (q_rad) => `[[${Array.from(q_rad, deg).join(",")}],${NO_AXES}]`;
/** A tool without a load of its own: what the flange carries is said by GripLoad. */
export const toolText = (tool) => `[TRUE,${poseText(tool)},[0.001,[0,0,0.001],[1,0,0,0],0,0,0]]`;
export const objectText = (frame) => `[FALSE,TRUE,"",${poseText(frame)},[[0,0,0],[1,0,0,0]]]`;
export const speedText = (v_mmps) => `[${v_mmps},500,5000,1000]`;
/** A zone as the predefined ones are made: half as much again for the orientation, a degree for every ten millimetres of that. */
export function zoneText(zone_mm) {
    const orient = fixed(1.5 * Number(zone_mm), 4), turn = fixed(0.15 * Number(zone_mm), 4);
    return `[FALSE,${zone_mm},${orient},${orient},${turn},${orient},${turn}]`;
}
