import type { CellDocument } from "@twincell/project";
import {
  createEditingSession,
  type EditingEvent,
  type EditingSession,
  type KeptSession,
} from "@twincell/project/sharing";
import { readRoomMessage, SOCKETS, writeEditing } from "@twincell/protocol";
import { cellStore } from "../stores/cell.ts";
import { inStep, shareHistory, type Sharing } from "../stores/document.ts";
import type { KeyValueStore } from "../stores/keeper.ts";
import { libraryStore, theLibrary } from "../stores/library.ts";
import { notify } from "../stores/notices.ts";
import { openCell } from "../stores/opening.ts";
import { selectionStore, type Thing } from "../stores/selection.ts";
import { ALONE, onPoint, togetherStore } from "../stores/together.ts";
import { words } from "../messages/index.ts";
import { ask } from "./session.ts";

/** The first wait before a connection is tried again, doubled up to the longest [ms]. */
const FIRST_WAIT_MS = 500;
const LONGEST_WAIT_MS = 8000;
/** Where somebody is goes to the others at most this often; what one did is kept in this browser this soon [ms]. */
const PRESENCE_MS = 60;
const KEPT_MS = 1000;
/** Closing codes with which a server says that asking again changes nothing. */
const FINAL: ReadonlySet<number> = new Set([1003, 1008, 4401, 4410]);
const PARAMETER = "cell";

/** What of a shared cell survives a reload of the page. */
interface KeptCell extends KeptSession {
  /** Under which it is in the library of this browser. */
  readonly id: string;
}
const keyOf = (cell: string): string => `twincell.shared.${cell}`;
const isKept = (value: unknown): value is KeptCell =>
  typeof value === "object" && value !== null && "epoch" in value && "state" in value;
const idOf = (value: unknown): string | null =>
  typeof value === "object" && value !== null && "id" in value && typeof value.id === "string" ? value.id : null;

let leave: (() => void) | null = null;

/** Stops editing together; the cell stays open as this browser's own. */
export function leaveCell(): void {
  leave?.();
}

/**
 * Opens a cell of the server to edit it with others.
 *
 * @param look  only to look at it, as by a read-only link.
 */
export async function joinCell(cell: string, store: KeyValueStore, look = false): Promise<void> {
  leave?.();
  togetherStore.setState({ ...ALONE, state: "opening", cell });
  const found = await store.get(keyOf(cell)).catch(() => undefined); // Without storage the cell is read anew.
  const kept = isKept(found) ? found : null;
  const id = idOf(found) ?? theLibrary()?.newId() ?? "";
  const session = createEditingSession({ onEvent: heard, normalise: inStep, kept: look ? null : kept });
  let shown = false;
  let ended = false;
  const keeping = keeper(cell, id, session, store, look);
  const line = connection(cell, look, session, why => {
    end();
    notify("bad", words.together.ended(cell), why === "" ? words.together.endedHint : why);
  });
  const presence = tellPresence(session);
  const sharing: Sharing = {
    refuses: (before, after) => (mayChange(session, before, after) ? null : words.together.rights[session.right]),
    ended: end,
  };

  function heard(event: EditingEvent): void {
    if (ended) return;
    if (event.type === "refused") {
      keepMine(event.kept, event.why.sentence, event.labels);
      return;
    }
    if (event.type === "document") showCell();
    tell();
    keeping.soon();
  }
  function tell(): void {
    togetherStore.setState({
      state: session.online ? "online" : shown ? "offline" : "opening",
      cell,
      who: session.who,
      right: session.right,
      waiting: session.waiting,
      editors: session.editors,
    });
  }
  function showCell(): void {
    const history = session.history();
    if (history === null) return;
    if (!shown) {
      shown = true;
      openCell(history.document, id);
      nameInAddress(look ? null : cell);
      presence.begin();
    }
    shareHistory(history, sharing);
  }
  function end(): void {
    if (ended) return;
    ended = true;
    leave = null;
    line.close();
    presence.end();
    void keeping.now().finally(() => {
      session.close();
    });
    nameInAddress(null);
    togetherStore.setState(ALONE);
    shareHistory(null, null);
  }
  leave = end;
  // Without a server the cell is there as it was kept.
  if (kept && !look) {
    showCell();
    tell();
  }
  line.open();
}

/** Who may only comment changes comments alone. */
function mayChange({ right }: EditingSession, before: CellDocument, after: CellDocument): boolean {
  if (right === "write") return true;
  const isSame = (key: keyof CellDocument): boolean =>
    key === "program" || (right === "comment" && key === "comments") || before[key] === after[key];
  return ([...Object.keys(before), ...Object.keys(after)] as (keyof CellDocument)[]).every(isSame);
}

/** What could not be put into the cell is a cell of this browser's own. */
function keepMine(kept: CellDocument, why: string, labels: readonly string[]): void {
  const library = theLibrary();
  const mine = { ...kept, name: words.together.mine(kept.name) };
  const hint =
    labels.length > 0 ? words.together.keptWith(mine.name, labels.join(", ")) : words.together.kept(mine.name);
  library?.put(library.newId(), mine).then(
    () => notify("warn", why, hint),
    (problem: unknown) =>
      notify("bad", why, words.file.noKeep(problem instanceof Error ? problem.message : String(problem))),
  );
}

/** The address of the page names the cell, so that it can be given to others and opened again. */
function nameInAddress(cell: string | null): void {
  const here = new URL(location.href);
  if (cell === null) here.searchParams.delete(PARAMETER);
  else here.searchParams.set(PARAMETER, cell);
  history.replaceState(history.state, "", here);
}

/** A connection that is made anew as long as the cell is shared. */
function connection(cell: string, look: boolean, session: EditingSession, refused: (why: string) => void) {
  let socket: WebSocket | null = null;
  let closed = false;
  let wait_ms = FIRST_WAIT_MS;
  let timer = 0;
  const again = (): void => {
    clearTimeout(timer);
    timer = window.setTimeout(open, wait_ms);
    wait_ms = Math.min(LONGEST_WAIT_MS, 2 * wait_ms);
  };
  const atOnce = (): void => {
    if (socket === null && !closed) {
      clearTimeout(timer);
      open();
    }
  };
  function open(): void {
    const address = new URL(SOCKETS.editing, location.href);
    address.searchParams.set("cell", cell);
    if (look) address.searchParams.set("look", "1");
    address.protocol = location.protocol === "https:" ? "wss:" : "ws:";
    const mine = (socket = new WebSocket(address));
    mine.onopen = () => {
      wait_ms = FIRST_WAIT_MS;
      session.connected(message => {
        if (mine.readyState === WebSocket.OPEN) mine.send(writeEditing(message));
      });
    };
    mine.onmessage = ({ data }: MessageEvent<unknown>) => {
      const read = readRoomMessage(String(data));
      if (read.kind === "read") session.receive(read.message);
      else mine.close();
    };
    mine.onclose = ({ code, reason }) => {
      if (socket !== mine) return;
      socket = null;
      if (closed) return;
      session.disconnected();
      if (FINAL.has(code)) refused(reason);
      else again();
    };
  }
  window.addEventListener("online", atOnce);
  return {
    open,
    close(): void {
      closed = true;
      clearTimeout(timer);
      window.removeEventListener("online", atOnce);
      socket?.close();
    },
  };
}

/** Keeps what one did in this browser, so that a page that is closed without a connection loses nothing. */
function keeper(cell: string, id: string, session: EditingSession, store: KeyValueStore, look: boolean) {
  let timer = 0;
  let told = false;
  async function now(): Promise<void> {
    clearTimeout(timer);
    timer = 0;
    const kept = session.keep();
    if (kept === null || look) return;
    const value: KeptCell = { ...kept, id };
    try {
      await store.set(keyOf(cell), value);
    } catch (problem) {
      if (!told) notify("warn", words.file.noKeep(problem instanceof Error ? problem.message : String(problem)));
      told = true;
    }
  }
  return {
    now,
    soon(): void {
      if (timer === 0) timer = window.setTimeout(() => void now(), KEPT_MS);
    },
  };
}

/** Tells the others what is selected and where this person points. */
function tellPresence(session: EditingSession) {
  let pointer_m: readonly [number, number, number] | null = null;
  let timer = 0;
  const send = (): void => {
    timer = 0;
    session.point({
      program: cellStore.getState().document?.program ?? "",
      selected: selectedOf(selectionStore.getState().selected),
      pointer_m,
    });
  };
  const soon = (): void => {
    if (timer === 0) timer = window.setTimeout(send, PRESENCE_MS);
  };
  const stops: (() => void)[] = [];
  return {
    begin(): void {
      send();
      stops.push(
        selectionStore.subscribe((now, before) => {
          if (now.selected !== before.selected) soon();
        }),
        cellStore.subscribe((now, before) => {
          if (now.document?.program !== before.document?.program) soon();
        }),
      );
      onPoint(at_m => {
        if (at_m === pointer_m) return;
        pointer_m = at_m;
        soon();
      });
    },
    end(): void {
      clearTimeout(timer);
      for (const stop of stops) stop();
      onPoint(() => undefined);
    },
  };
}
function selectedOf(thing: Thing | null): { readonly kind: string; readonly id: string } | null {
  switch (thing?.kind) {
    case undefined:
      return null;
    case "step":
    case "object":
      return { kind: thing.kind, id: thing.id };
    case "frame":
    case "routine":
      return { kind: thing.kind, id: thing.name };
    default:
      return { kind: thing!.kind, id: "" };
  }
}

/** Names of the cells that the server keeps, or the sentence of why there are none. */
export const listCells = () => ask<{ readonly names: readonly string[] }>("GET", "cells");
export const linkCell = (cell: string) =>
  ask<{ readonly link: string; readonly until: string }>("POST", `cells/${encodeURIComponent(cell)}/link`, {});
export const unlinkCell = (cell: string) => ask<unknown>("DELETE", `cells/${encodeURIComponent(cell)}/link`);

/** Puts the open cell on the server, under its name or the next that is free. The sentence of why not, or null. */
export async function shareOpenCell(store: KeyValueStore): Promise<string | null> {
  const { document } = cellStore.getState();
  if (document === null) return null;
  const listed = await listCells();
  if (listed.kind === "no") return listed.sentence;
  const plain =
    document.name
      .normalize("NFKD")
      .replace(/[^\w.-]+/g, "-")
      .replace(/^[.-]+|-+$/g, "")
      .slice(0, 70) || "cell";
  let name = plain;
  for (let i = 2; listed.value.names.includes(name); i++) name = `${plain}-${i}`;
  const put = await ask<unknown>("PUT", `cells/${name}`, document);
  if (put.kind === "no") return put.sentence;
  // It goes on under the id that it has in this browser.
  const { current } = libraryStore.getState();
  await store.set(keyOf(name), { id: current }).catch(() => undefined); // Then the library has two of it.
  await joinCell(name, store);
  return null;
}
