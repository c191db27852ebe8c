import { ABB } from "./abb.ts";
import { AUBO } from "./aubo.ts";
import { DENSO } from "./denso.ts";
import { DOBOT } from "./dobot.ts";
import { DOOSAN } from "./doosan.ts";
import { FANUC } from "./fanuc.ts";
import { FRANKA_ROBOTICS } from "./franka-robotics.ts";
import { KAWASAKI } from "./kawasaki.ts";
import { KINOVA } from "./kinova.ts";
import { KUKA } from "./kuka.ts";
import { MITSUBISHI_ELECTRIC } from "./mitsubishi-electric.ts";
import { RETHINK_ROBOTICS } from "./rethink-robotics.ts";
import { STAUBLI } from "./staubli.ts";
import { TECHMAN } from "./techman.ts";
import { UFACTORY } from "./ufactory.ts";
import { UNIVERSAL_ROBOTS } from "./universal-robots.ts";
import { YASKAWA } from "./yaskawa.ts";
import type { CatalogueMaker } from "./entry.ts";

/** Robots by their makers' public descriptions, beside the library: data alone, drawn from their dimensions. */
export const CATALOGUE: readonly CatalogueMaker[] = [
  ABB,
  AUBO,
  DENSO,
  DOBOT,
  DOOSAN,
  FANUC,
  FRANKA_ROBOTICS,
  KAWASAKI,
  KINOVA,
  KUKA,
  MITSUBISHI_ELECTRIC,
  RETHINK_ROBOTICS,
  STAUBLI,
  TECHMAN,
  UFACTORY,
  UNIVERSAL_ROBOTS,
  YASKAWA,
];
