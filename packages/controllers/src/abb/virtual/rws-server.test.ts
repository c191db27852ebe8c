import { manualScheduler, robotById, seededRandom } from "@twincell/core";
import { describe, expect, test } from "vitest";
import {
  authorization,
  latin1Bytes,
  latin1Text,
  readChallenge,
  ResponseReader,
  fieldOf,
  type HttpResponse,
} from "../../http/index.ts";
import { memoryNetwork, type ByteStream } from "../../transport/index.ts";
import { createVirtualAbb } from "./index.ts";

const HOST = "127.0.0.1";
const PORT = 80;
const robot = robotById("abb_irb120")!;
const LOGIN = { user: "Default User", password: "robotics" };

async function bench() {
  const scheduler = manualScheduler();
  const network = memoryNetwork(scheduler);
  const log: string[] = [];
  const started = await createVirtualAbb({
    robot,
    scheduler,
    network,
    host: HOST,
    rws: PORT,
    sensor: { host: HOST, port: 9 },
    log: line => {
      log.push(line);
    },
  });
  if (started.kind === "taken") throw new Error(started.sentence);
  async function connected(): Promise<{
    readonly stream: ByteStream;
    readonly ended: () => boolean;
    say(text: string): Promise<HttpResponse[]>;
  }> {
    const connecting = network.connect({ host: HOST, port: PORT });
    await scheduler.elapse(0.002);
    const answer = await connecting;
    if (answer.kind === "refused") throw new Error(answer.sentence);
    const { stream } = answer;
    const reader = new ResponseReader();
    const all: HttpResponse[] = [];
    let over = false;
    stream.onEnd(() => {
      over = true;
    });
    stream.onBytes(lent => {
      if (
        reader.push(lent, response => {
          all.push(response);
          return true;
        }) !== null
      )
        throw new Error("The answer is no HTTP.");
    });
    return {
      stream,
      ended: () => over,
      async say(text) {
        stream.send(latin1Bytes(text));
        await scheduler.elapse(0.003);
        return all.splice(0);
      },
    };
  }
  /** One who is logged in, with a session of his own. */
  async function client() {
    const line = await connected();
    const [first] = await line.say("GET /rw?json=1 HTTP/1.1\r\n\r\n");
    const challenge = readChallenge(fieldOf(first!, "www-authenticate"))!;
    let cookie = "";
    let times = 0;
    const ask = async (
      method: string,
      target: string,
      body = "",
    ): Promise<{ status: number; text: string; json: Record<string, unknown> }> => {
      const [answer] = await line.say(
        `${method} ${target} HTTP/1.1\r\nAuthorization: ${authorization(LOGIN, challenge, method, target, ++times, "own")}\r\n${cookie === "" ? "" : `Cookie: ${cookie}\r\n`}Content-Length: ${body.length}\r\n\r\n${body}`,
      );
      const set = answer!.fields.filter(([name]) => name === "set-cookie").map(([, value]) => value.split(";")[0]!);
      if (set.length > 0) cookie = set.join("; ");
      const text = latin1Text(answer!.body);
      return {
        status: answer!.status,
        text,
        json: text.startsWith("{") ? (JSON.parse(text) as Record<string, unknown>) : {},
      };
    };
    const state = async (target: string) =>
      (
        (await ask("GET", `${target}${target.includes("?") ? "&" : "?"}json=1`)).json["_embedded"] as {
          _state: Record<string, unknown>[];
        }
      )._state;
    return { ask, state, line, post: async (target: string, body: string) => (await ask("POST", target, body)).status };
  }
  return { scheduler, network, log, virtual: started.controller, connected, client };
}

describe("Robot Web Services of the virtual controller", () => {
  test("ask for a digest, begin a session with two cookies, and tell a state in the words of the services", async () => {
    const { client, connected } = await bench();
    const stranger = await connected();
    const [refused] = await stranger.say(
      "GET /rw/panel/ctrlstate?json=1 HTTP/1.1\r\nAuthorization: Basic YTpi\r\n\r\n",
    );
    expect([refused!.status, fieldOf(refused!, "www-authenticate")]).toEqual([
      401,
      expect.stringMatching(/^Digest realm="validusers@robapi\.abb", .*qop="auth"/),
    ]);
    const { ask, line } = await client();
    const first = await ask("GET", "/rw/panel/ctrlstate?json=1");
    expect(first.json).toEqual({
      _links: { base: { href: "http://127.0.0.1/rw/panel/ctrlstate" } },
      _embedded: { _state: [{ _type: "pnl-ctrlstate", _title: "ctrlstate", ctrlstate: "motoron" }] },
    });
    expect((await ask("GET", "/rw/panel/opmode")).text).toContain(
      '<li class="pnl-opmode" title="opmode"><span class="opmode">AUTO</span></li>',
    );
    expect((await ask("GET", "/rw/nothing?json=1")).json).toEqual({
      _links: { base: { href: "/" } },
      _embedded: { status: { code: -1073445859, msg: "There is no resource rw/nothing." } },
    });
    expect(line.ended()).toBe(false);
  });

  test("motors, speed, execution, tasks, angles and the place of the tool", async () => {
    const { client, virtual, scheduler } = await bench();
    const { state, post } = await client();
    expect(await post("/rw/panel/speedratio?action=setspeedratio", "speed-ratio=25")).toBe(204);
    expect(await state("/rw/panel/speedratio")).toMatchObject([{ _type: "pnl-speedratio", speedratio: "25" }]);
    expect(await post("/rw/panel/speedratio?action=setspeedratio", "speed-ratio=101")).toBe(400);
    expect(await state("/rw/rapid/execution")).toMatchObject([{ ctrlexecstate: "running", cycle: "forever" }]);
    expect(await post("/rw/rapid/execution?action=start", "cycle=once")).toBe(403);
    expect(await post("/rw/rapid/execution?action=stop", "stopmode=stop")).toBe(204);
    expect(await state("/rw/rapid/tasks")).toMatchObject([
      { _type: "rap-task-li", name: "T_ROB1", type: "norm", excstate: "stop", active: "On", motiontask: "TRUE" },
    ]);
    expect([
      await post("/rw/rapid/execution?action=resetpp", ""),
      await post("/rw/rapid/execution?action=start", "cycle=once"),
    ]).toEqual([204, 204]);
    expect(await post("/rw/panel/ctrlstate?action=setctrlstate", "ctrl-state=motoroff")).toBe(204);
    expect(await state("/rw/panel/ctrlstate")).toMatchObject([{ ctrlstate: "motoroff" }]);
    virtual.pendant.emergencyStop(true);
    expect(await state("/rw/panel/ctrlstate")).toMatchObject([{ ctrlstate: "emergencystop" }]);
    expect(await post("/rw/panel/ctrlstate?action=setctrlstate", "ctrl-state=motoron")).toBe(403);
    virtual.pendant.emergencyStop(false);
    expect(await state("/rw/panel/ctrlstate")).toMatchObject([{ ctrlstate: "emergencystopreset" }]);
    expect(await post("/rw/panel/ctrlstate?action=setctrlstate", "ctrl-state=motoron")).toBe(204);
    await scheduler.elapse(0.1);
    const [joints] = await state("/rw/motionsystem/mechunits/ROB_1/jointtarget");
    const [place] = await state("/rw/motionsystem/mechunits/ROB_1/robtarget?tool=tool0&wobj=wobj0&coordinate=Base");
    expect(joints).toMatchObject({ _type: "ms-jointtarget", eax_a: "9000000000" });
    expect(Number(joints!["rax_2"])).toBeCloseTo((robot.home_rad[1]! * 180) / Math.PI, 9);
    expect(place).toMatchObject({ _type: "ms-robtargets", cf1: "0" });
    expect(Math.hypot(...["q1", "q2", "q3", "q4"].map(name => Number(place![name])))).toBeCloseTo(1, 9);
    const events = await state("/rw/elog/0?lang=en");
    expect(events[0]).toMatchObject({
      _title: expect.stringMatching(/^\/rw\/elog\/0\/[0-9]+$/) as string,
      code: "10011",
      msgtype: "1",
      tstamp: "2026-01-01 T  00:00:00",
      argc: "0",
    });
  });

  test("signals, files, modules and their data", async () => {
    const { client, virtual } = await bench();
    const { state, post, ask } = await client();
    expect(await post("/rw/iosystem/signals/Local/DRV_1/DO3?action=set", "lvalue=1")).toBe(204);
    expect([virtual.neutral.signals.read("DO3"), await state("/rw/iosystem/signals/do3")]).toEqual([
      true,
      [expect.objectContaining({ _type: "ios-signal", name: "DO3", lvalue: "1" })],
    ]);
    expect([
      await post("/rw/iosystem/signals/DI1?action=set", "lvalue=1"),
      await post("/rw/iosystem/signals/DO3?action=set", "lvalue=2"),
      await post("/rw/iosystem/signals/none?action=set", "lvalue=1"),
    ]).toEqual([403, 403, 404]);
    const text =
      "MODULE data\n  PERS num count:=3;\n  CONST num most:=9;\n  PERS string name;\n  PROC other()\n    count:=count+1;\n  ENDPROC\nENDMODULE\n";
    expect([
      (await ask("PUT", "/fileservice/$home/my%20data.mod", text)).status,
      (await ask("PUT", "/fileservice/$HOME/my%20data.mod", text)).status,
    ]).toEqual([201, 200]);
    expect((await ask("GET", "/fileservice/HOME:/my%20data.mod")).text).toBe(text);
    expect((await state("/fileservice/$home")).map(each => each["_title"])).toEqual(["TwincellEGM.mod", "my data.mod"]);
    for (const wrong of ["/fileservice/$home/..%2Fa", "/fileservice/C:/a", "/fileservice/$home/a%00b"])
      expect((await ask("PUT", wrong, "x")).status).toBe(404);
    const load = (more: string): Promise<number> =>
      post("/rw/rapid/tasks/T_ROB1?action=loadmod", `modulepath=$HOME%2Fmy%20data.mod${more}`);
    expect(await load("")).toBe(403);
    await post("/rw/rapid/execution?action=stop", "");
    expect([await load(""), await load(""), await load("&replace=true")]).toEqual([204, 403, 204]);
    const at = "/rw/rapid/symbol/data/RAPID/T_ROB1/data";
    expect(await state(`${at}/count`)).toMatchObject([{ _type: "rap-data", value: "3" }]);
    expect([
      await post(`${at}/count?action=set`, "value=12.5"),
      await post(`${at}/most?action=set`, "value=1"),
      await post(`${at}/count?action=set`, "value=1;%20Stop"),
      await post(`${at}/name?action=set`, "value=%22x%22"),
    ]).toEqual([204, 403, 400, 204]);
    expect([await state("/rw/rapid/symbol/data/RAPID/T_ROB1/count"), await state(`${at}/name`)]).toMatchObject([
      [{ value: "12.5" }],
      [{ value: '"x"' }],
    ]);
    expect([
      await post("/rw/rapid/tasks/T_ROB1?action=unloadmod", "module=data"),
      (await ask("DELETE", "/fileservice/$home/my%20data.mod")).status,
      (await ask("GET", `${at}/count`)).status,
    ]).toEqual([204, 204, 404]);
  });

  test("one client at a time has the mastership; in manual mode a person at the pendant gives leave", async () => {
    const { client, virtual } = await bench();
    const one = await client();
    const two = await client();
    expect([
      await one.post("/rw/mastership/rapid?action=request", ""),
      await two.post("/rw/mastership/rapid?action=request", ""),
    ]).toEqual([204, 403]);
    expect([
      await two.post("/rw/rapid/execution?action=stop", ""),
      await two.post("/rw/rapid/execution?action=resetpp", ""),
      await one.post("/rw/rapid/execution?action=resetpp", ""),
    ]).toEqual([204, 403, 204]);
    expect([
      await one.post("/rw/mastership?action=release", ""),
      await two.post("/rw/rapid/execution?action=start", ""),
    ]).toEqual([204, 204]);
    virtual.pendant.setMode("manual");
    const set = (): Promise<number> => one.post("/rw/iosystem/signals/DO1?action=set", "lvalue=1");
    expect(await set()).toBe(403);
    expect([await one.post("/users/rmmp", "privilege=modify"), await one.state("/users/rmmp/poll")]).toMatchObject([
      202,
      [{ _type: "user-rmmp-poll", status: "PENDING" }],
    ]);
    virtual.pendant.grantRemote(true);
    expect([await set(), await one.post("/rw/rapid/execution?action=start", "")]).toEqual([204, 403]);
    // Anyone may stop.
    expect(await two.post("/rw/panel/ctrlstate?action=setctrlstate", "ctrl-state=motoroff")).toBe(204);
  });

  test("seventy sessions, then 503 until one logs out or sleeps; 400 requests on a connection", async () => {
    const { client, scheduler } = await bench();
    const one = await client();
    await one.ask("GET", "/rw/panel/opmode");
    for (let i = 1; i < 70; i++) await (await client()).ask("GET", "/rw/panel/opmode");
    const late = await client();
    expect((await late.ask("GET", "/rw/panel/opmode")).status).toBe(503);
    expect((await one.ask("GET", "/logout")).status).toBe(200);
    expect((await late.ask("GET", "/rw/panel/opmode")).status).toBe(200);
    await scheduler.elapse(301);
    expect((await (await client()).ask("GET", "/rw/panel/opmode")).status).toBe(200);
    const busy = await client();
    for (let i = 0; i < 398; i++) await busy.ask("GET", "/rw/panel/opmode");
    expect(busy.line.ended()).toBe(false);
    await busy.ask("GET", "/rw/panel/opmode");
    expect(busy.line.ended()).toBe(true);
  }, 60_000);

  test("any bytes: no crash, logged once, the connection reset, and whoever speaks HTTP is still answered", async () => {
    const { connected, client, log, scheduler } = await bench();
    const random = seededRandom(11);
    for (let round = 0; round < 300; round++) {
      const line = await connected();
      const bytes = Uint8Array.from({ length: 1 + Math.floor(random() * 300) }, () => Math.floor(random() * 256));
      if (random() < 0.5) bytes.set(latin1Bytes("POST /x HTTP/1.1\r\n").subarray(0, bytes.length));
      line.stream.send(bytes);
      line.stream.send(latin1Bytes("\r\n\r\n"));
      await scheduler.elapse(0.002);
      line.stream.close();
    }
    const garbage = await connected();
    await garbage.say("\u0001\u0002\r\n\r\n");
    expect(garbage.ended()).toBe(true);
    expect(log.length).toBeGreaterThan(0);
    expect(new Set(log).size).toBe(log.length);
    expect(log.every(line => line.endsWith("The connection is reset."))).toBe(true);
    const { ask } = await client();
    // Targets and bodies that are HTTP and nothing else.
    for (let round = 0; round < 300; round++) {
      const parts = [
        "rw",
        "rapid",
        "tasks",
        "T_ROB1",
        "fileservice",
        "$home",
        "symbol",
        "data",
        "RAPID",
        "iosystem",
        "signals",
        "panel",
        "ctrlstate",
        "mastership",
        "users",
        "ctrl",
        "..",
        "%00",
        "%FF",
      ];
      const target = `/${Array.from({ length: Math.floor(random() * 6) }, () => parts[Math.floor(random() * parts.length)]!).join("/")}${random() < 0.5 ? "?action=set" : "?json=1"}`;
      const body = Array.from({ length: Math.floor(random() * 40) }, () =>
        String.fromCharCode(32 + Math.floor(random() * 90)),
      ).join("");
      expect(
        (await ask(["GET", "POST", "PUT", "DELETE", "PATCH"][Math.floor(random() * 5)]!, target, body)).status,
      ).toBeGreaterThanOrEqual(200);
    }
    expect((await ask("GET", "/rw/panel/opmode?json=1")).status).toBe(200);
  }, 60_000);
});
