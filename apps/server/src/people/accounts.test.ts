/** People who sign in by name: the first by the link that the server prints, others by links of an admin. */
import { createHash, generateKeyPairSync, randomBytes, sign } from "node:crypto";
import { once } from "node:events";
import { mkdtempSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { request as httpRequest } from "node:http";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { emptyProgram } from "@twincell/core";
import { afterEach, expect, test } from "vitest";
import { WebSocket } from "ws";
import { auditFile, readAudit, serve, type Served } from "../index.ts";
import { accountsFile } from "./accounts.ts";

const studio = mkdtempSync(join(tmpdir(), "twincell-studio-"));
writeFileSync(join(studio, "index.html"), "<title>studio</title>");
const open: { close(): unknown }[] = [];
afterEach(async () => {
  for (const each of open.splice(0).reverse()) await each.close();
});
const folder = (): string => mkdtempSync(join(tmpdir(), "twincell-data-"));
async function server(data: string): Promise<Served> {
  const served = await serve({ studio, port: 0, version: "test", data, accounts: true });
  open.push(served);
  return served;
}
interface Answer {
  readonly status: number;
  readonly body: Record<string, unknown>;
  readonly cookie: string;
}
/** One request with the cookie of somebody, from an address of this machine. */
const ask = (
  served: Served,
  method: string,
  path: string,
  {
    cookie = "",
    body,
    from = "127.0.0.1",
  }: { readonly cookie?: string; readonly body?: unknown; readonly from?: string } = {},
): Promise<Answer> =>
  new Promise((resolve, reject) => {
    const { port } = new URL(served.url);
    const headers = {
      ...(cookie === "" ? {} : { cookie }),
      ...(body === undefined ? {} : { "content-type": "application/json" }),
    };
    const request = httpRequest({
      host: "127.0.0.1",
      port,
      method,
      path: `/api/v1${path}`,
      headers,
      localAddress: from,
    });
    request.on("response", response => {
      let text = "";
      response.on("data", part => (text += String(part)));
      response.on("end", () => {
        const [set = ""] = response.headers["set-cookie"] ?? [];
        resolve({
          status: response.statusCode ?? 0,
          body: JSON.parse(text) as Record<string, unknown>,
          cookie: set.split(";")[0]!,
        });
      });
    });
    request.on("error", reject);
    request.end(body === undefined ? undefined : JSON.stringify(body));
  });
const linkOf = (address: string): string => new URL(address).searchParams.get("invitation")!;
const PASSWORD = "correct horse";

/** The first admin, by the link of the first start. */
async function ada(served: Served): Promise<string> {
  const body = { link: linkOf(served.setUp!), name: "Ada", password: PASSWORD };
  const entered = await ask(served, "POST", "/invitation", { body });
  expect(entered).toMatchObject({ status: 200, body: { accounts: true, name: "Ada", role: "admin" } });
  return entered.cookie;
}
/** Somebody whom Ada invites. */
async function invited(
  served: Served,
  admin: string,
  name: string,
  person: { readonly role: string; readonly rights?: Record<string, string> },
): Promise<string> {
  const put = await ask(served, "PUT", `/people/${name}`, { cookie: admin, body: person });
  const body = { link: linkOf(String(put.body["link"])), password: PASSWORD };
  return (await ask(served, "POST", "/invitation", { body })).cookie;
}
const arm = { id: "arm", driver: "ur", model: "ur10e" };

test("the first start has a link that makes one admin, once; passwords are kept as argon2id and nothing that lets in is kept as it is; a second start knows the people and has no link", async () => {
  const data = folder();
  const served = await server(data);
  const link = linkOf(served.setUp!);
  expect(await ask(served, "GET", "/robots")).toMatchObject({ status: 401 });
  expect(await ask(served, "POST", "/invitation", { body: { link, name: "Ada", password: "short" } })).toMatchObject({
    status: 400,
    body: { why: { sentence: "A password has at least 10 characters." } },
  });
  const cookie = await ada(served);
  expect(await ask(served, "POST", "/invitation", { body: { link, name: "Eve", password: PASSWORD } })).toMatchObject({
    status: 401,
    body: { why: { sentence: "This link was used already, or has ended." } },
  });
  expect(await ask(served, "GET", "/robots", { cookie })).toMatchObject({ status: 200 });
  const kept = readFileSync(accountsFile(data), "utf8");
  expect(kept).toMatch(/"\$argon2id\$v=19\$m=19456,t=2,p=1\$[\w+/]{22}\$[\w+/]{43}"/);
  for (const secret of [link, PASSWORD, cookie.split("=")[1]!]) expect(kept).not.toContain(secret);
  expect(statSync(accountsFile(data)).mode & 0o077).toBe(0);
  await served.close();
  const again = await serve({ studio, port: 0, version: "test", data });
  open.push(again);
  expect(again.setUp).toBeNull();
  expect(await ask(again, "GET", "/robots", { cookie })).toMatchObject({ status: 401 });
  const signedIn = await ask(again, "POST", "/session", { body: { name: "Ada", password: PASSWORD } });
  expect(signedIn).toMatchObject({ status: 200, body: { name: "Ada", role: "admin" } });
  expect(await ask(again, "DELETE", "/session", { cookie: signedIn.cookie })).toMatchObject({ status: 200 });
  expect(await ask(again, "GET", "/robots", { cookie: signedIn.cookie })).toMatchObject({ status: 401 });
}, 60_000);

test("what each role may do is decided by the server, at a single robot by another role; the only admin stays one", async () => {
  const served = await server(folder());
  const admin = await ada(served);
  const vera = await invited(served, admin, "Vera", { role: "viewer", rights: { arm: "operator" } });
  const paul = await invited(served, admin, "Paul", { role: "programmer" });
  const otto = await invited(served, admin, "Otto", { role: "operator", rights: { secret: "viewer" } });
  const status = async (cookie: string, method: string, path: string, body?: unknown) =>
    (await ask(served, method, path, { cookie, ...(body === undefined ? {} : { body }) })).status;
  const program = emptyProgram("ur10e");
  expect(await status(vera, "PUT", "/programs/a", program)).toBe(403);
  expect(await status(paul, "PUT", "/programs/a", program)).toBe(200);
  expect(await status(otto, "PUT", "/programs/a", program)).toBe(403);
  expect(await status(paul, "POST", "/robots", arm)).toBe(403);
  expect(await status(otto, "POST", "/robots", arm)).toBe(200);
  expect(await status(otto, "POST", "/robots", { ...arm, id: "secret" })).toBe(200);
  expect(await status(paul, "POST", "/robots/arm/lease", {})).toBe(403);
  expect(await status(otto, "POST", "/robots/secret/lease", {})).toBe(403);
  expect(await status(vera, "POST", "/robots/secret/lease", {})).toBe(403);
  expect(await status(vera, "POST", "/robots/arm/lease", {})).toBe(200);
  for (const cookie of [vera, paul, otto, admin])
    expect(await status(cookie, "POST", "/robots/arm/stop", { emergency: true })).toBe(200);
  for (const cookie of [vera, paul, otto]) expect(await status(cookie, "GET", "/people")).toBe(403);
  expect(await status(otto, "PUT", "/people/Otto", { role: "admin" })).toBe(403);
  expect(await ask(served, "DELETE", "/people/Ada", { cookie: admin })).toMatchObject({
    status: 409,
    body: { why: { sentence: "Ada is the only admin." } },
  });
  expect(await status(admin, "PUT", "/people/Ada", { role: "viewer" })).toBe(409);
}, 60_000);

test("on the socket of the studio a viewer looks and stops, what commands is refused message by message, and whoever loses their account is sent away", async () => {
  const data = folder();
  const served = await server(data);
  const admin = await ada(served);
  expect(await ask(served, "POST", "/robots", { cookie: admin, body: arm })).toMatchObject({ status: 200 });
  const vera = await invited(served, admin, "Vera", { role: "viewer" });
  const url = new URL("/stations", served.url.replace(/^http/, "ws"));
  const without = new WebSocket(url);
  without.on("error", () => undefined);
  expect(await once(without, "unexpected-response").then(([, { statusCode }]) => statusCode as number)).toBe(403);
  const socket = new WebSocket(url, { headers: { cookie: vera } });
  open.push(socket);
  const answers = new Map<number, (outcome: unknown) => void>();
  socket.on("message", data => {
    const event = JSON.parse(String(data as Buffer)) as { type: string; id: number; outcome: unknown };
    if (event.type === "answer") answers.get(event.id)?.(event.outcome);
  });
  await once(socket, "open");
  let count = 0;
  const say = (request: object): Promise<unknown> =>
    new Promise(resolve => {
      const id = count++;
      answers.set(id, resolve);
      socket.send(JSON.stringify({ ...request, id }));
    });
  const station = "arm";
  const refused = {
    kind: "refused",
    why: { code: "people.role", sentence: "Vera (1) may look and stop, and not command." },
  };
  for (const request of [
    { type: "take", station },
    { type: "connect", station },
    { type: "move", station, q_rad: [0, 0, 0, 0, 0, 0] },
    { type: "open", station: "other", brand: "ur", robot: "ur10e" },
    { type: "pendant", station, act: { do: "servo", on: true } },
    { type: "together", members: [{ station, program: {}, asText: false }] },
    { type: "something-else", station },
  ])
    expect(await say(request), request.type).toMatchObject(refused);
  expect(await say({ type: "visit", station, on: true })).toEqual({ kind: "done" });
  socket.send(JSON.stringify({ type: "stop", station, emergency: true }));
  await say({ type: "visit", station, on: false });
  const lines = readAudit(readFileSync(auditFile(data), "utf8")).lines;
  expect(lines).toContainEqual(
    expect.objectContaining({ who: "Vera (1)", action: "presses the emergency stop", robot: "arm", outcome: "done" }),
  );
  expect(lines).toContainEqual(expect.objectContaining({ who: "Ada", action: "signs in", outcome: "done" }));
  expect(lines).toContainEqual(expect.objectContaining({ who: "Ada", action: "putPerson", outcome: "done" }));
  expect(await ask(served, "DELETE", "/people/Vera", { cookie: admin })).toMatchObject({ status: 200 });
  expect((await once(socket, "close"))[0]).toBe(4401);
}, 60_000);

/** An authenticator in software: one ES256 key, user verified (WebAuthn level 3, attestation “none”). */
function authenticator(origin: string) {
  const { privateKey, publicKey } = generateKeyPairSync("ec", { namedCurve: "P-256" });
  const { x = "", y = "" } = publicKey.export({ format: "jwk" });
  const id = randomBytes(16);
  const sha = (bytes: Uint8Array): Buffer => createHash("sha256").update(bytes).digest();
  let count = 0;
  const client = (type: string, challenge: string): Buffer => Buffer.from(JSON.stringify({ type, challenge, origin }));
  const data = (flags: number): Buffer => {
    const counter = Buffer.alloc(4);
    counter.writeUInt32BE(++count);
    return Buffer.concat([sha(Buffer.from(new URL(origin).hostname)), Buffer.from([flags]), counter]);
  };
  const credential = (response: object) => ({
    id: id.toString("base64url"),
    rawId: id.toString("base64url"),
    type: "public-key",
    clientExtensionResults: {},
    response,
  });
  const text = (bytes: Uint8Array): string => Buffer.from(bytes).toString("base64url");
  return {
    create(challenge: string) {
      const cose = Buffer.concat([
        Buffer.from("a5010203262001215820", "hex"),
        Buffer.from(x, "base64url"),
        Buffer.from("225820", "hex"),
        Buffer.from(y, "base64url"),
      ]);
      const authData = Buffer.concat([data(0x45), Buffer.alloc(16), Buffer.from([0, id.length]), id, cose]);
      const object = Buffer.concat([
        Buffer.from("a363666d74646e6f6e656761747453746d74a068617574684461746158", "hex"),
        Buffer.from([authData.length]),
        authData,
      ]);
      const clientDataJSON = text(client("webauthn.create", challenge));
      return credential({ clientDataJSON, attestationObject: text(object), transports: ["internal"] });
    },
    get(challenge: string) {
      const clientData = client("webauthn.get", challenge);
      const authenticatorData = data(0x05);
      const signature = sign("sha256", Buffer.concat([authenticatorData, sha(clientData)]), privateKey);
      return credential({
        clientDataJSON: text(clientData),
        authenticatorData: text(authenticatorData),
        signature: text(signature),
      });
    },
  };
}

test("a passkey is added by whoever is signed in and signs in without a password; one answer to a challenge is taken once, and one of another origin never", async () => {
  const served = await server(folder());
  const cookie = await ada(served);
  const origin = `http://127.0.0.1:${new URL(served.url).port}`;
  const key = authenticator(origin);
  const challenge = async (path: string, as = "") =>
    String((await ask(served, "POST", path, { cookie: as, body: {} })).body["challenge"]);
  const other = authenticator("http://elsewhere.example").create(await challenge("/passkeys/begin", cookie));
  expect(await ask(served, "POST", "/passkeys", { cookie, body: other })).toMatchObject({ status: 400 });
  const made = key.create(await challenge("/passkeys/begin", cookie));
  expect(await ask(served, "POST", "/passkeys", { cookie, body: made })).toMatchObject({ status: 200 });
  const given = key.get(await challenge("/session/passkey/begin"));
  const entered = await ask(served, "POST", "/session/passkey", { body: given });
  expect(entered).toMatchObject({ status: 200, body: { name: "Ada", role: "admin", passkeys: 1 } });
  expect(await ask(served, "GET", "/people", { cookie: entered.cookie })).toMatchObject({ status: 200 });
  expect(await ask(served, "POST", "/session/passkey", { body: given })).toMatchObject({ status: 401 });
  const unknown = authenticator(origin).get(await challenge("/session/passkey/begin"));
  expect(await ask(served, "POST", "/session/passkey", { body: unknown })).toMatchObject({ status: 401 });
}, 60_000);

test("ten wrong passwords of one address make that address wait and nobody else; a wrong name takes as long as a wrong password and says the same", async () => {
  const served = await server(folder());
  await ada(served);
  const wrong = { name: "Ada", password: "wrong password" };
  for (let i = 0; i < 10; i++)
    expect(
      await ask(served, "POST", "/session", {
        body: i % 2 === 0 ? wrong : { ...wrong, name: "Nobody" },
        from: "127.0.0.2",
      }),
    ).toMatchObject({
      status: 401,
      body: { why: { sentence: "Name and password do not belong together." } },
    });
  const right = { name: "Ada", password: PASSWORD };
  expect(await ask(served, "POST", "/session", { body: right, from: "127.0.0.2" })).toMatchObject({ status: 429 });
  expect(await ask(served, "POST", "/session", { body: right, from: "127.0.0.3" })).toMatchObject({ status: 200 });
}, 60_000);

test("accounts that cannot be read or are of a later release let nobody in and are said; without a data folder there are none", async () => {
  const data = folder();
  writeFileSync(accountsFile(data), "{ half");
  await expect(serve({ studio, port: 0, version: "test", data })).rejects.toThrow("is no list of accounts");
  writeFileSync(accountsFile(data), JSON.stringify({ format: "twincell.accounts", version: 2, people: [] }));
  await expect(serve({ studio, port: 0, version: "test", data })).rejects.toThrow(
    "it is of version 2, this release reads version 1",
  );
  await expect(serve({ studio, port: 0, version: "test", accounts: true })).rejects.toThrow(
    "Accounts are kept in a data folder.",
  );
});
