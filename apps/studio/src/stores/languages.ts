import { emptyProgram, type Dialect, type Robot } from "@twincell/core";
import { DIALECTS } from "@twincell/languages";
import { createStore } from "zustand/vanilla";
import { cellStore } from "./cell.ts";
import { robotOf } from "./document.ts";

/** Which language a person chose for each robot, by robot id. */
export interface LanguageState {
  readonly chosen: Readonly<Record<string, string>>;
}
export const languageStore = createStore<LanguageState>(() => ({ chosen: {} }));
export const chooseLanguage = (robot: string, dialect: string): void =>
  languageStore.setState(({ chosen }) => ({ chosen: { ...chosen, [robot]: dialect } }));

/** A language, and why a robot's controller does not understand it; null when it does. */
export interface SupportedRobot {
  readonly dialect: Dialect;
  readonly why: string | null;
}
const known = new Map<Robot, readonly SupportedRobot[]>();

/** Every language: those of the robot's controller first, then the others with the reason. */
export function languagesOf(robot: Robot): readonly SupportedRobot[] {
  let all = known.get(robot);
  if (!all) {
    const asked = DIALECTS.map((dialect): SupportedRobot => {
      const empty = dialect.emit(emptyProgram(robot.id), robot);
      return { dialect, why: empty.kind === "cannot" ? empty.sentence : null };
    });
    known.set(robot, (all = [...asked.filter(each => each.why === null), ...asked.filter(each => each.why !== null)]));
  }
  return all;
}

/**
 * The language a program of this robot is written in: the chosen one, else the first its controller understands; null
 * when there is none.
 */
export function languageOf(robot: Robot | null, { chosen }: LanguageState = languageStore.getState()): Dialect | null {
  const own = robot === null ? [] : languagesOf(robot).filter(each => each.why === null);
  return (own.find(each => each.dialect.id === chosen[robot?.id ?? ""]) ?? own[0])?.dialect ?? null;
}
export const theLanguage = (): Dialect | null => languageOf(robotOf(cellStore.getState().document));
