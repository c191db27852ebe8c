import { emptyProgram, type Dialect, type Robot, type TextForm } from "@twincell/core";
import { fanucLs } from "./fanuc-ls/index.ts";
import { inform } from "./inform/index.ts";
import { kawasakiAs } from "./kawasaki-as/index.ts";
import { krl } from "./krl/index.ts";
import { melfaBasic } from "./melfa-basic/index.ts";
import { poseList } from "./l-irl/index.ts";
import { pacScript } from "./pacscript/index.ts";
import { rapid } from "./rapid/index.ts";
import { spel } from "./spel/index.ts";
import { urScript } from "./urscript/index.ts";
import { val3 } from "./val3/index.ts";
import { vPlus } from "./v-plus/index.ts";

export {
  inform,
  informDialect,
  informExamplePulses,
  type InformOptions,
} from "./inform/index.ts";
export { fanucLs } from "./fanuc-ls/index.ts";
export { kawasakiAs } from "./kawasaki-as/index.ts";
export { melfaBasic } from "./melfa-basic/index.ts";
export { loadPoses, poseList, savePoses, type LoadedPoses, type SavedPose } from "./l-irl/index.ts";
export { pacScript } from "./pacscript/index.ts";
export { rapid } from "./rapid/index.ts";
export { spel } from "./spel/index.ts";
export { urScript } from "./urscript/index.ts";
export { krl } from "./krl/index.ts";
export { val3 } from "./val3/index.ts";
export { vPlus } from "./v-plus/index.ts";
export { NOT_GIVEN } from "./parser/index.ts";
export * from "./prove.ts";
export * from "./patch/index.ts";

/** Every dialect. A new one is a folder and one line here. */
export const DIALECTS: readonly Dialect[] = [
  vPlus,
  krl,
  inform,
  urScript,
  rapid,
  fanucLs,
  val3,
  kawasakiAs,
  spel,
  melfaBasic,
  pacScript,
  poseList,
];

/** The dialect of that id, or undefined. */
export const dialectById = (id: string): Dialect | undefined => DIALECTS.find(dialect => dialect.id === id);
/** The dialect written in one of its forms; undefined where it has none of that id. */
export function dialectInForm(dialect: Dialect, id: string): (Dialect & { readonly form: TextForm }) | undefined {
  const form = dialect.forms?.find(each => each.id === id);
  return (
    form && {
      ...dialect,
      form,
      resolution: form.resolution,
      runnable: files => files[0]!,
      emit: (program, robot) => form.emit(program, robot),
    }
  );
}
export { vendorTables } from "./vendors.ts";

/** The dialects that a robot's controller understands: those that do not refuse even an empty program for it. */
export const dialectsFor = (robot: Robot): readonly Dialect[] =>
  DIALECTS.filter(dialect => dialect.emit(emptyProgram(robot.id), robot).kind === "emitted");
