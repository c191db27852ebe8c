/** Typed client of a Twincell server. SI units and radians; joints count from 1. Not a certified safety device. */
import type { Answer, Body, StreamEvent, StreamEventOf } from "./api.ts";
import { streamEvents, type StreamOptions } from "./events.ts";
import { Connection, type ClientOptions } from "./http.ts";

export type * from "./api.ts";
export { Connection, Refused, Stopped, TwincellError, type CallOptions, type ClientOptions } from "./http.ts";
export type { StreamOptions } from "./events.ts";
type Sample = StreamEventOf<"sample">;
export interface MotionOptions {
  /** Aborting it stops the robot. */
  readonly signal?: AbortSignal;
}

/** A Twincell server. */
export class Twincell {
  /** For routes that have no method of their own here. */
  readonly connection: Connection;
  readonly programs: Documents;
  readonly cells: Documents;
  constructor(url: string | URL, options: ClientOptions = {}) {
    this.connection = new Connection(url, options);
    this.programs = new Documents(this.connection, "program");
    this.cells = new Documents(this.connection, "cell");
  }
  about(): Promise<Answer<"about">> {
    return this.connection.call("about");
  }
  async models(): Promise<Answer<"models">["models"]> {
    return (await this.connection.call("models")).models;
  }
  async drivers(): Promise<Answer<"drivers">["drivers"]> {
    return (await this.connection.call("drivers")).drivers;
  }
  async robots(): Promise<Answer<"listRobots">["robots"]> {
    return (await this.connection.call("listRobots")).robots;
  }
  /** Robots of all servers of the cluster, or of this one when it is by itself. */
  async fleet(): Promise<Answer<"fleet">["robots"]> {
    return (await this.connection.call("fleet")).robots;
  }
  /** A robot that is open already. */
  robot(id: string): Robot {
    return new Robot(this.connection, id);
  }
  /** Opens a robot: a virtual controller, or with `address` a driver to one that is there. */
  async open(robot: Body<"openRobot">): Promise<Robot> {
    await this.connection.call("openRobot", robot);
    return new Robot(this.connection, robot.id);
  }
  /** Judges a program: reach, limits, speed, torque, branches; collision when a cell is given. */
  check(asked: Body<"check">): Promise<Answer<"check">> {
    return this.connection.call("check", asked);
  }
  /** The motion of a program over time. */
  plan(asked: Body<"plan">): Promise<Answer<"plan">> {
    return this.connection.call("plan", asked);
  }
  /** The program in a controller's language, executed and compared with the plan first. */
  write(asked: Body<"writeText">): Promise<Answer<"writeText">> {
    return this.connection.call("writeText", asked);
  }
  async recordings(): Promise<Answer<"listRecordings">["recordings"]> {
    return (await this.connection.call("listRecordings")).recordings;
  }
  /** One recording as MCAP. */
  recording(robot: string, file: string): Promise<Uint8Array> {
    return this.connection.call("getRecording", undefined, { params: { robot, file } });
  }
  /** Stops every robot. Anyone may. */
  async stop(emergency = false): Promise<void> {
    await this.connection.call("stopAll", { emergency });
  }
  events(options: StreamOptions = {}): AsyncGenerator<StreamEvent, void, undefined> {
    return streamEvents(this.connection, options);
  }
}

/** Programs or cells that the server keeps under names. */
export class Documents {
  private readonly connection: Connection;
  private readonly kind: "program" | "cell";
  constructor(connection: Connection, kind: "program" | "cell") {
    this.connection = connection;
    this.kind = kind;
  }
  async names(): Promise<readonly string[]> {
    return (await this.connection.call(`list_${this.kind}`)).names;
  }
  get(name: string): Promise<unknown> {
    return this.connection.call(`get_${this.kind}`, undefined, { params: { name } });
  }
  async put(name: string, document: unknown): Promise<void> {
    await this.connection.call(`put_${this.kind}`, document, { params: { name } });
  }
  async delete(name: string): Promise<void> {
    await this.connection.call(`delete_${this.kind}`, undefined, { params: { name } });
  }
}

/** One robot of a server. Looking needs no lease. */
export class Robot {
  readonly connection: Connection;
  readonly id: string;
  constructor(connection: Connection, id: string) {
    this.connection = connection;
    this.id = id;
  }
  /** Last sample, link and guard; null where nothing was heard yet. */
  state(): Promise<Answer<"robotState">> {
    return this.connection.call("robotState", undefined, { params: { id: this.id } });
  }
  events(options: Omit<StreamOptions, "robot"> = {}): AsyncGenerator<StreamEvent, void, undefined> {
    return streamEvents(this.connection, { ...options, robot: this.id });
  }
  async *samples(options: Omit<StreamOptions, "robot"> = {}): AsyncGenerator<Sample, void, undefined> {
    for await (const event of this.events(options)) if (event.type === "sample") yield event;
  }
  /** Takes the lease: one commands, anyone may stop. */
  async lease(asked: Body<"takeLease"> = {}): Promise<Lease> {
    const { lease } = await this.connection.call("takeLease", asked, { params: { id: this.id } });
    return new Lease(this, lease);
  }
  async stop(emergency = false): Promise<void> {
    await this.connection.call("stop", { emergency }, { params: { id: this.id } });
  }
  /** Stops it and keeps the place of its production, to take over by hand. Anyone may. */
  async hold(): Promise<void> {
    await this.connection.call("holdProduction", undefined, { params: { id: this.id } });
  }
  async close(): Promise<void> {
    await this.connection.call("closeRobot", undefined, { params: { id: this.id } });
  }
}

/** The right to command one robot; `await using` gives it back. */
export class Lease {
  readonly robot: Robot;
  /** Secret. */
  readonly token: string;
  constructor(robot: Robot, token: string) {
    this.robot = robot;
    this.token = token;
  }
  private options(signal?: AbortSignal) {
    return { params: { id: this.robot.id }, lease: this.token, signal };
  }
  async connect(): Promise<void> {
    await this.robot.connection.call("connect", undefined, this.options());
  }
  async disconnect(): Promise<void> {
    await this.robot.connection.call("disconnect", undefined, this.options());
  }
  /** A person's word that motion is wanted again after a lost link. */
  async confirm(): Promise<void> {
    await this.robot.connection.call("confirm", undefined, this.options());
  }
  async reset(): Promise<void> {
    await this.robot.connection.call("reset", undefined, this.options());
  }
  /** Sets the override [%]. */
  async speed(percent: number): Promise<void> {
    await this.robot.connection.call("speed", { percent }, this.options());
  }
  /** Moves to joint angles [rad]; resolves when it stands there, rejects with `Refused` or `Stopped`. */
  async move(q_rad: readonly number[], { signal }: MotionOptions = {}): Promise<void> {
    await this.robot.connection.call("move", { q_rad }, this.options(signal));
  }
  /** Checks a program and runs it; resolves at its end. */
  async run(program: unknown, options: Omit<Body<"run">, "program"> & MotionOptions = {}): Promise<void> {
    const { signal, ...rest } = options;
    await this.robot.connection.call("run", { program, ...rest }, this.options(signal));
  }
  /** Runs a program cycle after cycle; resolves when the last has ended. */
  async produce(program: unknown, options: Omit<Body<"produce">, "program"> & MotionOptions = {}): Promise<void> {
    const { signal, ...rest } = options;
    await this.robot.connection.call("produce", { program, ...rest }, this.options(signal));
  }
  /** Another program from the next cycle on, without a stop; resolves when it has taken over. */
  async replace(program: unknown, options: Omit<Body<"replaceProgram">, "program"> = {}): Promise<void> {
    await this.robot.connection.call("replaceProgram", { program, ...options }, this.options());
  }
  /** Hands back to a production that was held, from where the robot stands. */
  async resume(from: "step" | "cycle" = "step"): Promise<void> {
    await this.robot.connection.call("resumeProduction", { from }, this.options());
  }
  /** One step of a held production. */
  async step(): Promise<void> {
    await this.robot.connection.call("stepProduction", undefined, this.options());
  }
  /** Steps before which the production is held. */
  async breakpoints(steps: readonly string[]): Promise<void> {
    await this.robot.connection.call("setBreakpoints", { steps }, this.options());
  }
  /** The cell that its guard keeps the robot clear of. */
  async setCell(cell: unknown): Promise<void> {
    await this.robot.connection.call("setCell", { cell }, this.options());
  }
  async release(): Promise<void> {
    await this.robot.connection.call("giveLease", undefined, this.options());
  }
  async [Symbol.asyncDispose](): Promise<void> {
    await this.release();
  }
}
