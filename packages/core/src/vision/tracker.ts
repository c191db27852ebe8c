import { fromMatrix, type Quaternion } from "../spatial/quaternion.ts";
import type { Pose } from "../spatial/pose.ts";
import { TagDetector } from "./detector.ts";
import type { Lens } from "./lens.ts";
import { type PlanarPose, PlanarPoseSolver } from "./planar-pose.ts";
import { PoseFilter } from "./pose-filter.ts";
import type { MarkerSheet, SheetTag } from "./sheet.ts";

/** The other pose is out of question when its error is so many times the best one's. */
const CLEAR_RATIO = 2.5;
/** How long a pose tells which of two explanations is meant [s]. */
const MEMORY_S = 0.5;

/** What one picture says about the sheet. Borrowed: the next picture writes it again. */
export interface SheetSighting {
  /** Tags of the sheet that were found. */
  tags: number;
  /** Where the sheet is, smoothed: cameraFromSheet, camera x right, y down, z forward. Only where tags > 0. */
  readonly cameraFromSheet: Pose;
  /** Root mean square distance of the corners from where the pose puts them [px]. */
  error_px: number;
  /** How many times larger the other explanation's error is; near 1 the picture alone does not tell which is true. */
  ratio: number;
}

/** Follows one sheet of tags from picture to picture. Nothing is allocated once it is made. */
export class SheetTracker {
  readonly detector: TagDetector;
  readonly sighting: SheetSighting;
  readonly #byId: readonly (SheetTag | undefined)[];
  readonly #solver = new PlanarPoseSolver();
  readonly #filter = new PoseFilter();
  readonly #square = new Float64Array(8);
  readonly #plane: Float64Array;
  readonly #seen: Float64Array;
  readonly #measured: Pose = { position: [0, 0, 0], quaternion: [0, 0, 0, 1] };
  readonly #candidate: Quaternion = [0, 0, 0, 1];
  #lens: Lens;
  #last_s = -Infinity;

  constructor(lens: Lens, sheet: MarkerSheet) {
    this.#lens = lens;
    this.detector = new TagDetector(lens);
    const byId: (SheetTag | undefined)[] = [];
    for (const tag of sheet.tags) byId[tag.id] = tag;
    this.#byId = byId;
    this.#plane = new Float64Array(8 * sheet.tags.length);
    this.#seen = new Float64Array(8 * sheet.tags.length);
    this.sighting = { tags: 0, cameraFromSheet: this.#filter.pose, error_px: 0, ratio: 0 };
  }

  /** Uses another lens from now on. @throws RangeError when it is one for pictures of another size */
  useLens(lens: Lens): void {
    this.detector.useLens(lens);
    this.#lens = lens;
    this.#filter.reset();
    this.#last_s = -Infinity;
  }

  /**
   * Looks for the sheet in a picture.
   *
   * @param gray   8-bit grey values, row by row
   * @param stride values from one row to the next
   * @param at_s   when the picture was taken, by any clock that only goes forward
   */
  look(gray: Uint8Array, stride: number, at_s: number): SheetSighting {
    const { detector, sighting } = this;
    const count = detector.detect(gray, stride);
    sighting.tags = 0;
    let largest = -1;
    let most_px = 0;
    for (let i = 0; i < count; i++) {
      const tag = this.#byId[detector.sightings[i]!.id];
      if (!tag || sighting.tags >= this.#plane.length / 8) continue;
      cornersOf(tag, tag.x_m, tag.y_m, this.#plane, 8 * sighting.tags);
      this.#seen.set(detector.sightings[i]!.corners, 8 * sighting.tags);
      sighting.tags++;
      if (detector.sightings[i]!.side_px > most_px) {
        most_px = detector.sightings[i]!.side_px;
        largest = i;
      }
    }
    if (largest < 0 || !this.#solve(detector.sightings[largest]!)) {
      sighting.tags = 0;
      return sighting;
    }
    this.#judge(at_s);
    this.#filter.add(this.#measured, at_s);
    this.#last_s = at_s;
    return sighting;
  }

  /** Both poses of the largest tag, moved to the sheet's middle and refined over every tag. */
  #solve({ id, corners }: { readonly id: number; readonly corners: Float64Array }): boolean {
    const tag = this.#byId[id]!;
    cornersOf(tag, 0, 0, this.#square, 0);
    if (!this.#solver.square(corners, tag.side_m, this.#square)) return false;
    for (let k = 0; k < 2; k++) {
      const pose = k === 0 ? this.#solver.best : this.#solver.other;
      for (let i = 0; i < 3; i++)
        pose.position[i]! -= pose.rotation[3 * i]! * tag.x_m + pose.rotation[3 * i + 1]! * tag.y_m;
      this.#solver.refine(pose, this.#seen, this.#plane, 4 * this.sighting.tags);
    }
    return true;
  }

  /** Which of both poses is meant: the one that fits better, or, when both do, the one nearer to the last. */
  #judge(at_s: number): void {
    const { best: a, other: b } = this.#solver;
    let chosen: PlanarPose = b.error < a.error ? b : a;
    let second: PlanarPose = chosen === a ? b : a;
    const clear = second.error > CLEAR_RATIO * chosen.error;
    if (!clear && at_s - this.#last_s < MEMORY_S && this.#closer(second, chosen)) {
      const kept = chosen;
      chosen = second;
      second = kept;
    }
    this.sighting.error_px = chosen.error * this.#lens.fx;
    this.sighting.ratio = second.error / Math.max(chosen.error, 1e-12);
    for (let i = 0; i < 3; i++) this.#measured.position[i] = chosen.position[i]!;
    fromMatrix(chosen.rotation, this.#measured.quaternion);
  }

  #closer(first: PlanarPose, than: PlanarPose): boolean {
    return this.#alike(first) > this.#alike(than);
  }
  #alike(pose: PlanarPose): number {
    const q = fromMatrix(pose.rotation, this.#candidate);
    const p = this.#filter.pose.quaternion;
    return Math.abs(q[0] * p[0] + q[1] * p[1] + q[2] * p[2] + q[3] * p[3]);
  }
}

function cornersOf({ side_m }: SheetTag, x: number, y: number, into: Float64Array, at: number): void {
  const half = side_m / 2;
  into[at] = x - half;
  into[at + 1] = y + half;
  into[at + 2] = x + half;
  into[at + 3] = y + half;
  into[at + 4] = x + half;
  into[at + 5] = y - half;
  into[at + 6] = x - half;
  into[at + 7] = y - half;
}
