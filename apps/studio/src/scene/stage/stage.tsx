import type { CellDocument } from "@twincell/project";
import { useMemo } from "react";
import { Box3, Matrix4 } from "three";
import { shapeGeometry } from "../objects/shape-geometry.ts";
import { poseMatrix } from "../pose-matrix.ts";
import type { SceneTheme } from "../theme.ts";
import { ContactShadow } from "./contact-shadow.tsx";
import { Floor } from "./floor.tsx";
import { Light } from "./light.tsx";
import { Sky } from "./sky.tsx";

interface Standing {
  readonly id: string;
  readonly box: Box3;
}

/** Axis-parallel boxes of everything that could stand or be stood on. */
function standing(document: CellDocument): Standing[] {
  const matrix = new Matrix4();
  return document.objects
    .filter(object => object.role !== "wall")
    .map(object => {
      const geometry = shapeGeometry(object.shape);
      geometry.computeBoundingBox();
      const box = geometry.boundingBox!.clone().applyMatrix4(poseMatrix(object.worldFromObject, matrix));
      geometry.dispose();
      return { id: object.id, box };
    });
}

const rests = (above: Box3, below: Box3): boolean =>
  Math.abs(above.min.z - below.max.z) < 0.004 &&
  above.min.x < below.max.x &&
  above.max.x > below.min.x &&
  above.min.y < below.max.y &&
  above.max.y > below.min.y;

/** What the cell stands in: floor, backdrop, light, and the contact shadows of what stands on something. */
export function RunContext({
  theme,
  document,
  sky,
  room,
}: {
  readonly theme: SceneTheme;
  readonly document: CellDocument;
  readonly sky: boolean;
  /** Floor and backdrop are drawn; not where a camera shows the real ones. */
  readonly room: boolean;
}) {
  const things = useMemo(() => standing(document), [document]);
  const strength = theme.dark ? 0.62 : 0.34;
  const base = document.robot.worldFromBase.position;
  return (
    <>
      {sky && room && <Sky theme={theme} />}
      {room && <Floor theme={theme} />}
      <Light theme={theme} anyChange={document} />
      {base[2] < 0.004 && (
        <ContactShadow halfX_m={0.165} halfY_m={0.165} round_m={0.165} at={base} strength={strength} reach_m={0.16} />
      )}
      {(room ? things : [])
        .filter(
          thing => thing.box.min.z < 0.004 || things.some(other => other !== thing && rests(thing.box, other.box)),
        )
        .map(({ id, box }) => (
          <ContactShadow
            key={id}
            at={[(box.min.x + box.max.x) / 2, (box.min.y + box.max.y) / 2, box.min.z]}
            strength={strength * 0.85}
            reach_m={Math.min(0.09, (box.max.x - box.min.x + box.max.y - box.min.y) * 0.25)}
            halfX_m={(box.max.x - box.min.x) / 2}
            halfY_m={(box.max.y - box.min.y) / 2}
            round_m={0.004}
          />
        ))}
    </>
  );
}
