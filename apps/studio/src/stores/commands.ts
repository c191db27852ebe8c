import { createStore } from "zustand/vanilla";

export type CommandGroup = "file" | "edit" | "program" | "jog" | "view" | "play" | "help";
/** Everything a person can do, once: the palette, the menus and the keyboard read the same list. */
export interface Command {
  readonly id: string;
  readonly words: string;
  /** Other names a person may type for it. */
  readonly aliases?: readonly string[];
  readonly group: CommandGroup;
  /** "Mod+Z", "T", "Shift+Slash", … "Mod" is Ctrl, or ⌘ on a Mac. Letters are what is printed on the key. */
  readonly keys?: readonly string[];
  readonly run: () => void;
  /** Absent: always. */
  readonly can?: () => boolean;
}
export interface CommandState {
  readonly commands: ReadonlyMap<string, Command>;
}
export const commandStore = createStore<CommandState>(() => ({ commands: new Map() }));

/** Adds commands, replacing those of the same id. Returns what takes them away again. */
export function registerCommands(commands: readonly Command[]): () => void {
  commandStore.setState(state => {
    const next = new Map(state.commands);
    for (const command of commands) next.set(command.id, command);
    return { commands: next };
  });
  return () =>
    commandStore.setState(state => {
      const next = new Map(state.commands);
      for (const command of commands) if (next.get(command.id) === command) next.delete(command.id);
      return { commands: next };
    });
}

/** Runs the command if there is one and it can run now; says whether it did. */
export function runCommand(id: string): boolean {
  const command = commandStore.getState().commands.get(id);
  if (!command || command.can?.() === false) return false;
  command.run();
  return true;
}
