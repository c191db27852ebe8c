import { expect, test } from "vitest";
import {
  bindButton,
  bindForTarget,
  bindingStore,
  bindStick,
  DEFAULT_BINDINGS,
  resetBindings,
  TARGET_BINDINGS,
} from "../../stores/bindings.ts";
import { padStep, type PadReading } from "./gamepad.ts";

const pad = (down: Readonly<Record<number, number>> = {}, axes: readonly number[] = [0, 0]): PadReading => ({
  buttons: Array.from({ length: 17 }, (_, i) => down[i] ?? 0),
  axes,
});
const step = (now: PadReading, before: PadReading | null = pad(), back = new Set<number>()) =>
  padStep(now, before, DEFAULT_BINDINGS, back);

test.each([
  [0, 4, "N-25 +rot Y"],
  [1, 3, "N-26 +rot X"],
  [2, 5, "N-27 +rot Z"],
])("button %i turns +axis %i (%s)", (button, axis) => {
  const { axes } = step(pad({ [button]: 1 }));
  expect([...axes].map(value => value !== 0)).toEqual([0, 1, 2, 3, 4, 5].map(i => i === axis));
  expect(axes[axis]).toBe(1);
});
test.each([
  [0, 4, "N-28 −rot Y"],
  [1, 3, "N-29 −rot X"],
  [2, 5, "N-30 −rot Z"],
])("button 4 first, then %i turns −axis %i (%s)", (button, axis) => {
  const back = new Set<number>();
  step(pad({ 4: 1 }), pad(), back);
  expect(step(pad({ 4: 1, [button]: 1 }), pad({ 4: 1 }), back).axes[axis]).toBe(-1);
  expect(step(pad({ [button]: 1 }), pad({ 4: 1, [button]: 1 }), back).axes[axis]).toBe(-1);
  step(pad(), pad({ [button]: 1 }), back);
  expect(step(pad({ [button]: 1 }), pad(), back).axes[axis]).toBe(1);
});
test("N-28 button 4 second does not turn the motion round", () => {
  const back = new Set<number>();
  step(pad({ 0: 1 }), pad(), back);
  expect(step(pad({ 0: 1, 4: 1 }), pad({ 0: 1 }), back).axes[4]).toBe(1);
});
test.each([
  [3, "aid-next", "N-31"],
  [8, "aid-previous", "N-35"],
  [5, "record", "N-32"],
  [9, "ready", "N-34"],
  [11, "camera", "N-36"],
])("button %i presses %s once (%s)", (button, action) => {
  expect(step(pad({ [button]: 1 })).pressed).toEqual([action]);
  expect(step(pad({ [button]: 1 }), pad({ [button]: 1 })).pressed).toEqual([]);
});
test("N-37 sticks move X and Y, the cross moves Z, and a stick at rest moves nothing", () => {
  expect(step(pad({}, [1, 0])).axes[0]).toBe(1);
  expect(step(pad({}, [0, -1])).axes[1]).toBe(1);
  expect(step(pad({ 12: 1 })).axes[2]).toBe(1);
  expect(step(pad({ 13: 1 })).axes[2]).toBe(-1);
  expect([...step(pad({}, [0.1, -0.14])).axes]).toEqual([0, 0, 0, 0, 0, 0]);
});
test("N-44 the trigger tilts in proportion; a reading that is not a number does nothing", () => {
  expect(step(pad({ 7: 0.5 })).tilt).toBe(0.5);
  expect(step(pad()).tilt).toBeNull();
  expect(step(pad({ 7: Number.NaN }, [Number.NaN, 0])).tilt).toBeNull();
});

test("N-24 buttons count as 0 or 1 however far they are pressed; the trigger and the sticks count from 0 to 1", () => {
  for (const value of [0, 0.2, 0.49]) expect(step(pad({ 0: value })).axes[4]).toBe(0);
  for (const value of [0.5, 0.8, 1]) expect(step(pad({ 0: value })).axes[4]).toBe(1);
  const tilts = [0.1, 0.4, 0.9, 1].map(value => step(pad({ 7: value })).tilt);
  expect(tilts).toEqual([0.1, 0.4, 0.9, 1]);
  const sticks = [0, 0.2, 0.5, 0.8, 1].map(value => step(pad({}, [value, 0])).axes[0]!);
  expect(sticks[0]).toBe(0);
  expect(sticks.at(-1)).toBe(1);
  for (let i = 1; i < sticks.length; i++) expect(sticks[i]!).toBeGreaterThan(sticks[i - 1]!);
  expect(sticks.every(value => value >= 0 && value <= 1)).toBe(true);
});

test("X-31 the right stick turns the view and moves nothing; X-30 the left stick and the cross move in three directions", () => {
  const turned = step(pad({}, [0, 0, 1, -0.575]));
  expect([...turned.axes]).toEqual([0, 0, 0, 0, 0, 0]);
  expect(turned.view[0]).toBe(1);
  expect(turned.view[1]).toBeCloseTo(-0.5, 9);
  expect([...step(pad({ 12: 1 }, [1, -1, 0, 0])).axes]).toEqual([1, 1, 1, 0, 0, 0]);
});
test("X-32 X-33 in the table with a gripper A closes it while held; target, view and gripper are bound each by itself", () => {
  const at = (reading: PadReading) => padStep(reading, pad(), TARGET_BINDINGS, new Set());
  expect(at(pad({ 0: 1 })).grip).toBe(true);
  expect(at(pad()).grip).toBe(false);
  expect([...at(pad({ 0: 1 })).axes]).toEqual([0, 0, 0, 0, 0, 0]);
  expect(step(pad({ 0: 1 })).grip).toBeNull();
  bindForTarget();
  bindButton(1, "grip");
  bindStick(2, "rz");
  const { buttons, axes } = bindingStore.getState();
  expect(buttons[1]).toBe("grip");
  expect(buttons[0]).toBeUndefined();
  expect([axes[0], axes[2], axes[3]]).toEqual(["x", "rz", "camera-y"]);
  resetBindings();
});
