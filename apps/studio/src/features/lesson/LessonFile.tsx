import { useEffect, useRef } from "react";
import { registerCommands } from "../../stores/commands.ts";
import { theProgram } from "../../stores/document.ts";
import { makeLesson, openLesson } from "../../stores/lesson.ts";
import { notify } from "../../stores/notices.ts";
import { words } from "../../messages/index.ts";

/** The commands that begin a lesson, and the file chooser of one that was saved. */
export function LessonFile() {
  const input = useRef<HTMLInputElement>(null);
  useEffect(
    () =>
      registerCommands([
        {
          id: "lesson.make",
          group: "program",
          words: words.lesson.make,
          can: () => (theProgram()?.steps.length ?? 0) > 0,
          run: () => {
            makeLesson();
          },
        },
        { id: "lesson.open", group: "file", words: words.lesson.openFile, run: () => input.current?.click() },
      ]),
    [],
  );
  const open = async (file: File): Promise<void> => {
    try {
      openLesson(await file.text(), file.name);
    } catch (problem) {
      notify("bad", words.file.unreadable(file.name), problem instanceof Error ? problem.message : undefined);
    }
  };
  return (
    <input
      ref={input}
      type="file"
      accept=".json"
      hidden
      aria-label={words.lesson.openFile}
      onChange={event => {
        const file = event.currentTarget.files?.[0];
        if (file) void open(file);
        event.currentTarget.value = "";
      }}
    />
  );
}
