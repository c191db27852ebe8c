import { linkShapes, robotById } from "@twincell/core";
import { expect, test } from "vitest";
import { linkDrawings } from "./link-geometry.ts";
import { partSurfaces } from "./materials.ts";

test("each link is one draw call in which every corner wears the surface of its part", () => {
  const robot = robotById("staubli_rx90l")!;
  const shapes = linkShapes(robot).filter(shape => shape.parts.length > 0);
  const drawings = linkDrawings(robot);
  expect(drawings.map(({ link }) => link)).toEqual(shapes.map(({ link }) => link));
  const surfaces = partSurfaces(robot.paint);
  drawings.forEach(({ geometry }, i) => {
    const corners = shapes[i]!.parts.flatMap(part => Array.from(part.mesh.indices, () => surfaces[part.material]));
    expect(geometry.getAttribute("position").count).toBe(corners.length);
    const worn = geometry.getAttribute("surface");
    corners.forEach((surface, corner) => {
      expect(worn.getX(corner)).toBeCloseTo(surface.roughness, 6);
      expect(worn.getY(corner)).toBeCloseTo(surface.metalness, 6);
    });
  });
});
