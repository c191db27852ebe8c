import { robotById } from "@twincell/core";
import type { CellDocument } from "@twincell/project";
import { touchingNow } from "../../runtime/live.ts";
import type { Thing } from "../../stores/selection.ts";
import { WORDS } from "../words.ts";

/** What a person calls the thing under the pointer, and whether it touches something. */
export function thingWords(thing: Thing, document: CellDocument): string {
  const name = nameOf(thing, document);
  const solid = thing.kind === "link" ? `link ${thing.link}` : thing.kind === "tool" ? document.tool : name;
  const touching = touchingNow().has(solid) || (thing.kind === "tool" && touchingNow().has("tool"));
  return touching ? `${name} · ${WORDS.touching}` : name;
}

/** What a person calls a solid that the collision check names: "link 3", "tool", or the id of an object. */
export function solidName(solid: string, document: CellDocument): string {
  const link = /^link (\d+)$/.exec(solid)?.[1];
  if (link !== undefined) return WORDS.links[Number(link)] ?? solid;
  return solid === "tool" ? document.tool : (document.objects.find(object => object.id === solid)?.name ?? solid);
}

function nameOf(thing: Thing, document: CellDocument): string {
  switch (thing.kind) {
    case "robot":
      return robotById(document.robot.id)?.name ?? document.robot.id;
    case "link":
      return linkWords(thing.link, robotById(document.robot.id)?.name ?? document.robot.id);
    case "tool":
      return WORDS.tool(document.tool);
    case "object":
      return document.objects.find(object => object.id === thing.id)?.name ?? thing.id;
    case "frame":
    case "routine":
      return thing.name;
    case "step":
      return thing.id;
  }
}

function linkWords(link: number, robot: string): string {
  const name = WORDS.links[link];
  return name === undefined ? WORDS.link(link, robot) : WORDS.linkNamed(link, name, robot);
}
