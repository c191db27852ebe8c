import { ChevronRight, Plus } from "lucide-react";
import { DropdownMenu } from "radix-ui";
import { useStore } from "zustand";
import { commandStore, runCommand } from "../../stores/commands.ts";
import { bringProgram, otherPrograms } from "../../stores/structure.ts";
import { showKeys } from "../../ui/keys.ts";
import { words } from "../../messages/index.ts";

/** Where the other programs of the cell stand in the menu. */
const BRING = "\0bring";
const IDS = [
  "program.record-ptp",
  "program.record-lin",
  "program.record-circ",
  "trace.toggle",
  "",
  "program.gripper-close",
  "program.gripper-open",
  "program.wait",
  "program.wait-for",
  "program.set",
  "program.message",
  "program.payload",
  "program.comment",
  "",
  "program.repeat",
  "program.while",
  "program.if",
  "program.pallet",
  "program.assign",
  "program.routine",
  "program.call",
  "program.stop",
  "",
  BRING,
  "export.import",
  "",
  "program.clear",
];

/** What can be added to the program. */
export function AddStep() {
  const commands = useStore(commandStore, state => state.commands);
  return (
    <DropdownMenu.Root modal={false}>
      <DropdownMenu.Trigger asChild>
        <button className="btn quiet icon tight" aria-label={words.tree.addStep}>
          <Plus />
        </button>
      </DropdownMenu.Trigger>
      <DropdownMenu.Portal>
        <DropdownMenu.Content className="menu" align="end" collisionPadding={8}>
          {IDS.map((id, i) => {
            if (id === "") return <DropdownMenu.Separator key={i} className="menu-line" />;
            if (id === BRING) return <BringIn key={id} />;
            const command = commands.get(id);
            return (
              command && (
                <DropdownMenu.Item
                  key={id}
                  className={id === "program.clear" ? "menu-item danger" : "menu-item"}
                  disabled={command.can?.() === false}
                  onSelect={() => runCommand(id)}
                >
                  {command.words}
                  {command.keys?.[0] && <span className="kbd">{showKeys(command.keys[0])}</span>}
                </DropdownMenu.Item>
              )
            );
          })}
        </DropdownMenu.Content>
      </DropdownMenu.Portal>
    </DropdownMenu.Root>
  );
}

/** Row N-70: another program of the cell, appended here or called as a routine. */
function BringIn() {
  const others = otherPrograms();
  return (
    <DropdownMenu.Sub>
      <DropdownMenu.SubTrigger className="menu-item" disabled={others.length === 0}>
        {words.editor.bring}
        <ChevronRight size={14} className="menu-more" aria-hidden />
      </DropdownMenu.SubTrigger>
      <DropdownMenu.Portal>
        <DropdownMenu.SubContent className="menu" sideOffset={4}>
          {others.map(({ name }) => (
            <DropdownMenu.Item
              key={`append ${name}`}
              className="menu-item"
              onSelect={() => bringProgram(name, "append")}
            >
              {words.editor.append(name)}
            </DropdownMenu.Item>
          ))}
          <DropdownMenu.Separator className="menu-line" />
          {others.map(({ name }) => (
            <DropdownMenu.Item key={`call ${name}`} className="menu-item" onSelect={() => bringProgram(name, "call")}>
              {words.editor.callProgram(name)}
            </DropdownMenu.Item>
          ))}
        </DropdownMenu.SubContent>
      </DropdownMenu.Portal>
    </DropdownMenu.Sub>
  );
}
