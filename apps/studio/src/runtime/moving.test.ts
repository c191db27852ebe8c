import { beforeEach, expect, test } from "vitest";
import { playStore } from "../stores/play.ts";
import { select, selectionStore } from "../stores/selection.ts";
import { traceStore } from "../stores/trace.ts";
import { hold, releaseAll } from "./jog/pressed-inputs.ts";
import { escapeRule } from "./moving.ts";

beforeEach(() => {
  releaseAll();
  select(null);
  traceStore.setState({ active: false, chosen: [] });
  playStore.setState({ playing: false });
});

test("two presses of Esc leave the trace tool level by level and stop nothing while nothing moves", () => {
  const press = escapeRule();
  traceStore.setState({ active: true });
  select({ kind: "robot" });
  expect(press(0)).toBe("leave");
  traceStore.setState({ active: false });
  expect(press(100)).toBe("leave");
  selectionStore.setState({ selected: null });
  expect(press(200)).toBe("leave");
});

test("one press of Esc stops while the program plays or a jog key is held, whatever there is to leave", () => {
  const press = escapeRule();
  traceStore.setState({ active: true });
  playStore.setState({ playing: true });
  expect(press(0)).toBe("stop");
  playStore.setState({ playing: false });
  hold("keyboard", 0, 1);
  expect(press(5000)).toBe("stop");
});

test("Esc twice within 600 ms with nothing to leave stops, for a robot may move of which nothing is known here", () => {
  const press = escapeRule();
  expect([press(0), press(599)]).toEqual(["leave", "stop"]);
  expect([press(2000), press(2601)]).toEqual(["leave", "leave"]);
});
