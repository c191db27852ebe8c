import type { CommandOutcome } from "@twincell/core";
import type { Request } from "@twincell/protocol";
import { words } from "../../messages/index.ts";
import { cyclesOf, productionStore, toggled } from "../../stores/production.ts";
import { changeStation, stationOf } from "../../stores/stations.ts";
import { hostAt } from "./station-hosts.ts";
import { beginRecording, endRecording } from "./station-recordings.ts";
import { programFor, stationLive } from "./stations.ts";

const gone = (): CommandOutcome => ({
  kind: "refused",
  why: { code: "station.none", sentence: words.stations.gone, hint: "" },
});
function ask(id: string, request: Request): Promise<CommandOutcome> {
  const place = stationOf(id)?.place;
  return (place && hostAt(place)?.ask(request)) ?? Promise.resolve(gone());
}

/**
 * Runs the present program on a connected robot, cycle after cycle as `productionStore` says, recorded from beginning
 * to end. It goes there by steps: a text of the controller's own has the place to itself, and could not be handed back.
 *
 * @param despite  codes of red findings that the person has seen; its connection refuses the program for any other.
 */
export async function beginProduction(id: string, despite: readonly string[]): Promise<CommandOutcome> {
  const wanted = programFor(id);
  const station = stationOf(id);
  const live = stationLive(id);
  if (!wanted || !station || !live) return gone();
  const { program } = wanted;
  const choice = productionStore.getState();
  const known = new Set(program.steps.map(step => step.id));
  const breakpoints = choice.breakpoints.filter(step => known.has(step));
  productionStore.setState({ sent: program, breakpoints });
  changeStation(id, { running: true, notice: "" });
  const recording = beginRecording(station, live.robot, program.name);
  const outcome = await ask(id, {
    type: "produce",
    station: id,
    program,
    asText: false,
    despite: [...despite],
    cycles: cyclesOf(choice),
    breakpoints,
    stepping: choice.isStepping,
  });
  await endRecording(id, recording, outcome);
  changeStation(id, {
    running: false,
    production: null,
    notice: outcome.kind === "done" ? "" : outcome.why.sentence,
  });
  return outcome;
}

/** The present program takes over at the next cycle; it is checked first, and refused at once where it is red. */
export async function replaceProduction(id: string, despite: readonly string[]): Promise<CommandOutcome> {
  const wanted = programFor(id);
  if (!wanted) return gone();
  const before = productionStore.getState().sent;
  productionStore.setState({ sent: wanted.program });
  const outcome = await ask(id, {
    type: "replace",
    station: id,
    program: wanted.program,
    asText: false,
    despite: [...despite],
  });
  if (outcome.kind !== "done" && productionStore.getState().sent === wanted.program)
    productionStore.setState({ sent: before });
  return outcome;
}

/** Stops the robot and keeps the place: it may be moved by hand until it is handed back. */
export const holdProduction = (id: string): Promise<CommandOutcome> => ask(id, { type: "intervene", station: id });
export const resumeProduction = (id: string, from: "step" | "cycle"): Promise<CommandOutcome> =>
  ask(id, { type: "resume", station: id, from });
export const stepProduction = (id: string): Promise<CommandOutcome> => ask(id, { type: "single-step", station: id });

/** Sets or takes away a breakpoint; a production that is under way is told. */
export async function toggleBreakpoint(id: string, step: string): Promise<CommandOutcome> {
  const before = productionStore.getState().breakpoints;
  const breakpoints = toggled(before, step);
  productionStore.setState({ breakpoints });
  if (!stationOf(id)?.production) return { kind: "done" };
  const outcome = await ask(id, { type: "breakpoints", station: id, steps: [...breakpoints] });
  if (outcome.kind !== "done") productionStore.setState({ breakpoints: before });
  return outcome;
}
