import type { Pose } from "@twincell/core";
import type { ImportReport, LightReport, Rig, UnitGuess } from "@twincell/formats";
import type { ObjectRecord } from "@twincell/project";
import type { KeptRobotFile } from "../stores/own-robots.ts";

export type ShapeRequest =
  | {
      readonly kind: "import";
      /** Everything that was dropped, by path: what a file names is looked for among them. */
      readonly files: readonly { readonly path: string; readonly bytes: Uint8Array<ArrayBuffer> }[];
      /** Ids that objects of the cell have. */
      readonly taken: readonly string[];
      /** Whether a description of a robot among them may be a robot; else its links are parts. */
      readonly robots: boolean;
    }
  | { readonly kind: "scale"; readonly objects: readonly ObjectRecord[]; readonly factor: number }
  | { readonly kind: "light"; readonly objects: readonly ObjectRecord[]; readonly faces: number }
  | { readonly kind: "rig"; readonly rig: Rig };

/** A file that was read, ready to be put into the cell. */
export interface ImportedFile {
  readonly file: string;
  readonly unit: UnitGuess;
  readonly report: ImportReport;
  readonly objects: readonly ObjectRecord[];
}
export type ShapeAnswer =
  /** It can be the robot of the cell: a person says whether it shall. */
  | {
      readonly kind: "robot";
      readonly name: string;
      readonly file: KeptRobotFile;
      readonly notes: readonly string[];
      /** It could also be parts that stand in the cell. */
      readonly hasParts: boolean;
    }
  | { readonly kind: "imported"; readonly files: readonly ImportedFile[] }
  | { readonly kind: "scaled"; readonly objects: readonly ObjectRecord[] }
  | { readonly kind: "light"; readonly objects: readonly ObjectRecord[]; readonly report: LightReport }
  | {
      readonly kind: "rigged";
      readonly file: KeptRobotFile;
      readonly notes: readonly string[];
      readonly worldFromBase: Pose<"world", "base">;
    }
  | { readonly kind: "not-understood"; readonly sentence: string };
