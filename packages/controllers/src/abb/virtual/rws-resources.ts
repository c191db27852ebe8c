import { axesOfJoints, flangePose, type Robot, type AxisCounting } from "@twincell/core";
import { latin1Text, readForm, readTarget, type HttpRequest } from "../../http/index.ts";
import { EXTERNAL_AXES, NO_AXIS, ROBOT_AXES, RWS_CODE, TASK, UNIT, type RwsState } from "../codec/index.ts";
import type { VirtualPendant } from "./cabinet.ts";
import { eventStates } from "./events.ts";
import { Files, FOLDERS } from "./files.ts";
import type { Line, Lines } from "./lines.ts";
import type { Programs } from "./programs.ts";
import { DOMAINS, type Domain, type Session, type Sessions } from "./sessions.ts";
import { dataOf, withValue } from "./symbols.ts";
import { abbAxes } from "../codec/axes.ts";

/** What the resources tell of. */
export interface ResourceOptions {
  readonly robot: Robot;
  readonly model: string;
  readonly q_rad: () => ArrayLike<number>;
  readonly cabinet: VirtualPendant;
  readonly programs: Programs;
  readonly files: Files;
  readonly lines: Lines;
}
/** What is said to a request: states, a file, a refusal in words, or nothing more than a status. */
export interface Answer {
  readonly status: number;
  readonly states?: readonly RwsState[];
  readonly file?: Uint8Array;
  readonly refusal?: string;
  readonly code?: number;
}
type Form = ReadonlyMap<string, string>;

const DONE: Answer = { status: 204 };
const no = (status: number, refusal: string, code?: number): Answer => ({
  status,
  refusal,
  ...(code === undefined ? {} : { code }),
});
const states = (...of: RwsState[]): Answer => ({ status: 200, states: of });
const state = (type: string, title: string, fields: Readonly<Record<string, string | number>>): RwsState => ({
  type,
  title,
  fields: Object.fromEntries(Object.entries(fields).map(([name, value]) => [name, String(value)])),
});
/** Null is well. */
const orRefused = (why: string | null): Answer => (why === null ? DONE : no(403, why));

/**
 * The resources of a controller: `answer(session, request)`. What needs a person's or another client's leave is refused
 * without it.
 */
export function createResources(
  options: ResourceOptions,
  sessions: Sessions,
): (session: Session, request: HttpRequest) => Answer {
  return resourcesOf(new Resources(options, sessions));
}

class Resources {
  readonly options: ResourceOptions;
  readonly sessions: Sessions;
  readonly virtualPendant: VirtualPendant;
  readonly programs: Programs;
  readonly files: Files;
  readonly lines: Lines;
  readonly robot: Robot;
  readonly counting: AxisCounting;

  constructor(options: ResourceOptions, sessions: Sessions) {
    this.options = options;
    this.sessions = sessions;
    this.virtualPendant = this.options.cabinet;
    this.programs = this.options.programs;
    this.files = this.options.files;
    this.lines = this.options.lines;
    this.robot = this.options.robot;
    this.counting = abbAxes(this.robot);
  }

  /** Why this client may not write; null when it may. */
  unwritable(session: Session, domain?: Domain): Answer | null {
    if (this.virtualPendant.key !== "AUTO" && this.sessions.remoteOf(session) !== "GRANTED")
      return no(403, "In manual mode writing needs the leave of the person at the pendant (users/rmmp).");
    return domain && this.sessions.isHeldByOther(domain, session)
      ? no(403, `Another client holds the mastership of ${domain}.`)
      : null;
  }

  panel(session: Session, name: string, action: string, form: Form | null): Answer {
    if (!form) {
      switch (name) {
        case "ctrlstate":
          return states(state("pnl-ctrlstate", "ctrlstate", { ctrlstate: this.virtualPendant.state }));
        case "opmode":
          return states(state("pnl-opmode", "opmode", { opmode: this.virtualPendant.key }));
        case "speedratio":
          return states(state("pnl-speedratio", "speedratio", { speedratio: this.virtualPendant.speedRatio }));
        default:
          return no(404, `The panel has no ${name}.`);
      }
    }
    if (action === "setctrlstate" && name === "ctrlstate") {
      const to = form.get("ctrl-state");
      // Anyone may stop.
      if (to === "motoroff") {
        this.virtualPendant.motorsOff("The motors were switched off from outside.");
        return DONE;
      }
      if (to !== "motoron") return no(400, "ctrl-state is motoron or motoroff.");
      return this.unwritable(session) ?? orRefused(this.virtualPendant.switchOn());
    }
    if (action === "setspeedratio" && name === "speedratio") {
      const text = form.get("speed-ratio") ?? "";
      const percent = Number(text);
      return (
        this.unwritable(session) ??
        (text.trim() !== "" && this.virtualPendant.setSpeedRatio(percent)
          ? DONE
          : no(400, "speed-ratio is a number from 0 to 100."))
      );
    }
    return no(405, `There is no action ${action} of ${name}.`);
  }

  execution(session: Session, action: string, form: Form | null): Answer {
    if (!form)
      return states(
        state("rap-execution", "execution", {
          ctrlexecstate: this.programs.isRunning ? "running" : "stopped",
          cycle: this.programs.cycle,
        }),
      );
    if (action === "stop") {
      if (form.get("stopmode") === "qstop") this.programs.interrupted("The program was stopped quickly from outside.");
      else this.programs.stop();
      return DONE;
    }
    const why = this.unwritable(session, "rapid");
    if (why) return why;
    if (action === "resetpp") return orRefused(this.programs.reset());
    const cycle = form.get("cycle");
    return action === "start"
      ? orRefused(this.programs.start(cycle === "once" || cycle === "forever" ? cycle : null))
      : no(405, `There is no action ${action} of the execution.`);
  }

  rapid(session: Session, path: readonly string[], action: string, form: Form | null): Answer {
    switch (path[0]) {
      case "execution":
        return this.execution(session, action, form);
      case "tasks":
        return path.length === 1
          ? this.task()
          : path[1]?.toUpperCase() === TASK
            ? this.task(session, action, form)
            : no(404, `There is no task ${path[1]}.`);
      case "modules":
        return states(...this.programs.names.map(name => state("rap-module-info-li", name, { name, type: "ProgMod" })));
      case "symbols":
        return form && action === "search-symbols"
          ? this.symbols(form)
          : no(405, "Symbols are searched by the action search-symbols.");
      case "symbol":
        return path[1] === "data" && path[2]?.toUpperCase() === "RAPID"
          ? this.datum(session, path.slice(3), form)
          : no(404, "There is no such symbol.");
      default:
        return no(404, `RAPID has no ${path[0] ?? "such resource"}.`);
    }
  }

  task(session?: Session, action = "", form: Form | null = null): Answer {
    if (!session || !form)
      return states(
        state(session ? "rap-task" : "rap-task-li", TASK, {
          name: TASK,
          type: "norm",
          taskstate: "link",
          excstate: this.programs.execution,
          active: "On",
          motiontask: "TRUE",
        }),
      );
    if (action === "activate") return DONE;
    if (action === "deactivate") return no(403, "The only task is not switched off.");
    const why = this.unwritable(session, "rapid");
    if (why) return why;
    if (action === "unloadmod") return orRefused(this.programs.unload(form.get("module") ?? ""));
    if (action !== "loadmod") return no(405, `There is no action ${action} of a task.`);
    const place = Files.place((form.get("modulepath") ?? "").split("/").filter(part => part !== ""));
    const bytes = place && this.files.read(place);
    return bytes
      ? orRefused(this.programs.load(latin1Text(bytes), form.get("replace") === "true"))
      : no(404, `There is no file ${form.get("modulepath") ?? ""}.`);
  }

  symbols(form: Form): Answer {
    const kind = form.get("symtyp") ?? "per";
    return states(
      ...[...this.programs.texts].flatMap(({ name, text }) =>
        dataOf(text)
          .filter(each => kind === "any" || each.kind === kind)
          .map(each =>
            state("rap-symproppers-li", `RAPID/${TASK}/${name}/${each.name}`, {
              symburl: `RAPID/${TASK}/${name}/${each.name}`,
              name: each.name,
              symtyp: each.kind,
              dattyp: each.type,
            }),
          ),
      ),
    );
  }

  /** `task/module/name`, or `task/name` where the name is that of one module only. */
  datum(session: Session, path: readonly string[], form: Form | null): Answer {
    const [, ...below] = path;
    const name = below.at(-1) ?? "";
    const found = [...this.programs.texts]
      .filter(module => below.length < 2 || module.name.toUpperCase() === below[0]!.toUpperCase())
      .flatMap(module =>
        dataOf(module.text)
          .filter(each => each.name.toUpperCase() === name.toUpperCase())
          .map(each => ({ module, each })),
      )[0];
    if (path[0]?.toUpperCase() !== TASK || !found) return no(404, `There is no datum ${path.join("/")}.`);
    const { module, each } = found;
    if (!form) return states(state("rap-data", `RAPID/${TASK}/${module.name}/${each.name}`, { value: each.value }));
    const why = this.unwritable(session, "rapid");
    const value = form.get("value") ?? "";
    if (why) return why;
    if (each.kind === "con") return no(403, `${each.name} is a constant.`);
    const text = withValue(module.text, each, value);
    if (text === null) return no(400, `"${value.slice(0, 40)}" is no value of RAPID.`);
    this.programs.change(module.name, text);
    return DONE;
  }

  motion(path: readonly string[]): Answer {
    if (path[0] !== "mechunits" || path[1]?.toUpperCase() !== UNIT) return no(404, "There is no such mechanical unit.");
    const q_rad = this.options.q_rad();
    const axes_deg = axesOfJoints(this.counting, q_rad, new Float64Array(q_rad.length));
    const external = (i: number): number => axes_deg[6 + i] ?? NO_AXIS;
    if (path[2] === "jointtarget") {
      return states(
        state("ms-jointtarget", UNIT, {
          ...Object.fromEntries(ROBOT_AXES.map((name, i) => [name, axes_deg[i] ?? NO_AXIS])),
          ...Object.fromEntries(EXTERNAL_AXES.map((name, i) => [name, external(i)])),
        }),
      );
    }
    if (path[2] !== "robtarget") return no(404, "Of a mechanical unit there are jointtarget and robtarget.");
    const {
      position: [x, y, z],
      quaternion: [qx, qy, qz, qw],
    } = flangePose(this.robot.arm, q_rad);
    const quarter = (i: number): number => Math.floor((axes_deg[i] ?? 0) / 90);
    return states(
      state("ms-robtargets", UNIT, {
        x: x * 1000,
        y: y * 1000,
        z: z * 1000,
        q1: qw,
        q2: qx,
        q3: qy,
        q4: qz,
        cf1: quarter(0),
        cf4: quarter(3),
        cf6: quarter(5),
        cfx: 0,
        eaxa: external(0),
        eaxb: external(1),
        eaxc: external(2),
        eaxd: external(3),
        eaxe: external(4),
        eaxf: external(5),
      }),
    );
  }

  readonly told = ({ name, kind, value }: Line): RwsState =>
    state("ios-signal-li", name, { name, type: kind, category: "", lvalue: Number(value), lstate: "not simulated" });

  /** `signals`, `signals/name`, or with a network and a unit in between. */
  signals(session: Session, path: readonly string[], form: Form | null): Answer {
    if (path[0] !== "signals") return no(404, "The I/O system has signals.");
    const name = path.at(-1)!;
    const line = this.lines.find(name);
    if (path.length === 1) return states(...this.lines.all.map(this.told));
    if (!line) return no(404, `There is no signal ${name}.`);
    if (!form) return states({ ...this.told(line), type: "ios-signal" });
    const text = form.get("lvalue") ?? "";
    const value = Number(text);
    return (
      this.unwritable(session) ??
      (text.trim() === "" || !Number.isFinite(value)
        ? no(400, "lvalue is a number.")
        : orRefused(this.lines.write(name, value)))
    );
  }

  mastership(session: Session, path: readonly string[], action: string, form: Form | null): Answer {
    const asked = path.length === 0 ? DOMAINS : DOMAINS.filter(domain => domain === path[0]);
    if (asked.length === 0) return no(404, "Domains of mastership are cfg, motion and rapid.");
    if (!form)
      return states(
        ...asked.map(domain =>
          state("msh-resource-li", domain, { mastership: this.sessions.masterOf(domain) ? "remote" : "nomaster" }),
        ),
      );
    if (action === "release") {
      for (const domain of asked) this.sessions.release(domain, session);
      return DONE;
    }
    if (action !== "request") return no(405, `There is no action ${action} of mastership.`);
    if (this.virtualPendant.key !== "AUTO" && this.sessions.remoteOf(session) !== "GRANTED")
      return this.unwritable(session)!;
    return asked.some(domain => this.sessions.isHeldByOther(domain, session))
      ? no(403, "Another client holds it.", RWS_CODE.exists)
      : asked.every(domain => this.sessions.request(domain, session))
        ? DONE
        : no(403, "Another client holds it.");
  }

  users(session: Session, path: readonly string[], form: Form | null): Answer {
    if (path[0] !== "rmmp") return no(404, "Of users there is rmmp.");
    if (form) {
      this.sessions.askRemote(session);
      return { status: 202 };
    }
    const status = this.virtualPendant.key === "AUTO" ? "GRANTED" : this.sessions.remoteOf(session);
    return states(
      state(path[1] === "poll" ? "user-rmmp-poll" : "user-rmmp", "rmmp", {
        status,
        privilege: status === "GRANTED" ? "modify" : "none",
      }),
    );
  }

  file(method: string, path: readonly string[], body: Uint8Array): Answer {
    if (path.length === 0)
      return method === "GET"
        ? states(...FOLDERS.map(name => state("fs-dir", name, {})))
        : no(405, "Files are in folders.");
    const place = Files.place(path);
    if (!place) return no(404, `There is no place ${path.join("/")}.`);
    if (method === "PUT") {
      const isNew = place.length > 1 ? this.files.write(place, body) : null;
      return isNew === null ? no(403, "The disk is full, or this is a folder.") : { status: isNew ? 201 : 200 };
    }
    if (method === "DELETE") return this.files.remove(place) ? DONE : no(404, `There is no file ${path.join("/")}.`);
    const bytes = this.files.read(place);
    const list = bytes ? null : this.files.list(place);
    if (bytes) return { status: 200, file: bytes };
    return list
      ? states(
          ...[...list].map(([name, size]) =>
            state(size < 0 ? "fs-dir" : "fs-file", name, size < 0 ? {} : { "fs-size": size }),
          ),
        )
      : no(404, `There is no file ${path.join("/")}.`);
  }
}

function resourcesOf(own: Resources): (session: Session, request: HttpRequest) => Answer {
  return (session, { method, target, body }) => {
    const read = readTarget(target);
    const form = method === "POST" ? readForm(latin1Text(body)) : null;
    if (!read || (method === "POST" && !form)) return no(400, "An escape in the request is broken.");
    const [first = "", second = "", ...rest] = read.path;
    const action = read.query.get("action") ?? "";
    if (first === "fileservice")
      return ["GET", "PUT", "DELETE"].includes(method)
        ? own.file(method, read.path.slice(1), body)
        : no(405, "Files are read, put and deleted.");
    if (method !== "GET" && method !== "POST") return no(405, `${method} is not for this resource.`);
    if (first === "logout") {
      own.sessions.end(session);
      return { status: 200, states: [] };
    }
    if (first === "users") return own.users(session, read.path.slice(1), form);
    if (first === "ctrl")
      return second.startsWith("$")
        ? states(state("ctrl-env", second, { _value: second }))
        : states(state("ctrl", "ctrl", { "ctrl-name": "VIRTUAL", "ctrl-type": "Virtual Controller" }));
    if (first !== "rw") return no(404, `There is no resource ${first}.`);
    switch (second) {
      case "panel":
        return own.panel(session, rest[0] ?? "", action, form);
      case "rapid":
        return own.rapid(session, rest, action, form);
      case "motionsystem":
        return own.motion(rest);
      case "iosystem":
        return own.signals(session, rest, form);
      case "mastership":
        return own.mastership(session, rest, action, form);
      case "system":
        return rest[0] === "robottype"
          ? states(state("sys-robottype", "1", { "robot-type": own.options.model }))
          : states(state("sys-system", "system", { name: "VIRTUAL", rwversion: "6.15.0000" }));
      case "elog":
        return rest[0] === "0"
          ? states(...eventStates(own.virtualPendant.events))
          : states(
              state("elog-domain-li", "0", { "domain-name": "Common", numevts: own.virtualPendant.events.length }),
            );
      default:
        return no(404, `There is no resource rw/${second}.`);
    }
  };
}
