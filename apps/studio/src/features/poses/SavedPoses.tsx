import { FolderOpen, LocateFixed, MapPinPlus, Navigation, Route, Save, Trash2 } from "lucide-react";
import type { Pose } from "@twincell/core";
import { savedCoords } from "@twincell/project";
import { useMemo, useRef } from "react";
import { useStore } from "zustand";
import { goThere } from "../../runtime/jog/go-to-point.ts";
import { solveTcp } from "../../runtime/jog/solve.ts";
import { theLive } from "../../runtime/live.ts";
import { cellStore } from "../../stores/cell.ts";
import { notify } from "../../stores/notices.ts";
import { forgetPoses, keepPose, movePose, movesThroughPoses, posesText, readPoses } from "../../stores/poses.ts";
import { theRobot } from "../../stores/document.ts";
import { download } from "../../ui/download.ts";
import { showNumber } from "../../ui/expression.ts";
import { Tip } from "../../ui/Tip.tsx";
import { say, words } from "../../messages/index.ts";
import "./poses.css";

/** Poses of the tool tip that a person keeps: taken, put elsewhere, loaded, saved, and driven through. */
export function SavedPoses() {
  const cell = useStore(cellStore, state => state.document);
  const poses = useMemo(() => (cell === null ? [] : savedCoords(cell)), [cell]);
  const input = useRef<HTMLInputElement>(null);
  const none = poses.length === 0;
  const load = async (file: File): Promise<void> => {
    try {
      const answer = readPoses(await file.text());
      if (answer.kind === "read") notify("done", words.poses.loaded(answer.count), file.name);
      else notify("bad", answer.sentence, file.name);
    } catch (problem) {
      notify("bad", words.file.unreadable(file.name), problem instanceof Error ? problem.message : undefined);
    }
  };
  const save = (): void => {
    download("poses.poses.txt", new Blob([posesText()], { type: "text/plain" }));
    notify("done", words.file.saved("poses.poses.txt"));
  };
  return (
    <section className="poses" aria-label={words.poses.title}>
      <h2 className="heading">
        <span className="grow">{words.poses.title}</span>
        <span className="dim small">{none ? "" : poses.length}</span>
      </h2>
      <div className="section stack">
        {none ? (
          <p className="small muted">{words.poses.none}</p>
        ) : (
          <ul className="poses-list">
            {poses.map(({ name, worldFromFrame: { position, quaternion } }) => (
              <li key={name} className="poses-row">
                <span className="poses-name" title={name}>
                  {name}
                </span>
                <span className="num small dim">{position.map(value => showNumber(value, "length")).join("  ")}</span>
                <Tip words={words.poses.goToTip}>
                  <button
                    className="btn quiet icon tight"
                    aria-label={words.poses.goTo(name)}
                    onClick={() => goTo(name, { position, quaternion })}
                  >
                    <Navigation />
                  </button>
                </Tip>
                <Tip words={words.poses.putTip}>
                  <button
                    className="btn quiet icon tight"
                    aria-label={words.poses.put(name)}
                    onClick={() => movePose(name, theLive().worldFromTcp)}
                  >
                    <LocateFixed />
                  </button>
                </Tip>
              </li>
            ))}
          </ul>
        )}
        <div className="poses-buttons">
          <Tip words={words.poses.addTip}>
            <button className="btn" onClick={() => keepPose(theLive().worldFromTcp)}>
              <MapPinPlus />
              {words.poses.add}
            </button>
          </Tip>
          <Tip words={words.poses.throughTip}>
            <button className="btn" disabled={none} onClick={movesThroughPoses}>
              <Route />
              {words.poses.through}
            </button>
          </Tip>
          <button className="btn" onClick={() => input.current?.click()}>
            <FolderOpen />
            {words.poses.load}
          </button>
          <button className="btn" disabled={none} onClick={save}>
            <Save />
            {words.poses.save}
          </button>
          <button
            className="btn poses-remove"
            disabled={none}
            onClick={() => {
              if (forgetPoses()) notify("info", words.poses.removed);
            }}
          >
            <Trash2 />
            {words.poses.remove}
          </button>
        </div>
        <input
          ref={input}
          type="file"
          accept=".txt"
          hidden
          aria-label={words.poses.load}
          onChange={event => {
            const file = event.currentTarget.files?.[0];
            if (file) void load(file);
            event.currentTarget.value = "";
          }}
        />
      </div>
    </section>
  );
}

/** The robot goes to a saved pose by its joints, as it goes to a point of a program (row L-27); or why it cannot. */
function goTo(name: string, worldFromTcp: Pose<"world", "tcp">): void {
  const robot = theRobot();
  if (!robot) return;
  const there = solveTcp(worldFromTcp, theLive().q_rad);
  if (there.kind === "reached") goThere(robot, there.q_rad);
  else notify("warn", words.poses.notThere(name), say(there.sentence));
}
