import { expect, test } from "vitest";
import { headsetStore, keptHeadset, putPanel, readKeptHeadset, resetPanels } from "./headset.ts";
import { keepPreferences } from "./preferences.ts";

test("M-16 where panels were put, wrist, posture and buttons are there again the next day; what is damaged is left out", () => {
  const first = headsetStore.getState();
  const kept = new Map<string, string>();
  const shelf = {
    getItem: (key: string) => kept.get(key) ?? null,
    setItem: (key: string, text: string) => void kept.set(key, text),
  };
  const stop = keepPreferences(shelf, false);
  putPanel("step-stand", { at: [0.4, 1.3, -0.9], turn_rad: -0.4, tilt_rad: 0 });
  headsetStore.setState({
    wrist: "right",
    posture: "seated",
    turning: "smooth",
    use: { take: "trigger", view: "left", gripper: "none" },
  });
  stop();
  const wanted = keptHeadset();
  headsetStore.setState(first, true);
  keepPreferences(shelf, false)();
  expect(keptHeadset()).toEqual(wanted);

  resetPanels();
  readKeptHeadset({
    wrist: "foot",
    posture: 3,
    use: { take: "teeth", view: "right" },
    places: {
      a: { at: [0, "x", 1], turn_rad: 0, tilt_rad: 0 },
      b: null,
      c: { at: [1, 2, 3], turn_rad: 0, tilt_rad: 0 },
    },
  });
  expect(headsetStore.getState()).toMatchObject({
    wrist: "right",
    posture: "seated",
    use: { take: "trigger", view: "right", gripper: "none" },
    places: { c: { at: [1, 2, 3] } },
  });
  expect(Object.keys(headsetStore.getState().places)).toEqual(["c"]);
  headsetStore.setState(first, true);
});
