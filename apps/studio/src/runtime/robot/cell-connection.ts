import { inverse, multiply, type Quaternion, type CartesianAxis } from "@twincell/core";
import type { CommandOutcome } from "@twincell/core";
import { cellStore } from "../../stores/cell.ts";
import { connectionStore, isLive } from "../../stores/connection.ts";
import { controlStore } from "../../stores/control.ts";
import { flangeFromTcpOf, robotOf, worldFromFrameOf } from "../../stores/document.ts";
import { jogStore, type JogState } from "../../stores/jog.ts";
import { notify } from "../../stores/notices.ts";
import { playStore } from "../../stores/play.ts";
import { isCarryingOut, stationOf, stationStore, type ServerAddress } from "../../stores/stations.ts";
import { viewStore } from "../../stores/view.ts";
import { words } from "../../messages/index.ts";
import { showJoints, theLive } from "../live.ts";
import { connectedRobot, type ConnectedRobot } from "./connected-robot.ts";
import { beforeTaking } from "./motion-owner.ts";
import { addStation, onStationSample, removeStation, stationLive, type NewStation } from "./stations.ts";

let robot: { readonly id: string; readonly of: ConnectedRobot } | null = null;

/** The connected robot of the cell; null while it has the simulated controller. */
export function theConnected(): ConnectedRobot | null {
  const { station } = connectionStore.getState();
  if (station === null) return null;
  if (robot?.id !== station) robot = { id: station, of: connectedRobot(station) };
  return robot.of;
}

/** Connects the robot of the cell to a controller of its own model. Nothing else in cell or program changes. */
export async function connectCellRobot(
  brand: string,
  place: ServerAddress,
  more: Pick<NewStation, "address" | "watch"> = {},
): Promise<CommandOutcome> {
  const { document } = cellStore.getState();
  if (!document) return { kind: "refused", why: { code: "cell.none", sentence: words.stations.gone, hint: "" } };
  await disconnectCellRobot();
  return addStation({
    brand,
    robot: document.robot.id,
    place,
    stand: document.robot.worldFromBase,
    ofCell: true,
    ...more,
  });
}
/** Back to the simulated controller; a robot that moves is stopped first by its host. */
export async function disconnectCellRobot(): Promise<void> {
  const { station } = connectionStore.getState();
  if (station !== null) await removeStation(station);
}

/** Live: the robot on screen is at once where the connected one is. Neither way moves that one. */
export function showAs(view: "live" | "clone"): void {
  if (connectionStore.getState().view === view) return;
  theConnected()?.stopJog();
  connectionStore.setState({ view });
  fetchFromThere();
}
/** The robot on screen goes to where the connected one stands. */
export function fetchFromThere(): void {
  const { station } = connectionStore.getState();
  const twin = station === null ? undefined : stationLive(station);
  if (twin && twin.revision > 0) showJoints(twin.q_rad);
}
/** The connected robot goes to where the robot on screen stands, guarded, as long as the enabling switch is held. */
export const sendThere = (): Promise<CommandOutcome> | null =>
  theConnected()?.moveJoints(Array.from(theLive().q_rad)) ?? null;

/** Tells of a motion that was refused; one that was stopped is told by the robot that stands. */
export function tellRefused(outcome: Promise<CommandOutcome> | null | undefined): void {
  void outcome?.then(({ kind, ...ended }) => {
    if (kind === "refused" && "why" in ended) notify("bad", ended.why.sentence, ended.why.hint);
  });
}
/** Moves the connected robot to joint angles if the enabling switch is held, and says so if it is not. */
export function goLive(q_rad: ArrayLike<number>, done: (arrived: boolean) => void): void {
  if (!connectionStore.getState().enabled) {
    notify("info", words.connection.holdFirst, words.connection.holdFirstHint);
    done(false);
    return;
  }
  void theConnected()
    ?.moveJoints(Array.from(q_rad))
    .then(outcome => {
      if (outcome.kind === "refused") notify("bad", outcome.why.sentence, outcome.why.hint);
      done(outcome.kind === "done");
    });
}

const LEAST = 0.05;
const REFUSED_MS = 2500;
interface Key {
  readonly axis: number;
  readonly sign: 1 | -1;
}
let pressed: Key | null = null;
let underWay = false;

/**
 * Called every frame with what is held on pendant, keyboard or gamepad: a change of the key begins or ends a jog of the
 * connected robot, the strongest key counts. The next one begins when the one before has ended.
 */
export function jogLive(held: Float64Array, now_ms: number): void {
  let next: Key | null = null;
  for (let axis = 0; axis < held.length; axis++)
    if (Math.abs(held[axis]!) > Math.max(LEAST, next ? Math.abs(held[next.axis]!) : 0))
      next = { axis, sign: held[axis]! > 0 ? 1 : -1 };
  if (next?.axis === pressed?.axis && next?.sign === pressed?.sign) return;
  const connected = theConnected();
  const jog = jogStore.getState();
  if (!connected) return;
  if (pressed && jog.manner === "hold") connected.stopJog();
  pressed = null;
  // The one before has not ended: asked again in the next frame.
  if (underWay && next) return;
  pressed = next;
  if (!next) return;
  if (!connectionStore.getState().enabled) {
    jogStore.setState({ blocked: { sentence: words.connection.holdFirst, until_ms: now_ms + REFUSED_MS } });
    return;
  }
  underWay = true;
  const key = next;
  jogStore.setState({ blocked: null });
  void jogOnce(connected, key, jog).then(outcome => {
    underWay = false;
    // Let go is told by the robot that stands; stopped under a held key, or refused, by a sentence.
    if (outcome.kind === "refused" || (outcome.kind === "stopped" && pressed === key))
      jogStore.setState({ blocked: { sentence: outcome.why.sentence, until_ms: performance.now() + REFUSED_MS } });
  });
}
function jogOnce(connected: ConnectedRobot, { axis, sign }: Key, jog: JogState): Promise<CommandOutcome> {
  const held = jog.manner === "hold";
  if (jog.frame === "joint") return connected.jogJoint(axis + 1, sign * (held ? Infinity : jog.step_rad));
  const by = sign * (held ? Infinity : axis < 3 ? jog.step_m : jog.step_rad);
  const { document } = cellStore.getState();
  const flangeFromTcp = flangeFromTcpOf(document);
  return connected.jogCartesian(axis as CartesianAxis, by, { baseFromAxes: axesOf(jog), flangeFromTcp });
}
/** The axes of the chosen frame, seen from the robot base. */
function axesOf(jog: JogState): Quaternion {
  const { document } = cellStore.getState();
  const baseFromWorld = inverse(document!.robot.worldFromBase).quaternion;
  switch (jog.frame) {
    case "tool":
      return multiply(baseFromWorld, theLive().worldFromTcp.quaternion);
    case "user":
      return multiply(baseFromWorld, worldFromFrameOf(document, "user", jog.userFrame).quaternion);
    case "world":
      return [...baseFromWorld];
    case "base":
    case "joint":
      return [0, 0, 0, 1];
  }
}

/** Holds and lets go the enabling switch of the connected robot. */
export function setEnabled(enabled: boolean): void {
  connectionStore.setState({ enabled });
  theConnected()?.setEnabled(enabled);
}

/** The robot on screen follows the connected one; whatever would move the screen alone moves the clone instead. */
export function startCellConnection(): void {
  onStationSample((id, q_rad) => {
    const { station, view } = connectionStore.getState();
    if (id === station && view === "live" && viewStore.getState().mode !== "history") showJoints(q_rad);
  });
  beforeTaking(mover => {
    if (mover !== "history" && isLive()) showAs("clone");
  });
  viewStore.subscribe((state, before) => {
    if (before.mode === "history" && state.mode !== "history" && isLive()) fetchFromThere();
  });
  cellStore.subscribe((state, before) => {
    // Another robot has another controller.
    if (state.document?.robot.id !== before.document?.robot.id) void disconnectCellRobot();
  });
  playStore.subscribe((state, before) => {
    if (state.speed !== before.speed) tellRefused(theConnected()?.setOverride(Math.round(100 * state.speed)));
  });
  // The controller chip and the lit step speak of the connected robot, as slowly as people read.
  stationStore.subscribe(() => {
    const { station } = connectionStore.getState();
    const now = station === null ? undefined : stationOf(station);
    if (!now) return;
    controlStore.setState({
      controller: words.connection.chip(robotOf(cellStore.getState().document)?.name ?? now.name, now.virtual),
      running: isCarryingOut(now),
      mode: now.mode,
      safety: now.safety,
      step: now.step,
      line: 0,
      latency_ms: now.link.late_s * 1000,
      message: now.notice || now.message,
    });
  });
}
