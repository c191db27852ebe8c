import type { Translation } from "../catalogue.ts";
import type { en } from "../en/index.ts";
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
export { sentences } from "./sentences.ts";
import { shellWords } from "./shell.ts";
import { teachWords } from "./teach.ts";
import { textWords } from "./text.ts";
import { togetherWords } from "./together.ts";
import { tools } from "./tools.ts";
import { videoWords } from "./video.ts";

/** German, as robot programmers say it; nobody is addressed, what to do stands in the infinitive. */
export const catalogue: Translation<typeof en> = {
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
