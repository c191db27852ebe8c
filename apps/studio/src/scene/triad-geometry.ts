import { type BufferGeometry, Color, ConeGeometry, CylinderGeometry, Float32BufferAttribute } from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";

/** Red, green and blue for x, y and z, light enough for the dark theme and dark enough for the light one. */
export const AXIS_COLOURS = ["#f2554c", "#37b26c", "#4f8dfa"] as const;

/** Three arrows as one geometry with vertex colours. */
export function triadGeometry(length_m: number, radius_m: number): BufferGeometry {
  const parts = AXIS_COLOURS.flatMap((colour, axis) => {
    const head = length_m * 0.24;
    const shaft = new CylinderGeometry(radius_m, radius_m, length_m - head, 8).translate(0, (length_m - head) / 2, 0);
    const cone = new ConeGeometry(radius_m * 2.6, head, 12).translate(0, length_m - head / 2, 0);
    return [shaft, cone].map(part => {
      if (axis === 0) part.rotateZ(-Math.PI / 2);
      if (axis === 2) part.rotateX(Math.PI / 2);
      const color = new Color(colour);
      const count = part.getAttribute("position").count;
      const values = new Float32Array(3 * count);
      for (let i = 0; i < count; i++) color.toArray(values, 3 * i);
      part.setAttribute("color", new Float32BufferAttribute(values, 3));
      part.deleteAttribute("uv");
      return part;
    });
  });
  return mergeGeometries(parts);
}
