import type { Lens } from "@twincell/core/vision";
import type { Matrix4 } from "three";

/**
 * The projection of a camera's lens for a view that shows its picture as large as needed to fill it, cut at two sides
 * alike. Distortion is left out: straight edges are drawn straight.
 *
 * @param width  of the view, in any unit
 * @param height of the view, in the same
 */
export function lensProjection(
  lens: Lens,
  width: number,
  height: number,
  near_m: number,
  far_m: number,
  out: Matrix4,
): Matrix4 {
  const scale = Math.max(width / lens.width, height / lens.height);
  // Pixel centres have whole coordinates: the picture begins half a pixel before the first.
  const middleX = (2 * (scale * (lens.cx + 0.5) + (width - scale * lens.width) / 2)) / width - 1;
  const middleY = 1 - (2 * (scale * (lens.cy + 0.5) + (height - scale * lens.height) / 2)) / height;
  const depth = far_m - near_m;
  return out.set(
    (2 * scale * lens.fx) / width,
    0,
    -middleX,
    0,
    0,
    (2 * scale * lens.fy) / height,
    -middleY,
    0,
    0,
    0,
    -(far_m + near_m) / depth,
    (-2 * far_m * near_m) / depth,
    0,
    0,
    -1,
    0,
  );
}
