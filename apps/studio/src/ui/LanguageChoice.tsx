import type { Robot } from "@twincell/core";
import { useStore } from "zustand";
import { chooseLanguage, languageOf, languagesOf, languageStore } from "../stores/languages.ts";
import { Chooser } from "./Choice.tsx";
import { words } from "../messages/index.ts";

/** The languages that the robot's controller understands; the others are there, greyed, with the reason. */
export function LanguageChoice({ robot, disabled = false }: { readonly robot: Robot; readonly disabled?: boolean }) {
  const dialect = useStore(languageStore, state => languageOf(robot, state));
  return (
    <Chooser
      label={words.export.dialect}
      value={dialect?.id ?? ""}
      onChange={id => chooseLanguage(robot.id, id)}
      options={languagesOf(robot).map(({ dialect: each, why }) => ({
        value: each.id,
        words: `${each.name} · ${each.brand}${each.maturity === "experimental" ? ` · ${words.export.experimentalTag}` : ""}`,
        disabled: disabled || why !== null,
        ...(why === null ? {} : { hint: why }),
      }))}
    />
  );
}
