import type { MeshReport } from "@twincell/formats";
import type { EncodedMesh } from "@twincell/project";
import type { Vector3 } from "@twincell/core";

export interface ToReader {
  readonly kind: "stl" | "obj" | "ply";
  readonly bytes: Uint8Array<ArrayBuffer>;
}
export type FromReader =
  | { readonly kind: "read"; readonly encoded: EncodedMesh; readonly report: MeshReport; readonly lowest: Vector3 }
  | { readonly kind: "not-understood"; readonly sentence: string };
