import { pose } from "@twincell/core";
import { edgeTraceCell, savedCoords } from "@twincell/project";
import { beforeEach, expect, test } from "vitest";
import { cellStore } from "./cell.ts";
import { programOf, showDocument, undo } from "./document.ts";
import { forgetPoses, keepPose, movePose, movesThroughPoses, posesText, readPoses } from "./poses.ts";

const saved = (): readonly { name: string; x: number }[] =>
  savedCoords(cellStore.getState().document!).map(({ name, worldFromFrame }) => ({
    name,
    x: worldFromFrame.position[0],
  }));
beforeEach(() => {
  showDocument(edgeTraceCell());
});

test("L-44 L-45 a pose is kept under a free name and put elsewhere, reachable or not; each is one undo", () => {
  keepPose(pose([0.5, 0, 0.4]));
  keepPose(pose([0.6, 0, 0.4]));
  expect(saved()).toEqual([
    { name: "Pose", x: 0.5 },
    { name: "Pose 2", x: 0.6 },
  ]);
  movePose("Pose 2", pose([9, 0, 0.4]));
  expect(saved()[1]).toEqual({ name: "Pose 2", x: 9 });
  undo();
  expect(saved()[1]).toEqual({ name: "Pose 2", x: 0.6 });
});

test("L-46 L-47 what is saved to a text is there again when it is loaded; a text that is none is one sentence with its line", () => {
  keepPose(pose([0.5, -0.25, 0.4], [0, Math.SQRT1_2, 0, Math.SQRT1_2]));
  const text = posesText();
  const [before] = savedCoords(cellStore.getState().document!);
  forgetPoses();
  expect(saved()).toEqual([]);
  expect(readPoses(text)).toEqual({ kind: "read", count: 1 });
  const [after] = savedCoords(cellStore.getState().document!);
  expect(after!.name).toBe(before!.name);
  after!.worldFromFrame.position.forEach((v, i) => {
    expect(v).toBeCloseTo(before!.worldFromFrame.position[i]!, 7);
  });
  expect(readPoses("POSES 1 MM DEG ZYX WORLD\nPOSE A 1 2\n")).toMatchObject({
    kind: "not-understood",
    sentence: expect.stringMatching(/^Line 2, column 11: /) as string,
  });
  expect(saved()).toHaveLength(1);
});

test("L-48 L-49 the program goes through all poses; when they are gone its moves stay", () => {
  keepPose(pose([0.5, 0, 0.4]));
  keepPose(pose([0.6, 0, 0.4]));
  const count = (): number => {
    const { document } = cellStore.getState();
    return programOf(document)!.steps.length;
  };
  const before = count();
  movesThroughPoses();
  expect(count()).toBe(before + 2);
  forgetPoses();
  expect([saved(), count()]).toEqual([[], before + 2]);
});
