import { partPieces, type PartMaterial, type PartPiece, type Shape } from "@twincell/project";
import {
  BoxGeometry,
  type BufferGeometry,
  CanvasTexture,
  CylinderGeometry,
  type Material,
  MeshStandardMaterial,
  RepeatWrapping,
  SphereGeometry,
  SRGBColorSpace,
} from "three";
import { RoundedBoxGeometry } from "three/examples/jsm/geometries/RoundedBoxGeometry.js";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { seededRandom } from "@twincell/core";
import { kraftTexture } from "./cardboard.ts";

/** Thinner boxes have no bevel: it would not be seen. */
const BEVEL_FROM_M = 0.012;
const BEVEL_M = 0.003;
const SIDES = 24;

function pieceGeometry(piece: PartPiece): BufferGeometry {
  switch (piece.kind) {
    case "box": {
      const [x, y, z] = piece.size_m;
      const least = Math.min(x, y, z);
      const geometry =
        least < BEVEL_FROM_M
          ? new BoxGeometry(x, y, z).toNonIndexed()
          : new RoundedBoxGeometry(x, y, z, 1, Math.min(BEVEL_M, least * 0.2));
      if (piece.turn_rad !== undefined) geometry.rotateZ(piece.turn_rad);
      return geometry;
    }
    case "cylinder": {
      const geometry = new CylinderGeometry(piece.radius_m, piece.radius_m, piece.length_m, SIDES).toNonIndexed();
      // three's cylinders stand along y.
      if (piece.axis === 2) geometry.rotateX(Math.PI / 2);
      if (piece.axis === 0) geometry.rotateZ(Math.PI / 2);
      return geometry;
    }
    case "ball":
      return new SphereGeometry(piece.radius_m, SIDES, SIDES / 2).toNonIndexed();
  }
}

/** What a part is drawn of: one geometry a material, so that a conveyor is four draw calls and not sixty. */
export function partGeometries(
  shape: Extract<Shape, { kind: "part" }>,
): readonly { readonly material: PartMaterial; readonly geometry: BufferGeometry }[] {
  const by = new Map<PartMaterial, BufferGeometry[]>();
  for (const piece of partPieces(shape)) {
    if (piece.only === "solid") continue;
    const geometry = pieceGeometry(piece);
    geometry.translate(...piece.at_m);
    by.set(piece.material, [...(by.get(piece.material) ?? []), geometry]);
  }
  return Array.from(by, ([material, pieces]) => {
    const geometry = mergeGeometries(pieces);
    for (const piece of pieces) piece.dispose();
    return { material, geometry };
  });
}

/** Boards of pine: a grain of fine lines, made here so that nothing is fetched. */
function woodTexture(): CanvasTexture {
  const canvas = document.createElement("canvas");
  const random = seededRandom(3);
  canvas.width = canvas.height = 256;
  const paint = canvas.getContext("2d")!;
  paint.fillStyle = "#c8a26c";
  paint.fillRect(0, 0, 256, 256);
  for (let i = 0; i < 240; i++) {
    paint.fillStyle = random() < 0.6 ? "rgb(95 60 25 / 0.08)" : "rgb(255 235 200 / 0.07)";
    paint.fillRect(0, random() * 256, 256, 0.6 + random() * 2.4);
  }
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  texture.wrapS = texture.wrapT = RepeatWrapping;
  return texture;
}

const PAINTS: Readonly<Record<PartMaterial, () => Material>> = {
  "paint-yellow": () => new MeshStandardMaterial({ color: "#f2b100", roughness: 0.36 }),
  "paint-grey": () => new MeshStandardMaterial({ color: "#4a535a", roughness: 0.4 }),
  "paint-blue": () => new MeshStandardMaterial({ color: "#2f6db5", roughness: 0.38 }),
  aluminium: () => new MeshStandardMaterial({ color: "#c3c9cd", metalness: 0.55, roughness: 0.36 }),
  steel: () => new MeshStandardMaterial({ color: "#b9c0c6", metalness: 0.85, roughness: 0.28 }),
  rubber: () => new MeshStandardMaterial({ color: "#22272b", roughness: 0.9 }),
  wood: () => new MeshStandardMaterial({ map: woodTexture(), roughness: 0.88 }),
  cardboard: () => new MeshStandardMaterial({ map: kraftTexture("#b98a5a"), roughness: 0.92 }),
  tape: () => new MeshStandardMaterial({ color: "#c9a572", roughness: 0.28 }),
  glass: () => new MeshStandardMaterial({ color: "#1f6b4d", roughness: 0.1, metalness: 0.1 }),
  red: () => new MeshStandardMaterial({ color: "#c22b22", roughness: 0.4 }),
  black: () => new MeshStandardMaterial({ color: "#23282c", roughness: 0.5 }),
  "fabric-orange": () => new MeshStandardMaterial({ color: "#ef7d1a", roughness: 0.85 }),
  "fabric-dark": () => new MeshStandardMaterial({ color: "#2b3440", roughness: 0.9 }),
  skin: () => new MeshStandardMaterial({ color: "#d8a582", roughness: 0.7 }),
  white: () => new MeshStandardMaterial({ color: "#e6e9eb", roughness: 0.45 }),
};
const made = new Map<PartMaterial, Material>();
/** One material for all parts that wear it. */
export function partMaterial(name: PartMaterial): Material {
  let material = made.get(name);
  if (!material) made.set(name, (material = PAINTS[name]()));
  return material;
}
