import { inverse } from "@twincell/core";
import type { ToolRecord } from "@twincell/project";
import { type BufferGeometry, Matrix4, SphereGeometry } from "three";
import { shapeGeometry } from "../objects/shape-geometry.ts";
import { poseMatrix } from "../pose-matrix.ts";

/** The tool as seen from its tip; a small ball for a bare flange. */
export const ghostGeometry = (tool: ToolRecord | undefined): BufferGeometry =>
  tool?.shape
    ? shapeGeometry(tool.shape).applyMatrix4(poseMatrix(inverse(tool.flangeFromTcp), new Matrix4()))
    : new SphereGeometry(0.02, 20, 14);
