import { DIALECTS } from "@twincell/languages";
import { useEffect, useRef, useState } from "react";
import { registerCommands } from "../../stores/commands.ts";
import { IMPORT_ENDINGS } from "@twincell/formats";
import { words } from "../../messages/index.ts";
import { fileCommands } from "../../commands/file.ts";
import { droppedFiles } from "./dropped.ts";
import { openFiles } from "./openFile.ts";
import "./files.css";

const KINDS = [
  ".json",
  ".mcap",
  ".txt",
  ".csv",
  ".zip",
  ".mtl",
  ".bin",
  ".dh",
  ".tsv",
  ...IMPORT_ENDINGS.map(ending => `.${ending}`),
  ...new Set(DIALECTS.flatMap(({ extensions }) => extensions)),
].join();

/** Save, open and drop. */
export function Files() {
  const input = useRef<HTMLInputElement>(null);
  const [over, setOver] = useState(false);
  useEffect(() => registerCommands(fileCommands(() => input.current?.click())), []);
  useEffect(() => {
    const hasFiles = (event: DragEvent): boolean => event.dataTransfer?.types.includes("Files") ?? false;
    const drag = (event: DragEvent): void => {
      if (hasFiles(event)) {
        event.preventDefault();
        setOver(true);
      }
    };
    const leave = (event: DragEvent): void => {
      if (event.relatedTarget === null) setOver(false);
    };
    const drop = (event: DragEvent): void => {
      if (!hasFiles(event)) return;
      event.preventDefault();
      setOver(false);
      void droppedFiles(event.dataTransfer).then(openFiles);
    };
    window.addEventListener("dragover", drag);
    window.addEventListener("dragleave", leave);
    window.addEventListener("drop", drop);
    return () => {
      window.removeEventListener("dragover", drag);
      window.removeEventListener("dragleave", leave);
      window.removeEventListener("drop", drop);
    };
  }, []);
  return (
    <>
      <input
        ref={input}
        type="file"
        multiple
        accept={KINDS}
        hidden
        aria-label={words.commands.load}
        data-file-input
        onChange={event => {
          const files = [...(event.currentTarget.files ?? [])].map(file => ({ path: file.name, file }));
          if (files.length > 0) void openFiles(files);
          event.currentTarget.value = "";
        }}
      />
      {over && (
        <div className="drop-veil" aria-hidden>
          <p>{words.file.drop}</p>
        </div>
      )}
    </>
  );
}
