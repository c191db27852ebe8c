import type { Pose } from "../spatial/pose.ts";
import type { Vector3 } from "../spatial/vector.ts";
import type { TriangleMesh } from "../mesh/mesh.ts";
import { tetrahedronMesh } from "../mesh/solids.ts";
import { pairScratch, type PairScratch } from "./intersect.ts";
import { between, rigid, rigidFromPose, type Rigid } from "./relative.ts";
import { buildSolid, solidDistance, type Solid } from "./solid.ts";

/** Half the size of the point that feels: far below any tolerance of a robot. */
const POINT_M = 1e-6;

/** A solid as small as a point. */
export const POINT_MESH: TriangleMesh = tetrahedronMesh(POINT_M);

interface Felt {
  readonly id: string;
  readonly solid: Solid;
  readonly worldFromObject: Rigid;
}

/**
 * Feels with the point of a tool: which objects are nearer to it than a given distance (row N-51).
 * The solid of a tool usually ends before its TCP, so that a point can rest on an edge without counting as a collision.
 */
export class ContactProbe {
  readonly #objects: readonly Felt[];
  readonly #point: Solid;
  readonly #worldFromPoint = rigid();
  readonly #relative = rigid();
  readonly #scratch: PairScratch = pairScratch();
  readonly #points = new Float64Array(6);

  constructor(
    objects: readonly { readonly id: string; readonly mesh: TriangleMesh; readonly worldFromObject: Pose }[],
  ) {
    this.#objects = objects.map(({ id, mesh, worldFromObject }) => ({
      id,
      solid: buildSolid(mesh),
      worldFromObject: rigidFromPose(worldFromObject),
    }));
    this.#point = buildSolid(POINT_MESH);
  }

  /**
   * Ids of the objects nearer than `within_m` to the point, in an emptied `out`. A point inside an object touches it.
   */
  touches(world: Vector3, within_m: number, out: string[] = []): string[] {
    out.length = 0;
    this.#worldFromPoint[9] = world[0];
    this.#worldFromPoint[10] = world[1];
    this.#worldFromPoint[11] = world[2];
    for (const { id, solid, worldFromObject } of this.#objects) {
      this.#scratch.witness.fill(-1);
      between(this.#worldFromPoint, worldFromObject, this.#relative);
      if (solidDistance(this.#point, solid, this.#relative, within_m, this.#scratch, this.#points) < within_m)
        out.push(id);
    }
    return out;
  }
}
