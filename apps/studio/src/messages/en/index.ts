import { cellWords } from "./cell.ts";
import { checkWords } from "./check.ts";
import { controlWords } from "./control.ts";
import { direct } from "./direct.ts";
import { editor } from "./editor.ts";
import { peopleWords } from "./people.ts";
import { fleetWords } from "./fleet.ts";
import { headset } from "./headset.ts";
import { glove } from "./glove.ts";
import { lesson } from "./lesson.ts";
import { offline } from "./offline.ts";
import { own } from "./own.ts";
import { phone } from "./phone.ts";
import { recordsWords } from "./records.ts";
import { process } from "./process.ts";
import { mate, rig } from "./rig.ts";
import { scene } from "./scene.ts";
import { shellWords } from "./shell.ts";
import { teachWords } from "./teach.ts";
import { textWords } from "./text.ts";
import { tools } from "./tools.ts";
import { videoWords } from "./video.ts";

/** English. Field terms as a programmer says them; sentences end with a full stop and carry the number and the unit. */
export const en = {
  ...shellWords,
  ...cellWords,
  ...teachWords,
  ...checkWords,
  ...controlWords,
  ...recordsWords,
  direct,
  editor,
  people: peopleWords,
  glove,
  fleet: fleetWords,
  headset,
  lesson,
  offline,
  own,
  phone,
  mate,
  process,
  rig,
  scene,
  text: textWords,
  tools,
  video: videoWords,
};
