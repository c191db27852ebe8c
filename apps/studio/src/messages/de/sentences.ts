import type { Sentences } from "../sentences.ts";
import { saidByChecks } from "./said/checks.ts";
import { saidByDrivers } from "./said/drivers.ts";
import { saidByExport } from "./said/export.ts";
import { saidByReaders } from "./said/files.ts";
import { saidInRefusals } from "./said/refusals.ts";
import { saidByRobots } from "./said/robots.ts";
import { saidTogether } from "./said/together.ts";
import { saidByTexts } from "./said/texts.ts";
import { saidByVision } from "./said/vision.ts";

/** German: what packages say. */
export const sentences: Sentences = {
  ...saidByChecks,
  ...saidByRobots,
  ...saidByReaders,
  ...saidByTexts,
  ...saidByExport,
  ...saidInRefusals,
  ...saidByDrivers,
  ...saidByVision,
  ...saidTogether,
};
