import { Check, Headset, Lock, Moon, Redo2, Sun, Undo2, Volume2, VolumeX } from "lucide-react";
import { DropdownMenu } from "radix-ui";
import { useStore } from "zustand";
import { cellStore } from "../../stores/cell.ts";
import { commandStore, runCommand } from "../../stores/commands.ts";
import { headsetStore } from "../../stores/headset.ts";
import { sessionStore } from "../../stores/session.ts";
import { showMode, viewStore, type StudioMode } from "../../stores/view.ts";
import { Segments } from "../../ui/Choice.tsx";
import { showKeys } from "../../ui/keys.ts";
import { Tip } from "../../ui/Tip.tsx";
import { language, words } from "../../messages/index.ts";
import { languages, nameOf } from "../../messages/languages.ts";
import { CellName } from "./CellName.tsx";
import { ControllerChip } from "./ControllerChip.tsx";
import { Editors } from "./Editors.tsx";
import { Override } from "./Override.tsx";
import { StopButton } from "./StopButton.tsx";
import "./topbar.css";

const MODES: readonly StudioMode[] = ["cell", "teach", "check", "run", "history"];
const MENU: readonly (readonly string[])[] = [
  ["file.cells", "file.new", "file.load", "file.example", "file.conveyor", "file.save"],
  ["export.open", "export.import"],
  [
    "view.together",
    "view.cameras",
    "view.marker",
    "view.people",
    "view.fleet",
    "view.collision",
    "view.registration",
    "help.device",
    "help.controls",
    "help.shortcuts",
    "help.coach",
  ],
];

/** A phone has no room for these beside the menu. */
const PHONE_MENU: readonly (readonly string[])[] = [
  ["edit.undo", "edit.redo"],
  ...MENU,
  ["view.theme", "view.mute", "help.palette"],
];

export function TopBar({ phone }: { phone: boolean }) {
  return (
    <header className="topbar area-top">
      <h1 className="visually-hidden">{words.app.name}</h1>
      <CellMenu phone={phone} />
      {!phone && (
        <>
          <CellName />
          <Editors />
          <UndoRedo />
        </>
      )}
      <div className="topbar-space" />
      {!phone && <Modes />}
      <div className="topbar-space" />
      <TrainingChip />
      <ControllerChip brief={phone} />
      {!phone && <Override />}
      <StopButton />
      {!phone && <RightEnd />}
    </header>
  );
}

/** On a server for training no real robot can be reached: said where everybody looks, as long as it is so. */
function TrainingChip() {
  const training = useStore(sessionStore, state => state.info?.training === true);
  return training ? (
    <Tip words={words.fleet.trainingTip}>
      <span className="training-chip" role="status">
        <Lock aria-hidden />
        {words.fleet.training}
      </span>
    </Tip>
  ) : null;
}

function Modes() {
  const mode = useStore(viewStore, state => state.mode);
  return (
    <Segments
      className="seg"
      label={words.mode.label}
      value={mode}
      onChange={showMode}
      options={MODES.map(value => ({ value, words: words.mode[value] }))}
    />
  );
}

function CellMenu({ phone }: { phone: boolean }) {
  const commands = useStore(commandStore, state => state.commands);
  return (
    <DropdownMenu.Root modal={false}>
      <DropdownMenu.Trigger asChild>
        <button className="brand" aria-label={`${words.app.name}: ${words.top.menu}`}>
          <i aria-hidden />
          <span>{words.app.name}</span>
        </button>
      </DropdownMenu.Trigger>
      <DropdownMenu.Portal>
        <DropdownMenu.Content className="menu" align="start" sideOffset={6}>
          {(phone ? PHONE_MENU : MENU).map((ids, i) => (
            <DropdownMenu.Group key={i}>
              {i > 0 && <DropdownMenu.Separator className="menu-line" />}
              {ids
                .map(id => commands.get(id))
                .map(
                  command =>
                    command && (
                      <DropdownMenu.Item
                        key={command.id}
                        className="menu-item"
                        disabled={command.can?.() === false}
                        onSelect={() => runCommand(command.id)}
                      >
                        {command.words}
                        {command.keys?.[0] && <span className="kbd">{showKeys(command.keys[0])}</span>}
                      </DropdownMenu.Item>
                    ),
                )}
            </DropdownMenu.Group>
          ))}
          {languages.length > 1 && (
            <>
              <DropdownMenu.Separator className="menu-line" />
              <Languages />
            </>
          )}
        </DropdownMenu.Content>
      </DropdownMenu.Portal>
    </DropdownMenu.Root>
  );
}

/** The languages of the studio, each by its own name. */
function Languages() {
  return (
    <DropdownMenu.Sub>
      <DropdownMenu.SubTrigger className="menu-item">
        {words.language.menu}
        <span className="kbd" lang={language} translate="no">
          {nameOf(language)}
        </span>
      </DropdownMenu.SubTrigger>
      <DropdownMenu.Portal>
        <DropdownMenu.SubContent className="menu" sideOffset={4} collisionPadding={8}>
          <DropdownMenu.RadioGroup value={language} onValueChange={wanted => runCommand(`language.${wanted}`)}>
            {languages.map(each => (
              <DropdownMenu.RadioItem key={each} className="menu-item" value={each} lang={each} translate="no">
                <span className="grow">{nameOf(each)}</span>
                <DropdownMenu.ItemIndicator>
                  <Check size={14} />
                </DropdownMenu.ItemIndicator>
              </DropdownMenu.RadioItem>
            ))}
          </DropdownMenu.RadioGroup>
        </DropdownMenu.SubContent>
      </DropdownMenu.Portal>
    </DropdownMenu.Sub>
  );
}

function UndoRedo() {
  const undo = useStore(cellStore, state => state.undo[0]);
  const redo = useStore(cellStore, state => state.redo[0]);
  return (
    <div className="topbar-undo">
      <Tip words={undo ? `${words.common.undo}: ${undo}` : words.undo.nothing} keys="Mod+Z">
        <button
          className="btn quiet icon"
          aria-label={words.common.undo}
          aria-disabled={!undo}
          onClick={() => runCommand("edit.undo")}
        >
          <Undo2 />
        </button>
      </Tip>
      <Tip words={redo ? `${words.common.redo}: ${redo}` : words.undo.nothingAhead} keys="Mod+Shift+Z">
        <button
          className="btn quiet icon"
          aria-label={words.common.redo}
          aria-disabled={!redo}
          onClick={() => runCommand("edit.redo")}
        >
          <Redo2 />
        </button>
      </Tip>
    </div>
  );
}

function RightEnd() {
  const { theme, muted } = useStore(viewStore);
  return (
    <>
      <HeadsetButton />
      <Tip words={words.top.theme}>
        <button className="btn quiet icon" aria-label={words.top.theme} onClick={() => runCommand("view.theme")}>
          {theme === "dark" ? <Sun /> : <Moon />}
        </button>
      </Tip>
      <Tip words={muted ? words.top.unmute : words.top.mute}>
        <button
          className="btn quiet icon"
          aria-label={words.top.mute}
          aria-pressed={muted}
          onClick={() => runCommand("view.mute")}
        >
          {muted ? <VolumeX /> : <Volume2 />}
        </button>
      </Tip>
      <Tip words={words.top.palette}>
        <button className="topbar-palette" aria-label={words.top.palette} onClick={() => runCommand("help.palette")}>
          <span className="kbd" aria-hidden>
            {showKeys("Mod+K")}
          </span>
        </button>
      </Tip>
    </>
  );
}

/** Cannot be pressed without a headset, but can be asked why. */
function HeadsetButton() {
  const { ready, reason } = useStore(headsetStore);
  return (
    <Tip words={ready === false ? reason : words.top.headsetTip}>
      <button
        className="btn topbar-headset"
        aria-label={words.top.headset}
        aria-disabled={ready !== true}
        onClick={() => {
          if (ready) runCommand("view.headset");
        }}
      >
        <Headset />
        <span>{words.top.headset}</span>
      </button>
    </Tip>
  );
}
