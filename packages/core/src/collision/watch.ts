import { armScratch, flangePose } from "../kinematics/forward.ts";
import type { SerialArm } from "../model/arm.ts";
import { compose, identity, type Pose } from "../spatial/pose.ts";
import { CellCollider, clearance, robotAndCell, TOUCH_M, type Clearance } from "./cell-collider.ts";
import type { CellGeometry, Contact } from "./cell.ts";
import { ContactProbe } from "./contact-probe.ts";

/** What a cell must be told of to be watched; crosses a worker's border by structured clone. */
export interface WatchedCell {
  readonly geometry: CellGeometry;
  readonly arm: SerialArm;
  readonly flangeFromTcp: Pose<"flange", "tcp">;
  /** A posture known to be free: links that overlap there do so by design. */
  readonly free_rad: readonly number[];
  /** Clearance is measured below this; above it counts as plenty [m]. */
  readonly cutoff_m: number;
}

/** One look at the cell. */
export interface Sight {
  readonly contacts: readonly Contact[];
  /** Objects the tool point touches, nearer than 0.5 mm (row N-51). */
  readonly touched: readonly string[];
  /** Between the robot and what stands around it; the robot's distance from itself does not count. */
  readonly clearance: Clearance;
}

/** Watches a cell posture by posture: contacts, touch of the tool point, clearance. One watcher a worker. */
export function watchCell({
  geometry,
  arm,
  flangeFromTcp,
  free_rad,
  cutoff_m,
}: WatchedCell): (q_rad: ArrayLike<number>) => Sight {
  const collider = new CellCollider(geometry, arm);
  const probe = new ContactProbe(geometry.objects);
  collider.allowContactsAt(free_rad);
  const contacts: Contact[] = [];
  const touched: string[] = [];
  const near = clearance();
  const scratch = armScratch();
  const flange = identity<"base", "flange">();
  const tcp: Pose = identity();
  return q_rad => {
    collider.check(q_rad, contacts);
    compose(
      geometry.worldFromBase as Pose,
      compose(flangePose(arm, q_rad, flange, scratch), flangeFromTcp) as Pose,
      tcp,
    );
    probe.touches(tcp.position, TOUCH_M, touched);
    collider.clearance(q_rad, cutoff_m, near, robotAndCell);
    return { contacts, touched, clearance: near };
  };
}
