import { nameOf } from "../files/source.ts";
import type { NotUnderstood } from "../refusal.ts";
import { readDae, type DaeUp } from "./dae.ts";
import { readGltf } from "./gltf.ts";
import { readObj } from "./obj.ts";
import { readPly } from "./ply.ts";
import type { MeshRead } from "./report.ts";
import { readStl } from "./stl.ts";

/**
 * A mesh by the ending of its name: STL, OBJ, PLY, COLLADA, glTF.
 *
 * @param other  bytes of a file that this one names.
 * @param daeUp  which way is up in a COLLADA file.
 */
export function readMesh(
  name: string,
  bytes: Uint8Array,
  other?: (address: string) => Uint8Array | undefined,
  daeUp: DaeUp = "file",
): MeshRead | NotUnderstood {
  const ending = /\.([a-z0-9]+)$/i.exec(nameOf(name))?.[1]?.toLowerCase();
  switch (ending) {
    case "stl":
      return readStl(bytes);
    case "obj":
      return readObj(bytes);
    case "ply":
      return readPly(bytes);
    case "dae":
      return readDae(bytes, daeUp);
    case "glb":
    case "gltf":
      return readGltf(bytes, other);
    default:
      return {
        kind: "not-understood",
        sentence: `${nameOf(name)} is no mesh that is read: STL, OBJ, PLY, DAE, GLB and glTF are.`,
      };
  }
}
