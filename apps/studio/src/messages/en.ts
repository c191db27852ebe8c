import { direct } from "./en/direct.ts";
import { textWords } from "./en/text.ts";
import { videoWords } from "./en/video.ts";
import { headsetWords } from "./en/headset.ts";
import { offlineWords } from "./en/offline.ts";
import { phoneWords } from "./en/phone.ts";
import { shellWords } from "./en/shell.ts";
import { cellWords } from "./en/cell.ts";
import { teachWords } from "./en/teach.ts";
import { checkWords } from "./en/check.ts";
import { controlWords } from "./en/control.ts";
import { recordsWords } from "./en/records.ts";

/** English. Field terms as a programmer says them; sentences end with a full stop and carry the number and the unit. */
export const en = {
  ...shellWords,
  ...cellWords,
  ...teachWords,
  ...checkWords,
  ...controlWords,
  ...recordsWords,
  direct,
  text: textWords,
  video: videoWords,
  headset: headsetWords,
  offline: offlineWords,
  phone: phoneWords,
};
