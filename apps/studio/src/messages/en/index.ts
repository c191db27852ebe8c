import { cellWords } from "./cell.ts";
import { checkWords } from "./check.ts";
import { controlWords } from "./control.ts";
import { device } from "./device.ts";
import { direct } from "./direct.ts";
import { editor } from "./editor.ts";
import { peopleWords } from "./people.ts";
import { fleetWords } from "./fleet.ts";
import { headset } from "./headset.ts";
import { glove } from "./glove.ts";
import { lesson } from "./lesson.ts";
import { marker } from "./marker.ts";
import { offline } from "./offline.ts";
import { own } from "./own.ts";
import { phone } from "./phone.ts";
import { recordsWords } from "./records.ts";
import { process } from "./process.ts";
import { mate, rig } from "./rig.ts";
import { registration } from "./registration.ts";
import { scene } from "./scene.ts";
import { shellWords } from "./shell.ts";
import { teachWords } from "./teach.ts";
import { textWords } from "./text.ts";
import { togetherWords } from "./together.ts";
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
  device,
  direct,
  editor,
  people: peopleWords,
  glove,
  fleet: fleetWords,
  headset,
  lesson,
  marker,
  offline,
  own,
  phone,
  mate,
  process,
  rig,
  registration,
  scene,
  text: textWords,
  together: togetherWords,
  tools,
  video: videoWords,
};
