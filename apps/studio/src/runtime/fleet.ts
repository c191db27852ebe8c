import type { FleetEntry } from "@twincell/protocol";
import { createStore } from "zustand/vanilla";
import { words } from "../messages/index.ts";
import { ask } from "./session.ts";

/** All robots that the server of this page knows. */
export interface FleetState {
  readonly robots: readonly FleetEntry[];
  /** Why nothing is shown; "" while the server answers. */
  readonly sentence: string;
  /** Null before the first answer. */
  readonly asked_ms: number | null;
}
export const fleetStore = createStore<FleetState>(() => ({ robots: [], sentence: "", asked_ms: null }));
const EACH_MS = 1000;

/** Asks the server once a second until the returned function is called. */
export function watchFleet(): () => void {
  let over = false;
  let timer = 0;
  const look = async (): Promise<void> => {
    const asked = await ask<{ readonly robots: readonly FleetEntry[] }>("GET", "fleet");
    if (over) return;
    if (asked.kind === "answer")
      fleetStore.setState({ robots: asked.value.robots, sentence: "", asked_ms: Date.now() });
    else fleetStore.setState({ sentence: asked.sentence, asked_ms: Date.now() });
    timer = window.setTimeout(() => void look(), EACH_MS);
  };
  void look();
  return () => {
    over = true;
    window.clearTimeout(timer);
  };
}

/** The newest recording of a robot of this server as a file, or the sentence of why not. */
export async function newestRecording(robot: string): Promise<File | string> {
  type Listed = { readonly recordings: readonly { readonly robot: string; readonly file: string }[] };
  const listed = await ask<Listed>("GET", "recordings");
  if (listed.kind === "no") return listed.sentence;
  const found = listed.value.recordings.filter(each => each.robot === robot).at(-1);
  if (!found) return words.fleet.noRecording;
  try {
    const path = `/api/v1/recordings/${encodeURIComponent(found.robot)}/${encodeURIComponent(found.file)}`;
    const response = await fetch(path);
    return response.ok ? new File([await response.blob()], found.file) : words.fleet.noRecording;
  } catch {
    return words.people.unreachable;
  }
}

/** Whether a robot is open at the server of this page. */
export async function isOwnRobot(id: string): Promise<boolean> {
  const asked = await ask<{ readonly robots: readonly { readonly id: string }[] }>("GET", "robots");
  return asked.kind === "answer" && asked.value.robots.some(each => each.id === id);
}
