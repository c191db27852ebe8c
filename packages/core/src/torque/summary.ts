import type { JointTorque, TorqueVerdict } from "../program/verdict.ts";

const load = ({ torque_Nm, limit_Nm }: JointTorque): number => (limit_Nm === null ? 0 : Math.abs(torque_Nm) / limit_Nm);

/** The joint that uses most of what it can give; undefined where torques are unknown. */
export const hardestJoint = (torque: TorqueVerdict): JointTorque | undefined =>
  torque.kind === "known"
    ? torque.joints.reduce<JointTorque | undefined>(
        (most, each) => (most === undefined || load(each) > load(most) ? each : most),
        undefined,
      )
    : undefined;

/** One sentence on the torques of a program. */
export function torqueSummary(torque: TorqueVerdict): string {
  if (torque.kind === "unknown") return torque.sentence;
  const most = hardestJoint(torque);
  if (most === undefined || most.limit_Nm === null) return "No joint is asked for torque.";
  return `Joint ${most.joint} is asked most: ${Math.abs(most.torque_Nm).toFixed(1)} of ${most.limit_Nm.toFixed(1)} N m at ${most.at_s.toFixed(2)} s.`;
}
