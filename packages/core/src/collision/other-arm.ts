import { armScratch, linkPoses } from "../kinematics/forward.ts";
import type { Robot } from "../model/robot.ts";
import { compose, copyPose, identity, type Pose } from "../spatial/pose.ts";
import type { CellCollider } from "./cell-collider.ts";
import type { LinkSolid } from "../mesh/link-solid.ts";
import type { CellObject } from "./cell.ts";

/**
 * Another robot of the cell as a collider meets it: its links as objects, put where the robot's joints have them. Their
 * ids begin with the id of the robot and a slash. Placing it allocates nothing.
 */
export class OtherArm {
  readonly id: string;
  readonly name: string;
  readonly robot: Robot;
  /** As they stood when it was last placed. */
  readonly objects: readonly CellObject[];
  readonly #worldFromBase: Pose<"world", "base">;
  readonly #links: readonly number[];
  readonly #baseFromLinks: Pose<"base", "link">[];
  readonly #scratch = armScratch();

  /** @param links  `linkSolids(robot)`; the same meshes for every collider, so that their trees are built once. */
  constructor(
    id: string,
    name: string,
    robot: Robot,
    links: readonly LinkSolid[],
    worldFromBase: Pose<"world", "base">,
    q_rad: ArrayLike<number> = robot.home_rad,
  ) {
    this.id = id;
    this.name = name;
    this.robot = robot;
    this.#worldFromBase = copyPose(worldFromBase);
    this.#links = links.map(({ link }) => link);
    this.#baseFromLinks = Array.from({ length: robot.arm.joints.length + 1 }, () => identity<"base", "link">());
    this.objects = links.map(({ link, mesh }, i) => ({
      id: `${id}/${i}`,
      name: link === 0 ? `the base of ${name}` : `link ${link} of ${name}`,
      worldFromObject: identity<"world", "object">(),
      mesh,
    }));
    this.#put(q_rad);
  }

  /** Moves its links in a collider that has its objects. */
  place(q_rad: ArrayLike<number>, collider: CellCollider): void {
    this.#put(q_rad);
    for (const { id, worldFromObject } of this.objects) collider.moveObject(id, worldFromObject);
  }

  #put(q_rad: ArrayLike<number>): void {
    linkPoses(this.robot.arm, q_rad, this.#baseFromLinks, this.#scratch);
    for (let i = 0; i < this.objects.length; i++)
      compose(
        this.#worldFromBase as Pose,
        this.#baseFromLinks[this.#links[i]!] as Pose,
        this.objects[i]!.worldFromObject as Pose,
      );
  }
}
