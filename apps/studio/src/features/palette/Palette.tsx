import { Command } from "cmdk";
import { useStore } from "zustand";
import { commandStore, runCommand, type CommandGroup } from "../../stores/commands.ts";
import { closeDialog, dialogStore } from "../../stores/dialogs.ts";
import { Frame } from "../../ui/Frame.tsx";
import { showKeys } from "../../ui/keys.ts";
import { words } from "../../messages/index.ts";
import { commandScore } from "./rank.ts";
import "./palette.css";

const GROUPS: readonly CommandGroup[] = ["program", "jog", "play", "view", "edit", "file", "help"];

/** ⌘K: everything a person can do, by typing. */
export function Palette() {
  const open = useStore(dialogStore, state => state.open);
  const commands = useStore(commandStore, state => state.commands);
  return (
    <>
      <Frame open={open === "palette"} title={words.palette.title} onClose={closeDialog} width={560}>
        <Command
          label={words.palette.title}
          loop
          className="palette"
          filter={(_id, query, [title, ...aliases] = []) => commandScore(query, title ?? "", aliases)}
        >
          <Command.Input
            className="palette-input"
            placeholder={words.palette.search}
            autoFocus
            aria-label={words.palette.search}
          />
          <Command.List className="palette-list" label={words.palette.title}>
            <Command.Empty className="empty">{words.palette.none}</Command.Empty>
            {GROUPS.map(group => (
              <Command.Group key={group} heading={words.palette.groups[group]}>
                {[...commands.values()]
                  .filter(command => command.group === group)
                  .map(command => (
                    <Command.Item
                      key={command.id}
                      className="menu-item"
                      value={command.id}
                      keywords={[command.words, ...(command.aliases ?? [])]}
                      disabled={command.can?.() === false}
                      onSelect={() => {
                        closeDialog();
                        runCommand(command.id);
                      }}
                    >
                      {command.words}
                      {command.keys?.[0] && <span className="kbd">{showKeys(command.keys[0])}</span>}
                    </Command.Item>
                  ))}
              </Command.Group>
            ))}
          </Command.List>
        </Command>
      </Frame>
      <Frame open={open === "shortcuts"} title={words.shortcuts.title} onClose={closeDialog} width={720} reading>
        <div className="shortcuts">
          {GROUPS.map(group => {
            const listed = [...commands.values()].filter(command => command.group === group && command.keys);
            return (
              listed.length > 0 && (
                <section key={group}>
                  <h3 className="heading">{words.palette.groups[group]}</h3>
                  <dl className="facts">
                    {listed.map(command => (
                      <div key={command.id}>
                        <dt>{command.words}</dt>
                        <dd>
                          {command.keys?.map(keys => (
                            <span key={keys} className="kbd">
                              {showKeys(keys)}
                            </span>
                          ))}
                        </dd>
                      </div>
                    ))}
                  </dl>
                </section>
              )
            );
          })}
        </div>
      </Frame>
    </>
  );
}
