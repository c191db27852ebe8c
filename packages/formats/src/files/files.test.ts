import { describe, expect, test } from "vitest";
import { filesInMemory, findPackage, normalPath, resolveFile } from "../index.ts";

const files = filesInMemory(
  new Map(
    [
      "ws/arm_description/package.xml",
      "ws/arm_description/urdf/arm.urdf",
      "ws/arm_description/meshes/Visual/Base.STL",
      "ws/arm_description/meshes/link 1.stl",
      "ws/clone-of-gripper/package.xml",
      "ws/clone-of-gripper/meshes/finger.stl",
      "moved/robot.urdf",
      "moved/meshes/arm/link_1.stl",
      "moved/flat.stl",
    ].map(path => [
      path,
      new TextEncoder().encode(
        path.includes("clone") && path.endsWith(".xml") ? "<package><name>gripper_description</name></package>" : "x",
      ),
    ]),
  ),
);
const from = "ws/arm_description/urdf/arm.urdf";

describe("L-08 a reference is found however it is written", () => {
  test.each<[reference: string, from: string, path: string, note: string | undefined]>([
    ["package://arm_description/meshes/Visual/Base.STL", from, "ws/arm_description/meshes/Visual/Base.STL", undefined],
    [
      "package://arm_description/meshes/visual/base.stl",
      from,
      "ws/arm_description/meshes/Visual/Base.STL",
      "package://arm_description/meshes/visual/base.stl is spelt ws/arm_description/meshes/Visual/Base.STL.",
    ],
    ["model://arm_description/meshes/Visual/Base.STL", from, "ws/arm_description/meshes/Visual/Base.STL", undefined],
    ["package://gripper_description/meshes/finger.stl", from, "ws/clone-of-gripper/meshes/finger.stl", undefined],
    ["../meshes/Visual/Base.STL", from, "ws/arm_description/meshes/Visual/Base.STL", undefined],
    ["..\\meshes\\Visual\\Base.STL", from, "ws/arm_description/meshes/Visual/Base.STL", undefined],
    ["file://ws/arm_description/meshes/link%201.stl", from, "ws/arm_description/meshes/link 1.stl", undefined],
    [
      "meshes/Visual/Base.STL",
      from,
      "ws/arm_description/meshes/Visual/Base.STL",
      "meshes/Visual/Base.STL was found as ws/arm_description/meshes/Visual/Base.STL.",
    ],
    [
      "package://somewhere/meshes/arm/link_1.stl",
      "moved/robot.urdf",
      "moved/meshes/arm/link_1.stl",
      "package://somewhere/meshes/arm/link_1.stl was found as moved/meshes/arm/link_1.stl.",
    ],
    [
      "file:///home/someone/ws/src/somewhere/meshes/arm/link_1.stl",
      "moved/robot.urdf",
      "moved/meshes/arm/link_1.stl",
      "file:///home/someone/ws/src/somewhere/meshes/arm/link_1.stl was found as moved/meshes/arm/link_1.stl.",
    ],
    [
      "C:\\Users\\someone\\cad\\flat.stl",
      "moved/robot.urdf",
      "moved/flat.stl",
      "C:\\Users\\someone\\cad\\flat.stl was found as moved/flat.stl.",
    ],
  ])("%s", (reference, at, path, note) => {
    expect(resolveFile(reference, at, files)).toEqual({ kind: "found", path, ...(note === undefined ? {} : { note }) });
  });

  test.each<[string, string]>([
    [
      "package://nobody/meshes/x.stl",
      "package://nobody/meshes/x.stl is missing: the package nobody is not beside the file.",
    ],
    [
      "package://arm_description/meshes/x.stl",
      "package://arm_description/meshes/x.stl is missing in ws/arm_description.",
    ],
    ["../../../../../etc/passwd", "../../../../../etc/passwd is missing."],
    [
      "https://somewhere/x.stl",
      "https://somewhere/x.stl is not a file here: only package://, file:// and plain paths are opened.",
    ],
    ["", " is missing."],
    ["package://", "package:// is missing: the package  is not beside the file."],
    ["..", ".. is missing."],
  ])("missing: %s", (reference, sentence) => {
    expect(resolveFile(reference, from, files)).toEqual({ kind: "missing", sentence });
  });
});

test("packages are found by folder or by package.xml, paths are brought to one form", () => {
  expect(findPackage("arm_description", from, files)).toBe("ws/arm_description");
  expect(findPackage("gripper_description", from, files)).toBe("ws/clone-of-gripper");
  expect(findPackage("..", from, files)).toBeUndefined();
  expect([normalPath("a/./b//c/../d"), normalPath("C:\\x\\y"), normalPath("/a/../b"), normalPath("a/../../b")]).toEqual(
    ["a/b/d", "C:/x/y", "/b", undefined],
  );
});
