import { isTextProgram } from "@twincell/project";
import { Check, ChevronDown, Search } from "lucide-react";
import { DropdownMenu } from "radix-ui";
import { useState } from "react";
import { useStore } from "zustand";
import { cellStore } from "../../stores/cell.ts";
import { chooseProgram, copyProgram, deleteProgram, nameProgram, newProgram } from "../../stores/programs.ts";
import { runCommand } from "../../stores/commands.ts";
import { words } from "../../messages/index.ts";
import { AddStep } from "./AddStep.tsx";

/** Which of the cell's programs is worked on; a new one, a copy, another name, away with it. */
export function ProgramSwitch({ onSearch }: { readonly onSearch?: () => void }) {
  const programs = useStore(cellStore, state => state.document?.programs);
  const name = useStore(cellStore, state => state.document?.program ?? "");
  const [renaming, setRenaming] = useState(false);
  if (renaming)
    return (
      <h2 className="heading">
        <Rename name={name} onDone={() => setRenaming(false)} />
        <AddStep />
      </h2>
    );
  const acts = [
    [words.programs.new, newProgram],
    [words.programs.duplicate, copyProgram],
    [words.programs.rename, () => setRenaming(true)],
    [words.lesson.make, () => runCommand("lesson.make")],
  ] as const;
  return (
    <h2 className="heading">
      <DropdownMenu.Root modal={false}>
        <DropdownMenu.Trigger asChild>
          <button className="program-switch" title={words.programs.switch}>
            <span>
              {words.tree.program} · {name}
            </span>
            <ChevronDown aria-hidden />
          </button>
        </DropdownMenu.Trigger>
        <DropdownMenu.Portal>
          <DropdownMenu.Content
            className="menu program-menu"
            align="start"
            onCloseAutoFocus={event => {
              if (renaming) event.preventDefault();
            }}
          >
            <DropdownMenu.RadioGroup value={name} onValueChange={chooseProgram}>
              {programs?.map(program => (
                <DropdownMenu.RadioItem key={program.name} className="menu-item" value={program.name}>
                  <span className="grow">{program.name}</span>
                  <span className="dim small">
                    {isTextProgram(program) ? program.language : words.tree.steps(program.steps.length)}
                  </span>
                  <DropdownMenu.ItemIndicator>
                    <Check size={14} />
                  </DropdownMenu.ItemIndicator>
                </DropdownMenu.RadioItem>
              ))}
            </DropdownMenu.RadioGroup>
            <DropdownMenu.Separator className="menu-line" />
            {acts.map(([says, act]) => (
              <DropdownMenu.Item
                key={says}
                className="menu-item"
                onSelect={() => {
                  act();
                }}
              >
                {says}
              </DropdownMenu.Item>
            ))}
            <DropdownMenu.Item
              className="menu-item danger"
              onSelect={() => {
                deleteProgram();
              }}
            >
              {words.programs.remove}
            </DropdownMenu.Item>
          </DropdownMenu.Content>
        </DropdownMenu.Portal>
      </DropdownMenu.Root>
      <span className="grow" />
      {onSearch && (
        <button className="btn quiet icon tight" aria-label={words.editor.search} onClick={onSearch}>
          <Search />
        </button>
      )}
      <AddStep />
    </h2>
  );
}

function Rename({ name, onDone }: { readonly name: string; readonly onDone: () => void }) {
  const [typed, setTyped] = useState(name);
  return (
    <span className="field text grow">
      <input
        autoFocus
        aria-label={words.programs.name}
        value={typed}
        maxLength={60}
        spellCheck={false}
        onFocus={event => event.currentTarget.select()}
        onChange={event => setTyped(event.currentTarget.value)}
        onBlur={() => {
          nameProgram(typed);
          onDone();
        }}
        onKeyDown={event => {
          event.stopPropagation();
          if (event.key === "Enter") {
            nameProgram(typed);
            onDone();
          } else if (event.key === "Escape") onDone();
        }}
      />
    </span>
  );
}
