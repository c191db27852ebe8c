import { Plus } from "lucide-react";
import { DropdownMenu } from "radix-ui";
import { useStore } from "zustand";
import { commandStore, runCommand } from "../../stores/commands.ts";
import { showKeys } from "../../ui/keys.ts";
import { words } from "../../messages/index.ts";

const IDS = [
  "program.record-ptp",
  "program.record-lin",
  "program.wait",
  "program.wait-for",
  "program.set",
  "program.gripper-close",
  "program.gripper-open",
  "program.repeat",
  "program.while",
  "program.if",
  "program.assign",
  "program.call",
  "program.comment",
  "",
  "trace.toggle",
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
        <DropdownMenu.Content className="menu" align="end">
          {IDS.map((id, i) => {
            if (id === "") return <DropdownMenu.Separator key={i} className="menu-line" />;
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
