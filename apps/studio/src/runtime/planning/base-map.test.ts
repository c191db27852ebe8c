import { checkProgram, linkSolids, robotById, type Verdict } from "@twincell/core";
import { cellGeometry, selectedProgram, tracedCartonCell, type CellDocument } from "@twincell/project";
import { afterEach, beforeEach, expect, test } from "vitest";
import { baseMapStore, showBaseMap } from "../../stores/base-map.ts";
import { cellStore } from "../../stores/cell.ts";
import { connectionStore } from "../../stores/connection.ts";
import { showDocument, undo } from "../../stores/document.ts";
import { playStore } from "../../stores/play.ts";
import type { FromPlanner, ToPlanner } from "../../workers/plan-messages.ts";
import { moveToSuggestedBase, startBaseMap } from "./base-map.ts";
import { planTask } from "./plan-task.ts";

const cell = tracedCartonCell();
const robot = robotById(cell.robot.id)!;
const FAR_M = 0.45;
/** The robot stands too far from what it traces; nothing else stands in the cell. */
const { position, quaternion } = cell.robot.worldFromBase;
const far: CellDocument = {
  ...cell,
  objects: cell.objects.filter(({ name }) => name === "Carton"),
  robot: { ...cell.robot, worldFromBase: { position: [position[0] - FAR_M, position[1], position[2]], quaternion } },
};
const now = (): CellDocument => cellStore.getState().document!;
const judge = (): Verdict => {
  const document = now();
  const { verdict, plan } = checkProgram(selectedProgram(document)!, robot, {
    cell: cellGeometry(document, linkSolids(robot)),
    margin_m: 0,
  });
  playStore.setState({ verdict, plan, stale: false });
  return verdict;
};
const asked: ToPlanner[] = [];
let hear: (message: FromPlanner) => void = () => undefined;
const heard: FromPlanner["kind"][] = [];
let closed = 0;
const answer = (): void => {
  const tell = (message: FromPlanner): void => {
    heard.push(message.kind);
    hear(message);
  };
  for (const message of asked.splice(0)) tell(planTask(message, () => 0, tell));
};

let stop: () => void;
beforeEach(() => {
  asked.length = heard.length = closed = 0;
  connectionStore.setState({ station: null });
  baseMapStore.setState({ on: false, field: null, best: undefined, share: null });
  showDocument(far);
  judge();
  stop = startBaseMap(() => ({
    post: message => void asked.push(message),
    listen: listen => {
      hear = listen;
    },
    close: () => void closed++,
  }));
});
afterEach(() => stop());

test("the base position map is made when it is switched on, coarse to fine, and suggests a place where the program is good", () => {
  expect(asked).toEqual([]);
  expect(judge().ok).toBe(false);
  showBaseMap(true);
  expect(asked).toHaveLength(1);
  answer();
  expect(heard.filter(kind => kind === "field-so-far")).toHaveLength(3);
  const { field, best, share } = baseMapStore.getState();
  expect(field).toMatchObject({ complete: true, square_m: 0.1 });
  expect(share).toBeNull();
  moveToSuggestedBase(best!);
  expect(judge().ok).toBe(true);
  expect(now().objects).toEqual(far.objects);
  undo();
  expect(now().robot).toEqual(far.robot);
});

test("it is made again after the next check, given up while the program changes, and forgotten when it is switched off", () => {
  showBaseMap(true);
  playStore.setState({ stale: true });
  expect(closed).toBe(1);
  answer();
  expect(baseMapStore.getState().field).toBeNull();
  judge();
  expect(asked).toHaveLength(1);
  answer();
  expect(baseMapStore.getState().field).not.toBeNull();
  showBaseMap(false);
  expect(baseMapStore.getState()).toMatchObject({ field: null, share: null });
});
