import type { IncomingMessage } from "node:http";
import type { Scheduler } from "@twincell/core";
import { SOCKETS, type ApiRoute } from "@twincell/protocol";
import { clientOf, type AccessCode } from "../access.ts";
import type { Entered } from "../api/calls.ts";
import type { Account } from "./accounts.ts";
import type { AuditLog } from "./audit-log.ts";
import { cellLinks, isLookAt } from "./links.ts";
import { mayUse, type Role, type TokenAnswer } from "./tokens.ts";

/** What somebody may do at one robot or cell. */
export type RoleAt = (subject?: string) => Role;
export interface Gate {
  /**
   * Whether that request may use a route of that kind, and in whose name.
   *
   * @param subject  id of the robot or name of the document that it is about.
   */
  enter(request: IncomingMessage, access: ApiRoute["access"], subject?: string): Entered;
  /** Whether that request may open a socket. */
  socket(request: IncomingMessage): boolean;
  /** Whether a socket that was opened by that request may stay open: what let it in was not taken back or has ended. */
  stays(request: IncomingMessage): boolean;
  /** The name of the person or token of a request, or null. */
  nameOf(request: IncomingMessage): string | null;
  /** Whether a read-only link is all that lets that request in. */
  byLink(request: IncomingMessage): boolean;
  /** Their roles as they are at each call; null where no account or token limits anything. */
  roleOf(request: IncomingMessage): RoleAt | null;
}
export interface GateOptions {
  /** Null on loopback, where everybody of this machine is in, and where people sign in by name. */
  readonly access: AccessCode | null;
  readonly tokens: (token: string) => TokenAnswer;
  /** Who is signed in by the cookies of a request; null where nobody signs in by name. */
  readonly people: ((cookies: string | undefined) => Account | null) | null;
  readonly audit: AuditLog | null;
  readonly scheduler: Scheduler;
  readonly onTrouble: (sentence: string) => void;
}
/** Of one client that is turned away a line is written this often [s]: the log is not filled by whoever knocks. */
const LINE_EACH_S = 60;
const MOST_CLIENTS = 1000;
const bearer = (request: IncomingMessage): string | null =>
  /^Bearer (.+)$/.exec(request.headers.authorization ?? "")?.[1] ?? null;
const isToken = (given: string | null): given is string => given?.startsWith("twincell_") === true;
export const roleAt = ({ role, rights }: Pick<Account, "role" | "rights">, subject?: string): Role =>
  (subject !== undefined && Object.hasOwn(rights, subject) ? rights[subject] : undefined) ?? role;

/** Lets in by token, by account, by access code, or on loopback without any; writes down who was turned away. */
export function createGate({ access, tokens, people, audit, scheduler, onTrouble }: GateOptions): Gate {
  const written_s = new Map<string, number>();
  const links = cellLinks(tokens);
  function out(
    request: IncomingMessage,
    status: 401 | 403 | 429,
    who: string,
    sentence: string,
    hint: string,
  ): Entered {
    const client = clientOf(request.socket.remoteAddress);
    const now_s = scheduler.now_s();
    if (audit && now_s - (written_s.get(client) ?? -Infinity) > LINE_EACH_S) {
      if (written_s.size >= MOST_CLIENTS) written_s.clear();
      written_s.set(client, now_s);
      try {
        audit.write({ who, action: "is turned away", robot: "", detail: `${client}: ${sentence}`, outcome: "refused" });
      } catch (problem) {
        onTrouble(`The audit log cannot be written: ${problem instanceof Error ? problem.message : String(problem)}.`);
      }
    }
    return { kind: "out", status, sentence, hint };
  }
  const judged = (request: IncomingMessage, name: string, role: Role, kind: ApiRoute["access"]): Entered =>
    mayUse(role, kind)
      ? { kind: "in", who: name, named: true }
      : out(request, 403, name, `${name} is ${roleText(role)} and may not do this.`, needed(kind));
  /** A read-only link lets in to one cell, for looking. */
  const looking = (request: IncomingMessage, name: string, cell: string, kind: ApiRoute["access"]): Entered =>
    kind === "look" && isLookAt(request, cell)
      ? { kind: "in", who: name, named: true }
      : out(request, 403, name, `This link is for looking at the cell “${cell}” and nothing else.`, "Sign in.");
  function byToken(request: IncomingMessage, given: string, kind: ApiRoute["access"]): Entered {
    const answer = tokens(given);
    if (answer.kind === "known" && answer.cell !== null) return looking(request, answer.name, answer.cell, kind);
    if (answer.kind === "known") return judged(request, answer.name, answer.role, kind);
    return answer.kind === "unknown"
      ? out(request, 401, "somebody", "This token is not known here.", "Make one with twincell token add.")
      : out(
          request,
          401,
          answer.name,
          `The token of ${answer.name} has ended.`,
          "Make another one with twincell token add.",
        );
  }
  function enter(request: IncomingMessage, kind: ApiRoute["access"], subject?: string): Entered {
    if (kind === "open") return { kind: "in", who: "anyone", named: false };
    const given = bearer(request);
    if (isToken(given)) return byToken(request, given, kind);
    if (people) {
      const account = people(request.headers.cookie);
      const link = account ? null : links.of(request.headers.cookie);
      if (link) return looking(request, link.name, link.cell, kind);
      return account
        ? judged(request, account.name, roleAt(account, subject), kind)
        : out(request, 401, "somebody", "People sign in here.", "Sign in, or send a token.");
    }
    if (access === null) return { kind: "in", who: "api", named: false };
    const entry = access.enter(request.headers.cookie, given, clientOf(request.socket.remoteAddress));
    if (entry.kind === "welcome" || entry.kind === "welcome-with-cookie")
      return { kind: "in", who: "api", named: false };
    const link = entry.kind === "ask" ? links.of(request.headers.cookie) : null;
    if (link) return looking(request, link.name, link.cell, kind);
    return entry.kind === "ask"
      ? out(
          request,
          401,
          "somebody",
          "This server asks for its access code or a token.",
          "Send it as the header authorization: Bearer CODE.",
        )
      : out(
          request,
          429,
          "somebody",
          "Too many wrong codes came from this address.",
          "Wait a minute or longer, then send it again.",
        );
  }
  return {
    enter,
    socket(request) {
      const path = (request.url ?? "").split("?")[0];
      // A read-only link opens one socket; by code only the cookie counts here, as for every socket of the studio.
      if (!isToken(bearer(request)))
        return people || path === SOCKETS.editing
          ? enter(request, "look").kind === "in"
          : access === null || isWelcome(request, access);
      return enter(request, path === SOCKETS.stream || path === SOCKETS.editing ? "look" : "command").kind === "in";
    },
    stays(request) {
      const given = bearer(request);
      if (isToken(given)) return tokens(given).kind === "known";
      const link = links.of(request.headers.cookie) !== null;
      if (people) return people(request.headers.cookie) !== null || link;
      return access === null || isWelcome(request, access) || link;
    },
    nameOf(request) {
      const given = bearer(request);
      const answer = isToken(given) ? tokens(given) : null;
      if (answer) return answer.kind === "known" ? answer.name : null;
      return people?.(request.headers.cookie)?.name ?? null;
    },
    byLink(request) {
      const given = bearer(request);
      if (isToken(given)) {
        const answer = tokens(given);
        return answer.kind === "known" && answer.cell !== null;
      }
      const other = people ? people(request.headers.cookie) !== null : access === null || isWelcome(request, access);
      return !other && links.of(request.headers.cookie) !== null;
    },
    roleOf(request) {
      const given = bearer(request);
      if (isToken(given))
        return () => {
          const answer = tokens(given);
          return answer.kind === "known" ? answer.role : "viewer";
        };
      if (!people) return null;
      return subject => {
        const account = people(request.headers.cookie);
        return account ? roleAt(account, subject) : "viewer";
      };
    },
  };
}
/** Whether a page was let in by the access code. */
const isWelcome = (request: IncomingMessage, access: AccessCode): boolean =>
  access.enter(request.headers.cookie, null, clientOf(request.socket.remoteAddress)).kind === "welcome";
const roleText = (role: Role): string => (role === "operator" || role === "admin" ? `an ${role}` : `a ${role}`);
const needed = (kind: ApiRoute["access"]): string =>
  kind === "people"
    ? "It needs the role admin."
    : kind === "write"
      ? "It needs the role programmer or admin."
      : "It needs the role operator or admin.";
