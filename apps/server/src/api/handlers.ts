import { createReadStream } from "node:fs";
import { readdir, stat } from "node:fs/promises";
import { join } from "node:path";
import { ALL_DRIVER_KINDS } from "@twincell/controllers";
import { catalogueRobots, isSlide, LIBRARY, type CommandOutcome, type Scheduler } from "@twincell/core";
import { DIALECTS } from "@twincell/languages";
import {
  API_VERSION,
  asyncApiDocument,
  openApiDocument,
  PROTOCOL,
  nameSchema,
  type ApiRouteId,
  type Request,
  type RobotServer,
  type ServedConnection,
} from "@twincell/protocol";
import type { Fleet } from "../fleet/fleet.ts";
import { json, outcomeAnswer, refusal, type Answer, type Call, type Handlers } from "./calls.ts";
import type { DocumentFolder } from "./documents.ts";
import type { SharedCells } from "../editing/shared-cells.ts";
import { addCellLink, removeCellLinks } from "../people/tokens.ts";
import type { Judge, JudgeRequest } from "./judge.ts";
import { metricsText, type RequestCounts } from "./metrics.ts";
import { peopleHandlers, withoutPeople, type PeopleParts } from "../people/people-host.ts";
import { apiPage } from "./page.ts";
import type { ApiRobots } from "./robots.ts";

export interface ApiParts {
  readonly version: string;
  readonly host: RobotServer;
  readonly robots: ApiRobots;
  readonly judge: Judge;
  readonly scheduler: Scheduler;
  readonly data: string | undefined;
  readonly programs: DocumentFolder;
  readonly cells: DocumentFolder;
  /** The cells that people edit together. */
  readonly shared: SharedCells;
  readonly now_ms: () => number;
  /** Where other machines reach this server; "" where none does. */
  readonly reached: () => string;
  readonly requests: RequestCounts;
  /** The server reaches no real robot. */
  readonly training: boolean;
  /** Whether requests are still taken. */
  readonly ready: () => boolean;
  readonly linkOf: (cookies: string | undefined) => string | null;
  /** Null where nobody signs in by name. */
  readonly people: PeopleParts | null;
  readonly fleet: () => Fleet;
}

/** A motion that is asked for through a cluster is answered within this time, or asked for again by its id [ms]. */
const FLEET_PATIENCE_MS = 120_000;
const noRobot = (id: string): Answer =>
  json(refusal("robot.none", `There is no robot “${id}”.`, "GET /api/v1/robots lists those that are open."), 404);
const wordsOf = ({ words }: ServedConnection) => ({
  id: words.id,
  name: words.name,
  driver: words.brand,
  model: words.robot,
  virtual: words.virtual,
  watchdog: words.watchdog,
});

/** What each route of the API does. */
export function apiHandlers(parts: ApiParts): Handlers {
  const { host, robots, version } = parts;
  const began_s = parts.scheduler.now_s();
  const openapi = openApiDocument(version);
  const asyncapi = asyncApiDocument(version);
  return {
    apiPage: () => ({ kind: "text", text: apiPage(version), type: "text/html; charset=utf-8" }),
    openapi: () => json(openapi),
    asyncapi: () => json(asyncapi),
    healthz: () => ({ kind: "text", text: "ok\n", type: "text/plain; charset=utf-8" }),
    readyz: () =>
      json(
        {
          ready: parts.ready(),
          robots: host.stations.length,
          connected: host.stations.filter(({ link }) => link?.state === "open").length,
        },
        parts.ready() ? 200 : 503,
      ),
    metrics: () => ({
      kind: "text",
      text: metricsText(host, robots, parts.requests, parts.scheduler.now_s() - began_s),
      type: "text/plain; version=0.0.4; charset=utf-8",
    }),
    about: () =>
      json({
        name: "twincell",
        version,
        api: API_VERSION,
        protocol: PROTOCOL,
        openapi: "/api/openapi.json",
        asyncapi: "/api/asyncapi.json",
      }),
    models: () => json({ models: models() }),
    drivers: () =>
      json({
        drivers: ALL_DRIVER_KINDS.map(({ id, name, vendor, dialect, ports }) => ({ id, name, vendor, dialect, ports })),
      }),
    languages: () => json({ languages: DIALECTS.map(({ id, name, brand }) => ({ id, name, vendor: brand })) }),
    fleet: () => json({ robots: parts.fleet().robots() }),
    fleetCommand: async ({ params, body }) =>
      outcomeAnswer(await parts.fleet().command(params["site"]!, body, FLEET_PATIENCE_MS)),
    ...(parts.people ? peopleHandlers(parts.people) : withoutPeople(parts.training, parts.linkOf)),
    ...robotHandlers(parts),
    ...judgeHandlers(parts.judge),
    ...documentHandlers(parts),
    ...linkHandlers(parts),
    ...recordingHandlers(parts.data === undefined ? undefined : join(parts.data, "recordings")),
  };
}
/** Asked for at each call: the catalogue is added by whoever starts the server. */
const models = () =>
  [...LIBRARY, ...catalogueRobots()].map(robot => ({
    id: robot.id,
    name: robot.name,
    vendor: robot.vendor,
    joints: robot.arm.joints.map(joint => ({
      name: joint.name,
      slides: isSlide(joint),
      lower_rad: joint.limits.lower_rad,
      upper_rad: joint.limits.upper_rad,
      speed_rad_s: joint.limits.speed_rad_s,
    })),
    home_rad: Array.from(robot.home_rad),
    payload_kg: robot.payload_kg ?? null,
    reach_m: robot.reach_m,
  }));

type RobotRoutes =
  | "listRobots"
  | "openRobot"
  | "closeRobot"
  | "robotState"
  | "takeLease"
  | "giveLease"
  | "connect"
  | "disconnect"
  | "confirm"
  | "reset"
  | "speed"
  | "move"
  | "run"
  | "produce"
  | "replaceProgram"
  | "holdProduction"
  | "resumeProduction"
  | "stepProduction"
  | "setBreakpoints"
  | "setCell"
  | "stop"
  | "stopAll";

function robotHandlers({ host, robots }: ApiParts): Pick<Handlers, RobotRoutes> {
  /** With the lease that the request names. */
  const leased = async (call: Call<ApiRouteId>, request: Request): Promise<Answer> => {
    const id = call.params["id"]!;
    if (!robots.find(id)) return noRobot(id);
    return outcomeAnswer(await robots.command(call.lease, id, request));
  };
  /** As `leased`, and whoever goes before the motion has ended stops it. */
  const motion = async (call: Call<ApiRouteId>, request: Request): Promise<Answer> => {
    const id = call.params["id"]!;
    const robot = robots.find(id);
    if (!robot) return noRobot(id);
    if (call.remote && !robot.words.virtual)
      return outcomeAnswer(
        refusal(
          "motion.remote",
          `${robot.words.name} is a real robot and this request comes from another machine, whose loss would not be noticed within 80 ms.`,
          "Command it over the socket /stations with signs of life, or from this machine.",
        ),
      );
    return outcomeAnswer(await robots.command(call.lease, id, request, call.onGone));
  };
  /** Without a lease where nobody has one. */
  const unlessTaken = async (call: Call<ApiRouteId>, request: Request): Promise<Answer> => {
    const id = call.params["id"]!;
    const robot = robots.find(id);
    if (!robot) return noRobot(id);
    if (robots.holds(call.lease, id)) return outcomeAnswer(await robots.command(call.lease, id, request));
    const { holder } = robot.guard.state;
    if (holder !== null)
      return outcomeAnswer(
        refusal(
          "guard.lease-taken",
          `${robot.words.name} is commanded by ${holder}.`,
          "Wait until the lease is given back. Anyone may stop the robot.",
        ),
      );
    return outcomeAnswer(await robots.ask(call.who, request));
  };
  return {
    listRobots: () => json({ robots: host.stations.map(wordsOf) }),
    async openRobot(call) {
      const { id, driver, model, ...rest } = call.body;
      return outcomeAnswer(
        await robots.ask(call.who, { type: "open", station: id, brand: driver, robot: model, ...opened(rest) }),
      );
    },
    closeRobot: call => unlessTaken(call, { type: "close", station: call.params["id"]! }),
    robotState(call) {
      const id = call.params["id"]!;
      const robot = robots.find(id);
      return robot ? json({ robot: wordsOf(robot), ...robots.state(id) }) : noRobot(id);
    },
    async takeLease(call) {
      const id = call.params["id"]!;
      if (!robots.find(id)) return noRobot(id);
      const { who: said = call.who, expires_s: ends_s } = call.body;
      // Whoever has a token commands under its name.
      const taken = await robots.take(id, call.named && said !== call.who ? `${said} of ${call.who}` : said, ends_s);
      if ("kind" in taken) return outcomeAnswer(taken);
      const { token, robot, who, expires_s } = taken;
      return json({ lease: token, robot, who, expires_s });
    },
    async giveLease(call) {
      const id = call.params["id"]!;
      if (!robots.find(id)) return noRobot(id);
      return outcomeAnswer(await robots.give(robots.holds(call.lease, id) ? call.lease : ""));
    },
    connect: call => leased(call, { type: "connect", station: call.params["id"]! }),
    disconnect: call => leased(call, { type: "disconnect", station: call.params["id"]! }),
    confirm: call => leased(call, { type: "confirm", station: call.params["id"]! }),
    reset: call => leased(call, { type: "reset", station: call.params["id"]! }),
    speed: call => leased(call, { type: "speed", station: call.params["id"]!, percent: call.body.percent }),
    move: call => motion(call, { type: "move", station: call.params["id"]!, q_rad: call.body.q_rad }),
    run: call =>
      motion(call, {
        type: "run",
        station: call.params["id"]!,
        program: call.body.program,
        asText: call.body.asText,
        ...(call.body.despite ? { despite: call.body.despite } : {}),
      }),
    ...productionHandlers({ robots, leased, motion }),
    setCell: call => unlessTaken(call, { type: "cell", station: call.params["id"]!, cell: call.body.cell }),
    stop(call) {
      const id = call.params["id"]!;
      if (!robots.find(id)) return noRobot(id);
      robots.stop(call.who, id, call.body.emergency);
      return json({ kind: "done" });
    },
    stopAll(call) {
      robots.stop(call.who, undefined, call.body.emergency);
      return json({ kind: "done" });
    },
  };
}
type Commanded = (call: Call<ApiRouteId>, request: Request) => Promise<Answer>;
type ProductionRoutes = Extract<RobotRoutes, `${string}Production` | "produce" | "replaceProgram" | "setBreakpoints">;
/** Programs that run cycle after cycle: another one while they run, held, by hand, handed back, step by step. */
function productionHandlers({
  robots,
  leased,
  motion,
}: {
  readonly robots: ApiRobots;
  readonly leased: Commanded;
  readonly motion: Commanded;
}): Pick<Handlers, ProductionRoutes> {
  const order = ({ program, asText, despite }: Call<"replaceProgram">["body"]) => ({
    program,
    asText,
    ...(despite ? { despite } : {}),
  });
  return {
    produce: call =>
      motion(call, {
        type: "produce",
        station: call.params["id"]!,
        ...order(call.body),
        cycles: call.body.cycles,
        breakpoints: call.body.breakpoints,
        stepping: call.body.stepping,
      }),
    replaceProgram: call => leased(call, { type: "replace", station: call.params["id"]!, ...order(call.body) }),
    async holdProduction(call) {
      const id = call.params["id"]!;
      if (!robots.find(id)) return noRobot(id);
      return outcomeAnswer(await robots.ask(call.who, { type: "intervene", station: id }));
    },
    resumeProduction: call => leased(call, { type: "resume", station: call.params["id"]!, from: call.body.from }),
    stepProduction: call => leased(call, { type: "single-step", station: call.params["id"]! }),
    setBreakpoints: call => leased(call, { type: "breakpoints", station: call.params["id"]!, steps: call.body.steps }),
  };
}

/** A pose that came by JSON, as the pose of the base in the world. */
function opened({
  worldFromBase,
  ...rest
}: Omit<Call<"openRobot">["body"], "id" | "driver" | "model">): Partial<Extract<Request, { readonly type: "open" }>> {
  type Open = Extract<Request, { readonly type: "open" }>;
  return { ...rest, ...(worldFromBase ? { worldFromBase: worldFromBase as NonNullable<Open["worldFromBase"]> } : {}) };
}

function judgeHandlers(judge: Judge): Pick<Handlers, "check" | "plan" | "writeText"> {
  const ask = async (request: JudgeRequest): Promise<Answer> => {
    const judged = await judge.ask(request);
    return judged.kind === "done" ? json(judged.answer) : outcomeAnswer(judged);
  };
  return {
    check: ({ body }) => ask({ kind: "check", ...body }),
    plan: ({ body }) => ask({ kind: "plan", ...body }),
    writeText: ({ body }) => ask({ kind: "write", ...body }),
  };
}

type DocumentRoutes = `${"list" | "get" | "put" | "delete"}_${"program" | "cell"}`;
function documentHandlers({
  programs,
  cells,
  shared,
}: Pick<ApiParts, "programs" | "cells" | "shared">): Pick<Handlers, DocumentRoutes> {
  const notFound = (outcome: CommandOutcome): Answer =>
    outcome.kind === "refused" && outcome.why.code === "documents.none" ? json(outcome, 404) : outcomeAnswer(outcome);
  const badName = (name: string): Answer | null =>
    nameSchema.safeParse(name).success
      ? null
      : json(
          refusal(
            "documents.name",
            `“${name}” is no name of a document.`,
            "Use letters, digits, “_”, “-” and “.”, at most 80, the first no dot.",
          ),
          400,
        );
  const get = async (folder: DocumentFolder, name: string): Promise<Answer> => {
    const bad = badName(name);
    if (bad) return bad;
    const found = await folder.get(name);
    return "document" in found ? json(found.document) : notFound(found);
  };
  const put = async (folder: DocumentFolder, name: string, document: unknown): Promise<Answer> =>
    badName(name) ?? outcomeAnswer(await folder.put(name, document));
  const remove = async (folder: DocumentFolder, name: string): Promise<Answer> =>
    badName(name) ?? notFound(await folder.delete(name));
  const list = async (folder: DocumentFolder): Promise<Answer> => json({ names: await folder.list() });
  return {
    list_program: () => list(programs),
    get_program: ({ params }) => get(programs, params["name"]!),
    put_program: ({ params, body }) => put(programs, params["name"]!, body),
    delete_program: ({ params }) => remove(programs, params["name"]!),
    list_cell: () => list(cells),
    get_cell: ({ params }) => get(cells, params["name"]!),
    // Whoever edits the cell at this moment gets what was written as a change of it.
    put_cell: async ({ params, body }) => {
      const answer = await put(cells, params["name"]!, body);
      if (isDone(answer)) shared.written(params["name"]!, body);
      return answer;
    },
    delete_cell: async ({ params }) => {
      const answer = await remove(cells, params["name"]!);
      if (isDone(answer)) await shared.removed(params["name"]!);
      return answer;
    },
  };
}
const isDone = (answer: Answer): boolean => answer.kind === "json" && (answer.status ?? 200) === 200;

/** A read-only link ends after so many days. */
const LINK_MS = 30 * 86_400_000;
function linkHandlers({
  cells,
  data,
  now_ms,
  reached,
}: Pick<ApiParts, "cells" | "data" | "now_ms" | "reached">): Pick<Handlers, "linkCell" | "unlinkCell"> {
  return {
    async linkCell({ params, origin }) {
      const name = params["name"]!;
      const found = await cells.get(name);
      if (data === undefined || !("document" in found))
        return "document" in found ? outcomeAnswer({ kind: "done" }) : json(found, 404);
      const until = new Date(now_ms() + LINK_MS);
      const token = addCellLink(data, name, until);
      return json({ link: `${reached() || `${origin}/`}?link=${token}`, until: until.toISOString() });
    },
    unlinkCell: ({ params }) =>
      data !== undefined && removeCellLinks(data, params["name"]!)
        ? json({ kind: "done" })
        : json(refusal("cells.no-link", "There is no link to this cell.", "POST makes one."), 404),
  };
}

function recordingHandlers(folder: string | undefined): Pick<Handlers, "listRecordings" | "getRecording"> {
  const listed = async (path: string): Promise<readonly string[]> => {
    try {
      return await readdir(path);
    } catch (problem) {
      if ((problem as NodeJS.ErrnoException).code === "ENOENT") return [];
      throw problem;
    }
  };
  const all = async () => {
    if (folder === undefined) return [];
    const found: { readonly robot: string; readonly file: string; readonly bytes: number }[] = [];
    for (const robot of (await listed(folder)).toSorted())
      for (const file of (await listed(join(folder, robot))).filter(name => name.endsWith(".mcap")).toSorted())
        found.push({ robot, file, bytes: (await stat(join(folder, robot, file))).size });
    return found;
  };
  return {
    listRecordings: async () => json({ recordings: await all() }),
    async getRecording({ params }) {
      // Only what the list says: no path of a request is ever joined to the folder.
      const found = (await all()).find(({ robot, file }) => robot === params["robot"] && file === params["file"]);
      if (!found || found.bytes === 0)
        return json(
          refusal("recordings.none", "There is no such recording.", "GET /api/v1/recordings lists them."),
          404,
        );
      // A file that is still written may grow while it is read: only what was there is sent.
      const parts = createReadStream(join(folder!, found.robot, found.file), { end: found.bytes - 1 });
      return { kind: "bytes", parts, length: found.bytes, name: found.file };
    },
  };
}
