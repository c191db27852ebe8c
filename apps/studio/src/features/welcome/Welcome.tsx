import { LIBRARY } from "@twincell/core";
import { Cable, FileUp } from "lucide-react";
import { useStore } from "zustand";
import { cellStore } from "../../stores/cell.ts";
import { runCommand } from "../../stores/commands.ts";
import { programOf, robotOf } from "../../stores/document.ts";
import { shortName } from "../../stores/robot.ts";
import { words } from "../../messages/index.ts";
import "./welcome.css";

/** An empty cell offers three ways to begin. */
export function Welcome() {
  const empty = useStore(
    cellStore,
    state =>
      state.document !== null &&
      state.document.objects.length === 0 &&
      state.document.tools.length === 0 &&
      state.document.robot.file === undefined &&
      (programOf(state.document)?.steps.length ?? 0) === 0,
  );
  const robot = useStore(cellStore, state => robotOf(state.document));
  if (!empty || !robot) return null;
  return (
    <section className="welcome float" aria-label={words.welcome.title}>
      <h2>{words.welcome.title}</h2>
      <div className="welcome-ways">
        <button className="welcome-way" onClick={() => runCommand("file.example")}>
          <Thumbnail />
          <b>{words.welcome.example}</b>
          <span>{words.welcome.exampleSays}</span>
        </button>
        <button className="welcome-way" onClick={() => runCommand("file.load")}>
          <span className="welcome-glyph" aria-hidden>
            <FileUp />
          </span>
          <b>{words.welcome.drop}</b>
          <span>{words.welcome.dropSays}</span>
        </button>
        <button className="welcome-way" onClick={() => runCommand("cell.robot")}>
          <span className="welcome-glyph" aria-hidden>
            <Cable />
          </span>
          <b>{words.welcome.robot}</b>
          <span>
            {words.welcome.connectSays(shortName(robot))} {words.welcome.robotSays(LIBRARY.length)}
          </span>
        </button>
      </div>
    </section>
  );
}

/** The example as a small drawing: carton, traced edge, arm. */
const Thumbnail = () => (
  <svg className="welcome-picture" viewBox="0 0 160 84" aria-hidden>
    <path d="M0 66h160" stroke="var(--grid)" />
    <path d="M84 76 50 62l36-12 36 13z" fill="var(--raised)" stroke="var(--grid)" />
    <path d="m60 58 27 11V49L60 40z" fill="#a97b48" />
    <path d="m87 69 26-9V42l-26 7z" fill="#c3935b" />
    <path d="m60 40 27 9 26-7-27-8z" fill="#dcae75" />
    <path d="m60 40 27 9 26-7-27-8z" fill="none" stroke="var(--ok)" strokeWidth="2" strokeDasharray="5 2.500" />
    <path
      d="M26 66V44l4-16 34-9 15 9 6 20"
      fill="none"
      stroke="var(--text-2)"
      strokeWidth="7"
      strokeLinejoin="round"
      strokeLinecap="round"
    />
    <circle cx="30" cy="29" r="6" fill="var(--text-3)" />
    <circle cx="64" cy="19" r="5" fill="var(--text-3)" />
  </svg>
);
