import { worse, playStore } from "../stores/play.ts";
import type { CellFacts } from "../stores/library.ts";
import { drawThumbnail } from "./thumbnail.ts";

/** What the library of cells shows of the open cell: its picture as it is on screen and what the check found. */
export function presentFacts(): CellFacts {
  const thumbnail = drawThumbnail();
  const { verdict } = playStore.getState();
  const steps = verdict?.steps ?? [];
  return {
    ...(thumbnail === null ? {} : { thumbnail }),
    verdict:
      verdict === null
        ? "unknown"
        : steps.reduce<"ok" | "warn" | "bad" | "unknown">((all, step) => worse(all, step.verdict), "ok"),
    findings: steps.filter(step => step.verdict === "bad").length,
  };
}
