import type { ByteStream } from "../../transport/index.ts";
import { BANNER, onlyRequests, readCommand, REPLIES, type Asked } from "../codec/dashboard.ts";
import { lineBytes, lineReader } from "../codec/lines.ts";
import { robotModeName, RUNTIME, safetyModeName } from "../codec/modes.ts";
import type { Version } from "../codec/rtde.ts";
import type { Outbox } from "./faults.ts";
import type { Programs } from "./programs.ts";
import type { States } from "./states.ts";

export interface DashboardOptions {
  readonly outbox: Outbox;
  readonly states: States;
  readonly programs: Programs;
  readonly version: Version;
  readonly serial: string;
  readonly model: string;
  now_s(): number;
  isRemote(): boolean;
  operationalMode(): string;
  setOperationalMode(mode: string): void;
  /** Texts on the controller by name; undefined when there is none of that name. */
  file(name: string): string | undefined;
  log(sentence: string): void;
}

const PROGRAM_STATES: Readonly<Record<number, string>> = { [RUNTIME.PLAYING]: "PLAYING", [RUNTIME.PAUSED]: "PAUSED" };
/** Remote control came with this version: before it everything was allowed. */
const REMOTE_SINCE: readonly [number, number] = [5, 6];

/** Text in, one line of text out. */
export class DashboardServer {
  private readonly options: DashboardOptions;
  private readonly streams = new Set<ByteStream>();
  constructor(options: DashboardOptions) {
    this.options = options;
  }

  accept(stream: ByteStream): void {
    const lines = lineReader();
    const { outbox } = this.options;
    this.streams.add(stream);
    stream.onEnd(() => {
      this.streams.delete(stream);
    });
    outbox.send(stream, lineBytes(BANNER));
    stream.onBytes(lent => {
      const why = lines.push(lent, line => {
        if (!this.streams.has(stream) || line.trim() === "" || outbox.faults.frozen) return;
        outbox.send(stream, lineBytes(this.answer(line)));
        if (readCommand(line)?.command === "quit") this.end(stream);
      });
      if (why !== null && this.streams.has(stream)) {
        this.options.log(`Dashboard: ${why}`);
        this.end(stream);
      }
    });
  }
  private end(stream: ByteStream): void {
    this.streams.delete(stream);
    stream.close();
  }
  closeAll(): void {
    for (const stream of [...this.streams]) this.end(stream);
  }

  answer(line: string): string {
    const asked = readCommand(line);
    const { options } = this;
    if (!asked) return REPLIES.notUnderstood(line);
    const [major, minor] = options.version;
    const hasRemote = major > REMOTE_SINCE[0] || (major === REMOTE_SINCE[0] && minor >= REMOTE_SINCE[1]);
    if (hasRemote && !options.isRemote() && !onlyRequests(asked.command)) return REPLIES.local(asked.command);
    return this.carriedOut(asked, line);
  }

  private carriedOut({ command, argument }: Asked, line: string): string {
    const { states, now_s } = this.options;
    const failed = (): string => REPLIES.failed(command);
    switch (command) {
      case "robotmode":
        return `Robotmode: ${robotModeName(states.robotMode)}`;
      case "safetymode":
        return `Safetymode: ${safetyModeName(states.safetyMode)}`;
      case "safetystatus":
        return `Safetystatus: ${safetyModeName(states.safetyMode)}`;
      case "power on":
        return states.powerOn(now_s()) ? REPLIES.poweringOn : failed();
      case "power off":
        states.powerOff();
        return REPLIES.poweringOff;
      case "brake release":
        return states.releaseBrakes(now_s()) ? REPLIES.releasing : failed();
      case "unlock protective stop":
        return states.unlock(now_s()) === "too-soon" ? REPLIES.tooSoon : REPLIES.unlocking;
      case "restart safety":
        states.restartSafety();
        return "Restarting safety";
      default:
        return (
          this.ofProgram({ command, argument }) ?? this.about({ command, argument }) ?? REPLIES.notUnderstood(line)
        );
    }
  }

  /** What concerns programs; null for everything else. */
  private ofProgram({ command, argument }: Asked): string | null {
    const { states, programs } = this.options;
    const failed = (): string => REPLIES.failed(command);
    switch (command) {
      case "load": {
        const text = this.options.file(argument);
        if (text === undefined) return `File not found: ${argument}`;
        programs.loaded = { name: argument, text };
        return `Loading program: ${argument}`;
      }
      case "load installation":
        return `File not found: ${argument}`;
      case "play":
        if (programs.resume()) return REPLIES.starting;
        if (!programs.loaded || !states.mayMove) return failed();
        programs.start(programs.loaded.text);
        return programs.isRunning ? REPLIES.starting : failed();
      case "pause":
        return programs.pause() ? REPLIES.pausing : failed();
      case "stop": {
        if (!programs.isRunning) return failed();
        programs.end();
        return REPLIES.stopped;
      }
      default:
        return this.told(command);
    }
  }

  /** What is told of programs; null for everything else. */
  private told(command: string): string | null {
    const { programs } = this.options;
    switch (command) {
      case "running":
        return `Program running: ${programs.runtime === RUNTIME.PLAYING}`;
      case "programstate":
        return `${PROGRAM_STATES[programs.runtime] ?? "STOPPED"} ${programs.name || (programs.loaded?.name ?? "")}`.trim();
      case "get loaded program":
        return programs.loaded ? `Loaded program: ${programs.loaded.name}` : "No program loaded";
      case "isprogramsaved":
        return `true ${programs.loaded?.name ?? ""}`.trim();
      default:
        return null;
    }
  }

  /** What concerns the controller itself and its screen; null for everything else. */
  private about({ command, argument }: Asked): string | null {
    const { version, serial, model } = this.options;
    const [major, minor, bugfix, build] = version;
    const failed = (): string => REPLIES.failed(command);
    switch (command) {
      case "close popup":
        return "closing popup";
      case "close safety popup":
        return "closing safety popup";
      case "popup":
        this.options.log(`Popup: ${argument}`);
        return "showing popup";
      case "addtolog":
        this.options.log(`A client notes: ${argument}`);
        return "Added log message";
      case "polyscopeversion":
        return `URSoftware ${major}.${minor}.${bugfix}.${build} (Mar 22 2022)`;
      case "version":
        return `${major}.${minor}.${bugfix}.${build}`;
      case "get serial number":
        return serial;
      case "get robot model":
        return model;
      case "is in remote control":
        return String(this.options.isRemote());
      case "get operational mode":
        return this.options.operationalMode();
      case "set operational mode": {
        const mode = argument.toUpperCase();
        if (mode !== "MANUAL" && mode !== "AUTOMATIC") return failed();
        this.options.setOperationalMode(mode);
        return `Operational mode ${mode} is set`;
      }
      case "clear operational mode":
        this.options.setOperationalMode("NONE");
        return "No longer controlling the operational mode. Current operational mode: NONE";
      case "quit":
        return "Disconnected";
      case "savelog":
        return "Log saved to disk";
      case "generate flight report":
      case "generate support file":
      case "shutdown":
        return failed();
      default:
        return null;
    }
  }
}
