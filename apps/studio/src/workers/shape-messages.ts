import type { ImportReport, LightReport, UnitGuess } from "@twincell/formats";
import type { ObjectRecord } from "@twincell/project";

export type ShapeRequest =
  | {
      readonly kind: "import";
      /** Everything that was dropped, by path: what a file names is looked for among them. */
      readonly files: readonly { readonly path: string; readonly bytes: Uint8Array<ArrayBuffer> }[];
      /** Ids that objects of the cell have. */
      readonly taken: readonly string[];
    }
  | { readonly kind: "scale"; readonly objects: readonly ObjectRecord[]; readonly factor: number }
  | { readonly kind: "light"; readonly objects: readonly ObjectRecord[]; readonly faces: number };

/** A file that was read, ready to be put into the cell. */
export interface ImportedFile {
  readonly file: string;
  readonly unit: UnitGuess;
  readonly report: ImportReport;
  readonly objects: readonly ObjectRecord[];
}
export type ShapeAnswer =
  | { readonly kind: "imported"; readonly files: readonly ImportedFile[] }
  | { readonly kind: "scaled"; readonly objects: readonly ObjectRecord[] }
  | { readonly kind: "light"; readonly objects: readonly ObjectRecord[]; readonly report: LightReport }
  | { readonly kind: "not-understood"; readonly sentence: string };
