import type { IncomingMessage } from "node:http";
import type { Scheduler } from "@twincell/core";
import type { ApiRobots } from "../api/robots.ts";
import type { Entered } from "../api/calls.ts";
import type { TokenAnswer } from "../people/tokens.ts";
import type { RobotStates } from "./robot-states.ts";

/** What a standard is given: the robots, who may do what, and where it may be heard. */
export interface StandardContext {
  readonly states: RobotStates;
  readonly robots: ApiRobots;
  readonly scheduler: Scheduler;
  /** Clock of the day [ms]. */
  readonly now_ms: () => number;
  readonly version: string;
  /** Address to listen on. */
  readonly host: string;
  /** Names that a request may call this machine by. */
  readonly hosts: ReadonlySet<string>;
  /** Null on loopback: everybody of this machine is in, as with the API. */
  readonly certificate: { readonly key: string; readonly cert: string } | null;
  readonly enter: (request: IncomingMessage, access: "look" | "command") => Entered;
  readonly tokens: (token: string) => TokenAnswer;
  readonly data: string | undefined;
  /** One sentence for whoever started the server. */
  readonly say: (sentence: string) => void;
}
/** A standard that is spoken. */
export interface StartedStandard {
  /** Where it is spoken, for whoever started the server. */
  readonly address: string;
  close(): void | Promise<void>;
}
export const causeOf = (problem: unknown): string => (problem instanceof Error ? problem.message : String(problem));
