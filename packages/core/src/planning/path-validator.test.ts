import { expect, test } from "vitest";
import { CellCollider, robotAndCell } from "../collision/cell-collider.ts";
import { flangePose } from "../kinematics/forward.ts";
import { boxMesh } from "../mesh/index.ts";
import { seededRandom } from "../random.ts";
import { linkSolids, robotById } from "../robots/index.ts";
import { pose } from "../spatial/pose.ts";
import { PathValidator } from "./path-validator.ts";

const robot = robotById("ur10e")!;
const STEP_RAD = 0.01;
/** A UR10e bent forward, and a post that its wrist would meet when joint 1 has turned by 0.7 rad. */
const bent = robot.home_rad.map((q, i) => (i === 1 ? q + 0.8 : q));
const turned = (by_rad: number): number[] => bent.with(0, bent[0]! + by_rad);
const [x, y] = flangePose(robot.arm, turned(0.7)).position;
const collider = new CellCollider(
  {
    worldFromBase: pose(),
    allowedPairs: [],
    shapeError_m: 0,
    links: linkSolids(robot),
    objects: [{ id: "post", name: "Post", worldFromObject: pose([x, y, 1]), mesh: boxMesh([0.06, 0.06, 2]) }],
  },
  robot.arm,
);
const validator = (margin_m: number): PathValidator =>
  new PathValidator(collider, robot.arm, { margin_m, keepsMargin: robotAndCell });
/** Turning joint 1 on from there, step by step. */
const way = (from_rad: number, sign: 1 | -1, count: number): number[][] =>
  Array.from({ length: count }, (_, k) => turned(from_rad + sign * STEP_RAD * (k + 1)));
/** The last turn towards the post that touches nothing, to 1 mrad. */
let last = 0;
while (validator(0).free(turned(last + 0.001))) last += 0.001;

test("away from the post it ends with the first free posture; towards it there is no way out (200 seeded margins)", () => {
  const random = seededRandom(7);
  for (let n = 0; n < 200; n++) {
    const rules = validator(0.01 + 0.05 * random());
    const from = turned(last);
    if (rules.free(from)) continue;
    const away = way(last, -1, 60);
    const count = rules.wayOut(from, away);
    expect(count).toBeGreaterThan(0);
    expect(rules.free(away[count - 1]!)).toBe(true);
    expect(away.slice(0, count - 1).some(q => rules.free(q))).toBe(false);
    expect(rules.wayOut(from, way(last, 1, 60))).toBe(0);
  }
  expect(validator(0.01).free(turned(last))).toBe(false);
});

test("where it stands free there is nothing to leave; a way that ends too early is gone to its end", () => {
  expect(validator(0.01).wayOut(turned(0), way(0, 1, 10))).toBe(0);
  expect(validator(0.05).wayOut(turned(last), way(last, -1, 1))).toBe(1);
});

test("inside the post no direction counts as a way out: the distance has to grow", () => {
  const inside = turned(last + 3 * STEP_RAD);
  expect(validator(0).free(inside)).toBe(false);
  expect(validator(0.05).wayOut(inside, way(last + 3 * STEP_RAD, 1, 5))).toBe(0);
});
