import { edgeTraceCell } from "@twincell/project";
import { linkShapes, robotById } from "@twincell/core";
import { RepeatWrapping, SRGBColorSpace } from "three";
import { afterEach, expect, test, vi } from "vitest";
import { partSurfaces } from "../robot/materials.ts";
import { kraftTexture, looksLikeCardboard } from "./cardboard.ts";

afterEach(() => {
  vi.unstubAllGlobals();
});

test("N-04 the robot wears painted castings, dark wrists and bare metal; every part of every link has a surface", () => {
  const surfaces = partSurfaces();
  const worn = new Set(linkShapes(robotById("staubli_rx90l")!).flatMap(link => link.parts.map(part => part.material)));
  expect(worn.size).toBeGreaterThanOrEqual(3);
  for (const name of worn) expect(surfaces[name].color).toMatch(/^#[0-9a-f]{6}$/);
  expect(new Set([...worn].map(name => surfaces[name].color)).size).toBe(worn.size);
  expect(surfaces.metal.metalness).toBeGreaterThan(surfaces.casting.metalness);
});

test("N-04 the carton of the cell is textured as cardboard, furniture and walls are not", () => {
  const { objects } = edgeTraceCell();
  expect(
    objects.filter(object => looksLikeCardboard(object.color) && object.role === "workpiece").map(object => object.id),
  ).toContain("carton");
  for (const object of objects.filter(({ role }) => role === "wall"))
    expect(looksLikeCardboard(object.color)).toBe(false);
  for (const color of ["#9aa7b0", "#ffffff", "#000000", "#2a6fd6"]) expect(looksLikeCardboard(color)).toBe(false);
});

test("N-04 the cardboard is painted here, the same each time, and repeats over the piece", () => {
  const painted = (): { readonly strokes: readonly string[]; readonly texture: ReturnType<typeof kraftTexture> } => {
    const strokes: string[] = [];
    const paint = {
      fillStyle: "",
      fillRect(...place: number[]) {
        strokes.push(`${this.fillStyle} ${place.join(" ")}`);
      },
    };
    vi.stubGlobal("document", { createElement: () => ({ width: 0, height: 0, getContext: () => paint }) });
    return { texture: kraftTexture("#b98a55"), strokes };
  };
  const { strokes, texture } = painted();
  expect(strokes[0]).toBe("#b98a55 0 0 256 256");
  expect(new Set(strokes).size).toBeGreaterThan(2000);
  expect(painted().strokes).toEqual(strokes);
  expect([texture.wrapS, texture.wrapT, texture.colorSpace]).toEqual([RepeatWrapping, RepeatWrapping, SRGBColorSpace]);
});
