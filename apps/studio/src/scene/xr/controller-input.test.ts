import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { describe, expect, test } from "vitest";
import type { ControllerUse } from "../../stores/headset.ts";
import { gripperHeld, readStick, takesWith, triggerHeld, turnsView, type PadState } from "./controller-input.ts";

const USE: ControllerUse = { take: "grip", view: "both", gripper: "a" };
const folder = join(
  dirname(createRequire(import.meta.url).resolve("@webxr-input-profiles/assets/package.json")),
  "dist/profiles",
);
interface Profile {
  readonly layouts: Readonly<
    Record<string, { readonly components: Readonly<Record<string, { readonly gamepadIndices: Indices }>> }>
  >;
}
type Indices = Readonly<Partial<Record<"button" | "xAxis" | "yAxis", number>>>;

/** The pad of a controller as its profile in the W3C registry says, at rest. */
function padOf(profile: string, hand: "left" | "right") {
  const { layouts }: Profile = JSON.parse(readFileSync(join(folder, profile, "profile.json"), "utf8"));
  const { components } = layouts[hand] ?? layouts["none"]!;
  const all = Object.values(components).map(({ gamepadIndices }) => gamepadIndices);
  const most = (of: (indices: Indices) => number | undefined): number => Math.max(-1, ...all.map(i => of(i) ?? -1)) + 1;
  const pad = {
    axes: Array.from({ length: most(({ yAxis }) => yAxis) }, () => 0),
    buttons: Array.from({ length: most(({ button }) => button) }, () => ({ pressed: false as boolean })),
  } satisfies PadState;
  const press = (component: string): void => {
    pad.buttons[components[component]!.gamepadIndices.button!]!.pressed = true;
  };
  const push = (component: string, x: number, y: number): void => {
    const { xAxis, yAxis } = components[component]!.gamepadIndices;
    pad.axes[xAxis!] = x;
    pad.axes[yAxis!] = y;
  };
  return { pad, press, push };
}
const stick = (pad: PadState): readonly number[] => {
  const out: [number, number] = [9, 9];
  readStick(pad, out);
  return out;
};

describe.each(["oculus-touch-v3", "meta-quest-touch-plus", "pico-4", "valve-index", "htc-vive"])(
  "T-48 the controller of the W3C profile %s",
  profile => {
    test.each(["left", "right"] as const)("%s: grip takes, trigger points, at rest nothing is held", hand => {
      const { pad, press } = padOf(profile, hand);
      expect([takesWith(pad, USE), triggerHeld(pad), stick(pad)]).toEqual([false, false, [0, 0]]);
      press("xr-standard-squeeze");
      expect([takesWith(pad, USE), triggerHeld(pad)]).toEqual([true, false]);
      press("xr-standard-trigger");
      expect(triggerHeld(pad)).toBe(true);
    });
    test("its stick, or its touchpad while that is pressed, says where to go", () => {
      const { pad, press, push } = padOf(profile, "right");
      if (profile === "htc-vive") {
        push("xr-standard-touchpad", 0.2, -0.9);
        expect(stick(pad), "a thumb that only rests there").toEqual([0, 0]);
        press("xr-standard-touchpad");
      } else push("xr-standard-thumbstick", 0.2, -0.9);
      expect(stick(pad)).toEqual([0.2, -0.9]);
    });
    test("X-32 button A held closes the gripper, let go opens it, where there is one", () => {
      const { pad, press } = padOf(profile, "right");
      if (profile === "htc-vive") {
        expect(gripperHeld(pad, USE)).toBeNull();
        return;
      }
      expect(gripperHeld(pad, USE)).toBe(false);
      press("a-button");
      expect(gripperHeld(pad, USE)).toBe(true);
      expect(gripperHeld(pad, { ...USE, gripper: "none" })).toBeNull();
    });
  },
);

test("T-48 a controller with a trigger alone takes with it", () => {
  const { pad, press } = padOf("generic-trigger", "right");
  expect(takesWith(pad, USE)).toBe(false);
  press("xr-standard-trigger");
  expect(takesWith(pad, USE)).toBe(true);
});

test("X-33 in the headset, taking, turning and the gripper are chosen each by itself", () => {
  const { pad, press } = padOf("meta-quest-touch-plus", "right");
  press("xr-standard-trigger");
  press("b-button");
  const other: ControllerUse = { take: "trigger", view: "left", gripper: "b" };
  expect([takesWith(pad, USE), takesWith(pad, { ...USE, take: other.take })]).toEqual([false, true]);
  expect([turnsView("right", USE), turnsView("right", { ...USE, view: other.view })]).toEqual([true, false]);
  expect([gripperHeld(pad, USE), gripperHeld(pad, { ...USE, gripper: other.gripper })]).toEqual([false, true]);
});
