import { angleBetween, fromMatrix, seededRandom } from "@twincell/core";
import { BASE_MARKER, type Lens, SheetTracker } from "@twincell/core/vision";
import { facing, renderTags, USUAL } from "../packages/core/src/vision/testing/render.ts";
import { figure, type Bench, type Figure } from "./figure.ts";

const PICTURES = 60;
const LENS: Lens = { width: 1280, height: 720, fx: 950, fy: 950, cx: 639.5, cy: 359.5, k1: -0.1, k2: 0.02 };
const MAX_TILT_RAD = Math.PI / 3;

/**
 * A printed tag of 100 mm in rendered pictures of 1280 × 720: how far the pose is off, and how long a picture takes.
 * Tilted by up to 60°, anywhere in the picture, blurred by 0.7 px, with noise of 2 grey levels and a distorting lens.
 */
export const run: Bench = () => {
  const figures: Figure[] = [];
  for (const [name, far_m] of [
    ["0.5m", 0.5],
    ["1m", 1],
    ["2m", 2],
  ] as const) {
    const random = seededRandom(16);
    const far_mm: number[] = [];
    const turned_deg: number[] = [];
    const took_ms: number[] = [];
    let found = 0;
    for (let i = 0; i < PICTURES; i++) {
      const R = facing(MAX_TILT_RAD * random(), 2 * Math.PI * random(), 2 * Math.PI * random());
      const t = [(random() - 0.5) * 0.6 * far_m, (random() - 0.5) * 0.3 * far_m, far_m];
      const picture = renderTags(LENS, BASE_MARKER.tags, R, t, USUAL, random);
      const tracker = new SheetTracker(LENS, BASE_MARKER);
      const began = performance.now();
      const { tags, cameraFromSheet } = tracker.look(picture, LENS.width, i);
      took_ms.push(performance.now() - began);
      if (tags === 0) continue;
      found++;
      const [x, y, z] = cameraFromSheet.position;
      far_mm.push(1000 * Math.hypot(x - t[0]!, y - t[1]!, z - far_m));
      turned_deg.push((180 / Math.PI) * angleBetween(cameraFromSheet.quaternion, fromMatrix(R)));
    }
    const p95 = (values: readonly number[]): string =>
      values.toSorted((a, b) => a - b)[Math.floor(0.95 * (values.length - 1))]!.toFixed(2);
    figures.push(
      figure(
        `marker/${name}-position`,
        "mm",
        far_mm,
        `found in ${found} of ${PICTURES}; 95 % within ${p95(far_mm)} mm`,
      ),
      figure(`marker/${name}-rotation`, "deg", turned_deg, `95 % within ${p95(turned_deg)}°`),
      figure(`marker/${name}-picture`, "ms", took_ms, `detection and pose on one core; 95 % within ${p95(took_ms)} ms`),
    );
  }
  return Promise.resolve(figures);
};
