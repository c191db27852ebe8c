import { writeUrdf } from "../index.ts";
import { madeUpArm, madeUpMasses, madeUpSide } from "./made-up-arm.ts";

process.stdout.write(writeUrdf(madeUpArm, { masses: madeUpMasses, side: madeUpSide }));
