import { describe, expect, test } from "vitest";
import { boxMesh, flangePose, linkPoses, identity, robotById, seededRandom, sphereMesh } from "@twincell/core";
import {
  armFromUrdf,
  filesInMemory,
  loadMeshes,
  readUrdf,
  solidShapes,
  urdfSolids,
  writeStl,
  writeUrdf,
} from "../index.ts";

const rx90l = robotById("staubli_rx90l")!.arm;
const text = writeUrdf(rx90l, { meshesOf: link => [`package://rx90l/meshes/Link_${link}.stl`] });
function chain() {
  const read = readUrdf(text);
  const found = read.kind === "read" ? armFromUrdf(read.robot) : read;
  if (found.kind !== "chain") throw new Error(found.sentence);
  return found;
}
const folder = (shape: (link: number) => Uint8Array | undefined) =>
  filesInMemory(
    new Map(
      [...Array.from({ length: 7 }, (_, link) => [`rx90l/meshes/link_${link}.stl`, shape(link)] as const)].flatMap(
        ([path, bytes]) => (bytes ? [[path, bytes] as const] : []),
      ),
    ),
  );

test("T-52, N-05 pivots are the drawing's values, whatever meshes hang on them", () => {
  const files = [
    folder(() => writeStl(boxMesh([0.1, 0.1, 0.3]))),
    folder(link => writeStl(sphereMesh(0.05 + link / 50, 12, 6))),
  ];
  const [boxes, balls] = files.map(source => {
    const found = chain();
    return {
      found,
      solids: urdfSolids(found, loadMeshes(solidShapes(found), "rx90l/urdf/rx90l.urdf", source).meshOf).solids,
    };
  });
  expect(boxes!.solids.map(({ link }) => link)).toEqual([0, 1, 2, 3, 4, 5, 6]);
  expect(boxes!.solids.map(({ mesh }) => mesh.indices.length)).not.toEqual(
    balls!.solids.map(({ mesh }) => mesh.indices.length),
  );

  const home = [0, -Math.PI / 2, Math.PI / 2, 0, 0, 0];
  const drawing = [0, 0.42, 0.42, 0.87, 0.87, 1.52, 1.52];
  const random = seededRandom(52);
  for (const {
    found: { arm },
  } of [boxes!, balls!]) {
    const links = Array.from({ length: 7 }, () => identity<"base", "link">());
    linkPoses(arm, home, links);
    links.forEach(({ position }, i) => {
      [0, 0, drawing[i]!].forEach((value, k) => {
        expect(position[k]).toBeCloseTo(value, 12);
      });
    });
  }
  for (let n = 0; n < 50; n++) {
    const q = home.map(() => 6 * random() - 3);
    expect(flangePose(boxes!.found.arm, q)).toEqual(flangePose(balls!.found.arm, q));
  }
});

describe("L-08 a missing mesh is listed and the rest is loaded", () => {
  test("missing, of another kind, spelt otherwise", () => {
    const found = chain();
    const files = folder(link =>
      link === 2 ? undefined : link === 3 ? new TextEncoder().encode("no mesh") : writeStl(boxMesh([0.1, 0.1, 0.1])),
    );
    const { meshOf, missing, notes } = loadMeshes(solidShapes(found), "rx90l/urdf/rx90l.urdf", files);
    const { solids, missing: unseen } = urdfSolids(found, meshOf);
    expect(solids.map(({ link }) => link)).toEqual([0, 1, 4, 5, 6]);
    expect(missing).toEqual([2, 3].map(link => `package://rx90l/meshes/Link_${link}.stl`));
    expect(unseen).toEqual(missing);
    expect(notes.slice(2, 4)).toEqual([
      "package://rx90l/meshes/Link_2.stl is missing in rx90l.",
      "package://rx90l/meshes/Link_3.stl is spelt rx90l/meshes/link_3.stl.",
    ]);
    expect(notes[4]).toBe("link_3.stl: The file has 7 bytes and does not begin with “solid”: it is no STL.");
  });
});
