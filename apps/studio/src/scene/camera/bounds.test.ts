import { Box3, PerspectiveCamera, Vector3 } from "three";
import { expect, test } from "vitest";
import { fitDistance } from "./bounds.ts";

test("after fitting every corner of the box is inside the picture, and one touches the margin", () => {
  const bounds = new Box3(new Vector3(-0.4, 0, -0.9), new Vector3(1.1, 2.3, 0.6));
  for (const aspect of [0.6, 1, 1.78]) {
    for (const way of [new Vector3(-1, -0.4, -0.6), new Vector3(0, -1, 0), new Vector3(1, 0, 0)]) {
      const camera = new PerspectiveCamera(32, aspect, 0.05, 60);
      const centre = bounds.getCenter(new Vector3());
      camera.up.set(0, Math.abs(way.y) > 0.99 ? 0 : 1, Math.abs(way.y) > 0.99 ? -1 : 0);
      camera.position.copy(centre).addScaledVector(way.clone().normalize(), -fitDistance(bounds, way, camera, 1));
      camera.lookAt(centre);
      camera.updateMatrixWorld();
      let most = 0;
      for (let corner = 0; corner < 8; corner++) {
        const at = new Vector3(corner & 1 ? 1.1 : -0.4, corner & 2 ? 2.3 : 0, corner & 4 ? 0.6 : -0.9).project(camera);
        most = Math.max(most, Math.abs(at.x), Math.abs(at.y));
      }
      expect(most).toBeCloseTo(1, 6);
    }
  }
});
