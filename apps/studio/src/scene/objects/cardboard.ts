import { seededRandom } from "@twincell/core";
import { CanvasTexture, Color, RepeatWrapping, SRGBColorSpace } from "three";

/** Whether an object of that colour is drawn as corrugated cardboard: brown and neither grey nor bright. */
export function looksLikeCardboard(color: string): boolean {
  const { h, s, l } = new Color(color).getHSL({ h: 0, s: 0, l: 0 });
  return h > 0.05 && h < 0.13 && s > 0.2 && l > 0.2 && l < 0.7;
}

/** Kraft paper: fine fibres and faint flutes, made here so that nothing is fetched. */
export function kraftTexture(color: string): CanvasTexture {
  const size = 256;
  const canvas = document.createElement("canvas");
  const random = seededRandom(7);
  canvas.width = canvas.height = size;
  const paint = canvas.getContext("2d")!;
  paint.fillStyle = color;
  paint.fillRect(0, 0, size, size);
  for (let y = 0; y < size; y += 8) {
    paint.fillStyle = "rgb(90 55 20 / 0.05)";
    paint.fillRect(0, y, size, 3);
  }
  for (let i = 0; i < 2600; i++) {
    paint.fillStyle = random() < 0.5 ? "rgb(60 35 12 / 0.09)" : "rgb(255 235 200 / 0.09)";
    paint.fillRect(random() * size, random() * size, 2 + random() * 12, 0.7);
  }
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  texture.wrapS = texture.wrapT = RepeatWrapping;
  texture.anisotropy = 4;
  return texture;
}
