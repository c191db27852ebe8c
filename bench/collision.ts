import { existsSync, readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import {
  boxMesh,
  CellCollider,
  checkJointLine,
  clearance,
  pose,
  type CellGeometry,
  type CellObject,
  type SerialArm,
  type Vector3,
} from "@twincell/core";
import { armFromUrdf, readStl, readUrdf, urdfSolids } from "@twincell/formats";
import { figure, microseconds, type Figure } from "./figure.ts";
import { planningFigures, type PlanningCell } from "./planning.ts";

interface SharedCell {
  readonly boxes: readonly { readonly center_m: Vector3; readonly half_size_m: Vector3 }[];
  readonly cases: readonly { readonly q_rad: readonly number[]; readonly collides: boolean }[];
}

const shared = new URL("../../shared/", import.meta.url);
const robotFolder = new URL("robots/kuka_kr6r900sixx/", shared);
export const isThere = (): boolean => existsSync(new URL("bench/kr6-cell.json", shared)) && existsSync(robotFolder);

function meshAt(place: URL) {
  const answer = readStl(readFileSync(place));
  if (answer.kind !== "read") throw new Error(`${place.pathname}: ${answer.sentence}`);
  return answer.mesh;
}

/** The KR 6 R900 among five boxes and the concave jig, and what the witness says of 1,000 postures. */
export function sharedCell(): {
  readonly collider: CellCollider;
  readonly arm: SerialArm;
  readonly cases: SharedCell["cases"];
  readonly peer: PlanningCell["peer"];
} {
  const { boxes, cases } = JSON.parse(readFileSync(new URL("bench/kr6-cell.json", shared), "utf8")) as SharedCell;
  const urdf = readUrdf(readFileSync(new URL("robot.urdf", robotFolder), "utf8"));
  const chain = urdf.kind === "read" ? armFromUrdf(urdf.robot) : urdf;
  if (chain.kind !== "chain") throw new Error(chain.sentence);
  const { solids } = urdfSolids(chain, reference => meshAt(new URL(reference, robotFolder)));
  const objects: CellObject[] = boxes.map(({ center_m, half_size_m }, i) => ({
    id: `box ${i + 1}`,
    name: `box ${i + 1}`,
    worldFromObject: pose(center_m),
    mesh: boxMesh(half_size_m.map(half => 2 * half) as Vector3),
  }));
  objects.push({ id: "jig", name: "jig", worldFromObject: pose(), mesh: meshAt(new URL("bench/fixture.stl", shared)) });
  const cell: CellGeometry = { worldFromBase: pose(), links: solids, objects, allowedPairs: [], shapeError_m: 0 };
  return {
    collider: new CellCollider(cell, chain.arm),
    arm: chain.arm,
    cases,
    peer: {
      urdf: fileURLToPath(new URL("robot.urdf", robotFolder)),
      folder: fileURLToPath(robotFolder),
      jig: fileURLToPath(new URL("bench/fixture.stl", shared)),
      boxes,
    },
  };
}

const ROUNDS = 15;

/** Exact verdicts of the shared cell: time per posture, and how many of the witness's 1,000 verdicts are the same. */
export function run(): Promise<readonly Figure[]> {
  if (!isThere()) {
    process.stderr.write("collision: the shared KR 6 cell is not beside the checkout and is left out.\n");
    return Promise.resolve([]);
  }
  const { collider, arm, cases, peer } = sharedCell();
  const near = clearance();
  const agreeing = cases.filter(({ q_rad, collides }) => collider.collides(q_rad) === collides).length;
  const perPosture = (ask: (q: readonly number[]) => unknown): number[] =>
    microseconds(cases.length, ROUNDS, i => {
      ask(cases[i]!.q_rad);
    });
  const free = cases.filter(({ collides }) => !collides).map(({ q_rad }) => q_rad);
  const motions = microseconds(100, 5, i => {
    checkJointLine(collider, free[2 * i]!, free[2 * i + 1]!);
  });
  return Promise.resolve([
    figure(
      "collision/kr6-exact",
      "us",
      perPosture(q => collider.collides(q)),
      "budget 50; coal mesh 54, parry 60 on the same postures",
    ),
    figure(
      "collision/kr6-contacts",
      "us",
      perPosture(q => collider.check(q)),
      "every pair in contact, not only the first",
    ),
    figure(
      "collision/kr6-clearance",
      "us",
      perPosture(q => collider.clearance(q, 0.05, near)),
      "smallest distance below 50 mm with its points",
    ),
    figure(
      "collision/kr6-motion",
      "us",
      motions,
      "whole joint-space line between two random free postures, proven or stopped at its first contact",
    ),
    figure("collision/kr6-agreement", "of 1000", [agreeing], "verdicts equal to coal's on exact meshes"),
    ...planningFigures({ collider, arm, free, peer }),
  ]);
}
