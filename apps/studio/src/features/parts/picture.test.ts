import { PARTS, partNumbers } from "@twincell/project";
import { expect, test } from "vitest";
import { words } from "../../messages/index.ts";
import { partName } from "../../messages/phrases.ts";
import { partPicture } from "./picture.ts";

test.each(PARTS.map(part => [part.id, part] as const))(
  "%s has a name, names for its numbers, and a picture that fills its frame",
  (id, part) => {
    expect(partName(id)).toMatch(/^[A-Z]/);
    for (const { id: parameter } of part.parameters) expect(words.parts.parameters[parameter]).toMatch(/^[A-Z]/);
    const { faces, viewBox } = partPicture({ kind: "part", part: id, parameters: partNumbers(part, {}) });
    const [left = 0, top = 0, width = 0] = viewBox.split(" ").map(Number);
    expect(faces.length).toBeGreaterThan(5);
    for (const { points } of faces)
      for (const [x = NaN, y = NaN] of points.split(" ").map(pair => pair.split(",").map(Number))) {
        expect(x).toBeGreaterThanOrEqual(left);
        expect(x).toBeLessThanOrEqual(left + width);
        expect(y).toBeGreaterThanOrEqual(top);
        expect(y).toBeLessThanOrEqual(top + width);
      }
  },
);
