/** Cells that people edit together, over real sockets of a running server. */
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { emptyCell, openDocument, type CellDocument } from "@twincell/project";
import { createEditingSession, type EditingEvent, type EditingSession } from "@twincell/project/sharing";
import { readRoomMessage, writeEditing } from "@twincell/protocol";
import { afterEach, expect, test, vi } from "vitest";
import { WebSocket } from "ws";
import { auditFile, readAudit, serve, type Served } from "../index.ts";

const studio = mkdtempSync(join(tmpdir(), "twincell-studio-"));
writeFileSync(join(studio, "index.html"), "<title>studio</title>");
const open: { close(): unknown }[] = [];
afterEach(async () => {
  for (const each of open.splice(0).reverse()) await each.close();
});
const until = (done: () => boolean): Promise<void> =>
  vi.waitFor(
    () => {
      expect(done()).toBe(true);
    },
    { timeout: 20_000, interval: 10 },
  );
async function server(data: string, accounts = false): Promise<Served> {
  const served = await serve({ studio, port: 0, version: "test", data, accounts });
  open.push(served);
  return served;
}
async function ask(served: Served, method: string, path: string, body?: unknown, cookie = "") {
  const response = await fetch(new URL(path, served.url), {
    method,
    redirect: "manual",
    headers: { cookie, ...(body === undefined ? {} : { "content-type": "application/json" }) },
    body: body === undefined ? null : JSON.stringify(body),
  });
  const text = await response.text();
  return {
    status: response.status,
    body: (text.startsWith("{") ? JSON.parse(text) : { text }) as Record<string, unknown>,
    cookie: (response.headers.get("set-cookie") ?? "").split(";")[0]!,
    location: response.headers.get("location"),
  };
}

interface Person {
  readonly session: EditingSession;
  readonly events: EditingEvent[];
  /** Code and reason with which the server ended the connection. */
  readonly ended: () => string | null;
  connect(served: Served): void;
  disconnect(): Promise<void>;
}
function person(cookie = "", look = ""): Person {
  const events: EditingEvent[] = [];
  const session = createEditingSession({ onEvent: event => events.push(event) });
  let socket: WebSocket | null = null;
  let ended: string | null = null;
  const made: Person = {
    session,
    events,
    ended: () => ended,
    connect(served) {
      const address = new URL(`/api/v1/editing?cell=line${look}`, served.url);
      address.protocol = "ws:";
      const mine = (socket = new WebSocket(address, { headers: { cookie } }));
      mine.on("open", () => session.connected(message => mine.send(writeEditing(message))));
      mine.on("message", data => {
        const read = readRoomMessage(String(data as Buffer));
        if (read.kind === "fault") throw new Error(read.sentence);
        session.receive(read.message);
      });
      mine.on("unexpected-response", (_, { statusCode }) => {
        ended = String(statusCode);
        mine.terminate();
      });
      mine.on("error", () => undefined);
      mine.on("close", (code, reason) => {
        ended ??= `${code} ${String(reason)}`;
        session.disconnected();
      });
    },
    async disconnect() {
      const gone = socket;
      if (!gone) return;
      gone.close();
      await until(() => gone.readyState === WebSocket.CLOSED);
    },
  };
  open.push({ close: () => socket?.terminate() });
  return made;
}
function edit({ session }: Person, change: (cell: CellDocument) => CellDocument): void {
  const history = session.history()!;
  history.commit("change", change(history.document));
}
const named = (name: string) => (cell: CellDocument) => ({ ...cell, name });
const withBox =
  (id: string) =>
  (cell: CellDocument): CellDocument => ({
    ...cell,
    objects: [
      ...cell.objects,
      {
        id,
        name: id,
        role: "furniture",
        worldFromObject: { position: [0, 0, 0], quaternion: [0, 0, 0, 1] },
        shape: { kind: "box", size_m: [1, 1, 1] },
        color: "#808080",
      },
    ],
  });
const ids = ({ session }: Person): readonly string[] =>
  (session.document?.objects ?? []).map(({ id }) => id).toSorted();
const onDisk = (data: string): CellDocument | null => {
  const opened = openDocument(readFileSync(join(data, "cells", "line.json"), "utf8"));
  return opened.kind === "opened" ? opened.document : null;
};

test("two studios edit one cell at the same time, see each other and what is selected; what one did without a connection is merged; the API reads it and its writes come in; a server that starts again goes on with it", async () => {
  const data = mkdtempSync(join(tmpdir(), "twincell-data-"));
  let served = await server(data);
  await ask(served, "PUT", "/api/v1/cells/line", emptyCell());
  const [a, b] = [person(), person()];
  a.connect(served);
  b.connect(served);
  await until(() => a.session.online && b.session.online && a.session.editors.length === 1);
  edit(a, withBox("from-a"));
  edit(b, withBox("from-b"));
  await until(() => ids(a).length === 2 && ids(b).length === 2);
  b.session.point({ program: "Program", selected: { kind: "object", id: "from-a" }, pointer_m: [1, 2, 3] });
  await until(() => a.session.editors[0]?.presence?.pointer_m?.[2] === 3);
  expect(a.session.editors[0]).toMatchObject({ who: "studio 2", presence: { selected: { id: "from-a" } } });

  await b.disconnect();
  await until(() => a.session.editors.length === 0);
  edit(b, withBox("offline"));
  edit(a, named("Renamed"));
  b.connect(served);
  await until(() => ids(a).includes("offline") && b.session.document?.name === "Renamed");

  await until(() => onDisk(data)?.objects.length === 3);
  const { body } = await ask(served, "GET", "/api/v1/cells/line");
  expect(body).toMatchObject({ name: "Renamed", objects: { length: 3 } });
  await ask(served, "PUT", "/api/v1/cells/line", { ...body, name: "By the API" });
  await until(() => a.session.document?.name === "By the API" && b.session.document?.name === "By the API");

  // The server goes while both go on, and comes back with what it kept.
  edit(a, withBox("last"));
  await until(() => ids(b).includes("last"));
  await served.close();
  await until(() => !a.session.online && !b.session.online);
  expect(onDisk(data)?.objects.length).toBe(4);
  edit(a, withBox("away-a"));
  edit(b, withBox("away-b"));
  served = await server(data);
  a.connect(served);
  b.connect(served);
  const all = ["away-a", "away-b", "from-a", "from-b", "last", "offline"];
  await until(() => ids(a).length === 6 && ids(b).length === 6);
  expect([ids(a), ids(b)]).toEqual([all, all]);

  expect(await ask(served, "DELETE", "/api/v1/cells/line")).toMatchObject({ status: 200 });
  await until(() => a.ended() !== null && b.ended() !== null);
  const late = person();
  late.connect(served);
  await until(() => late.ended() !== null);
  expect(late.ended()).toBe("1008 There is no “line” among the cells.");
});

const PASSWORD = "correct horse";
const linkOf = (address: unknown): string => new URL(String(address)).searchParams.get("invitation")!;
async function people(served: Served): Promise<Record<"admin" | "viewer" | "programmer", string>> {
  const first = await ask(served, "POST", "/api/v1/invitation", {
    link: linkOf(served.setUp),
    name: "Ada",
    password: PASSWORD,
  });
  const invite = async (name: string, role: string): Promise<string> => {
    const { body } = await ask(served, "PUT", `/api/v1/people/${name}`, { role }, first.cookie);
    return (await ask(served, "POST", "/api/v1/invitation", { link: linkOf(body["link"]), password: PASSWORD })).cookie;
  };
  return { admin: first.cookie, viewer: await invite("Vic", "viewer"), programmer: await invite("Pat", "programmer") };
}

test("the server asks for the role at every message: a viewer writes comments in their own name and changes nothing else, a programmer whose role is taken back changes nothing from then on, who is not signed in is not let in", async () => {
  const data = mkdtempSync(join(tmpdir(), "twincell-data-"));
  const served = await server(data, true);
  const cookies = await people(served);
  await ask(served, "PUT", "/api/v1/cells/line", emptyCell(), cookies.programmer);
  const stranger = person();
  stranger.connect(served);
  await until(() => stranger.ended() !== null);
  expect(stranger.ended()).toBe("403");
  const [pat, vic] = [person(cookies.programmer), person(cookies.viewer)];
  pat.connect(served);
  vic.connect(served);
  await until(() => pat.session.online && vic.session.online && pat.session.editors.length === 1);
  expect([pat.session.right, vic.session.right, pat.session.editors[0]!.who]).toEqual(["write", "comment", "Vic"]);
  const comment = {
    id: "c",
    program: "Program",
    step: "s1",
    who: "Vic",
    at: "2026-11-27T10:00:00Z",
    text: "Too fast?",
  };
  edit(vic, cell => ({ ...cell, comments: [comment] }));
  await until(() => pat.session.document?.comments?.length === 1);
  edit(vic, named("Vic was here"));
  await until(() => vic.events.some(({ type }) => type === "refused"));
  expect(vic.events.find(event => event.type === "refused")).toMatchObject({
    why: { sentence: "You may write comments on steps of this cell, and not change it." },
    kept: { name: "Vic was here" },
  });
  edit(pat, named("Pat's"));
  await until(() => vic.session.document?.name === "Pat's");
  await ask(served, "PUT", "/api/v1/people/Pat", { role: "operator", rights: {}, renew: false }, cookies.admin);
  edit(pat, named("Too late"));
  await until(() => pat.events.some(({ type }) => type === "refused"));
  await until(() => pat.session.document?.name === "Pat's");
  await until(() => onDisk(data)?.name === "Pat's");
  const { lines } = readAudit(readFileSync(auditFile(data), "utf8"));
  const edits = lines
    .filter(({ action }) => action === "edits the cell")
    .map(({ who, outcome }) => `${who} ${outcome}`);
  expect(edits.toSorted()).toEqual(["Pat done", "Pat refused", "Vic done", "Vic refused"]);
});

test("a read-only link shows one cell as it is edited to people without an account, and nothing else: no write, no robot, no other cell; taken back, it ends within seconds", async () => {
  const data = mkdtempSync(join(tmpdir(), "twincell-data-"));
  const served = await server(data, true);
  const cookies = await people(served);
  await ask(served, "PUT", "/api/v1/cells/line", emptyCell(), cookies.programmer);
  await ask(served, "PUT", "/api/v1/cells/secret", emptyCell(), cookies.programmer);
  expect(await ask(served, "POST", "/api/v1/cells/line/link", {}, cookies.viewer)).toMatchObject({ status: 403 });
  const made = await ask(served, "POST", "/api/v1/cells/line/link", {}, cookies.programmer);
  const link = new URL(String(made.body["link"]));
  const entered = await ask(served, "GET", `${link.pathname}${link.search}`);
  expect(entered).toMatchObject({ status: 303, location: "/?watch=line" });
  expect(entered.cookie).toMatch(/^twincell_link=twincell_/);
  const look = entered.cookie;
  expect((await ask(served, "GET", "/api/v1/session", undefined, look)).body).toMatchObject({
    name: null,
    link: "line",
  });
  expect((await ask(served, "GET", "/api/v1/cells/line", undefined, look)).status).toBe(200);
  for (const [method, path, body] of [
    ["GET", "/api/v1/cells/secret", undefined],
    ["GET", "/api/v1/cells", undefined],
    ["GET", "/api/v1/robots", undefined],
    ["PUT", "/api/v1/cells/line", emptyCell()],
    ["POST", "/api/v1/cells/line/link", {}],
    ["POST", "/api/v1/robots/line/stop", {}],
    ["GET", "/metrics", undefined],
  ] as const)
    expect([path, (await ask(served, method, path, body, look)).status]).toEqual([path, 403]);
  // Neither as a cookie nor as a token does it open the sockets of robots.
  for (const headers of [{ cookie: look }, { authorization: `Bearer ${look.slice("twincell_link=".length)}` }])
    for (const path of ["/stations", "/api/v1/stream", "/api/v1/editing?cell=secret"]) {
      const socket = new WebSocket(new URL(path, served.url.replace("http", "ws")), { headers });
      const status = await new Promise(resolve => {
        socket.on("unexpected-response", (_, { statusCode }) => resolve(statusCode));
        socket.on("open", () => resolve("open"));
        socket.on("error", () => undefined);
      });
      socket.terminate();
      expect([path, status]).toEqual([path, 403]);
    }
  const [guest, pat] = [person(look), person(cookies.programmer)];
  guest.connect(served);
  pat.connect(served);
  await until(() => guest.session.online && pat.session.online);
  expect([guest.session.right, guest.session.who]).toEqual(["look", "guest 1"]);
  edit(pat, named("Seen"));
  await until(() => guest.session.document?.name === "Seen");
  edit(guest, named("Not by me"));
  await until(() => guest.events.some(({ type }) => type === "refused"));
  await until(() => guest.session.document?.name === "Seen");
  expect(pat.session.document?.name).toBe("Seen");
  expect((await ask(served, "DELETE", "/api/v1/cells/line/link", undefined, cookies.programmer)).status).toBe(200);
  await until(() => guest.ended() !== null);
  expect(guest.ended()).toMatch(/^4401 /);
  expect((await ask(served, "GET", `${link.pathname}${link.search}`)).status).toBe(410);
});

test("messages that are none, in great number or of people who never joined, end that connection alone", async () => {
  const data = mkdtempSync(join(tmpdir(), "twincell-data-"));
  const served = await server(data);
  await ask(served, "PUT", "/api/v1/cells/line", emptyCell());
  const pat = person();
  pat.connect(served);
  await until(() => pat.session.online);
  const flood = Array.from({ length: 500 }, (_, number) =>
    writeEditing({ type: "update", number, update: new Uint8Array([0, 0]) }),
  );
  for (const messages of [["no JSON"], ['{"type":"update","number":1,"update":"***"}'], ['{"type":"grant"}'], flood]) {
    const socket = new WebSocket(new URL("/api/v1/editing?cell=line", served.url.replace("http", "ws")));
    const code = new Promise(resolve => socket.on("close", resolve));
    socket.on("open", () => {
      for (const message of messages) socket.send(message);
    });
    expect(await code).toBe(1008);
  }
  edit(pat, named("Goes on"));
  await until(() => onDisk(data)?.name === "Goes on");
});
