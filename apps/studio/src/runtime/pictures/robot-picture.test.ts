import { LIBRARY, robotById } from "@twincell/core";
import { expect, test } from "vitest";
import { robotPicture, type Pixels } from "./robot-picture.ts";

/** Share of pixels that show something, and how far it reaches: columns and rows as shares of the picture. */
function shown({ width, height, data }: Pixels) {
  let count = 0;
  let [left, right, top, bottom] = [width, 0, height, 0];
  for (let i = 0; i < width * height; i++) {
    if (data[4 * i + 3]! < 128) continue;
    count++;
    left = Math.min(left, i % width);
    right = Math.max(right, i % width);
    top = Math.min(top, Math.floor(i / width));
    bottom = Math.max(bottom, Math.floor(i / width));
  }
  return { covered: count / (width * height), across: (right - left) / width, high: (bottom - top) / height };
}

test.each(LIBRARY.map(({ id }) => id))("%s fills its picture and is not one flat colour", id => {
  const picture = robotPicture(robotById(id)!, 64, 64);
  const { covered, across, high } = shown(picture);
  expect(covered).toBeGreaterThan(0.05);
  expect(covered).toBeLessThan(0.6);
  expect(Math.max(across, high)).toBeGreaterThan(0.8);
  expect(Math.max(across, high)).toBeLessThan(0.92);
  const brightness = new Set<number>();
  for (let i = 0; i < picture.data.length; i += 4) if (picture.data[i + 3] === 255) brightness.add(picture.data[i]!);
  expect(brightness.size).toBeGreaterThan(8);
});

test("what is painted is the robot's own colour: the KR 6 is orange, the GP8 blue", () => {
  const mostOf = (id: string): number => {
    const { data } = robotPicture(robotById(id)!, 64, 64);
    const sums = [0, 0, 0];
    for (let i = 0; i < data.length; i += 4)
      if (data[i + 3] === 255) for (let k = 0; k < 3; k++) sums[k]! += data[i + k]!;
    return sums.indexOf(Math.max(...sums));
  };
  expect(mostOf("kuka_kr6_2")).toBe(0);
  expect(mostOf("yaskawa_gp8")).toBe(2);
});
