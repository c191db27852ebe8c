import { addCatalogue, addOwnRobot } from "@twincell/core";
import { CATALOGUE } from "@twincell/core/catalogue";
import type { KnowRobot } from "../runtime/hire.ts";

// Imported first by every worker that is told the id of a robot: a worker shares nothing with the page.
addCatalogue(CATALOGUE);

const isKnowRobot = (data: unknown): data is KnowRobot =>
  typeof data === "object" && data !== null && "knowRobot" in data;

/** Robots from files are told by the page, in order with the work, and are nothing that the work hears of. */
addEventListener("message", (event: MessageEvent<unknown>) => {
  if (!isKnowRobot(event.data)) return;
  event.stopImmediatePropagation();
  addOwnRobot(event.data.knowRobot);
});
