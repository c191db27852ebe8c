import type { IncomingMessage } from "node:http";
import { SOCKETS } from "@twincell/protocol";
import type { TokenAnswer } from "./tokens.ts";

const COOKIE = "twincell_link";

/** Read-only links: a page that was opened by one carries it as a cookie. */
export interface CellLinks {
  /** The name and the cell of the link that a request carries; null without one, or when it has ended. */
  of(cookies: string | undefined): { readonly name: string; readonly cell: string } | null;
  /** Of a link that somebody opens: its cell and the cookie of its page; null when there is no such link. */
  enter(link: string, secure: boolean): { readonly cell: string; readonly cookie: string } | null;
}

export function cellLinks(tokens: (token: string) => TokenAnswer): CellLinks {
  const known = (token: string): { readonly name: string; readonly cell: string } | null => {
    const answer = tokens(token);
    return answer.kind === "known" && answer.cell !== null ? { name: answer.name, cell: answer.cell } : null;
  };
  return {
    of(cookies) {
      const token = cookies
        ?.split(";")
        .map(part => part.trim())
        .find(part => part.startsWith(`${COOKIE}=`))
        ?.slice(COOKIE.length + 1);
      return token === undefined ? null : known(token);
    },
    enter(link, secure) {
      const found = known(link);
      // Lax: a link is opened from a letter, which is another site. Nothing can be changed with it.
      return (
        found && {
          cell: found.cell,
          cookie: `${COOKIE}=${link}; Path=/; HttpOnly; SameSite=Lax${secure ? "; Secure" : ""}`,
        }
      );
    },
  };
}

/** Whether a request asks only to look at that cell: for the cell itself, or for its editing as somebody who looks. */
export function isLookAt(request: IncomingMessage, cell: string): boolean {
  const { pathname, searchParams } = new URL(request.url ?? "/", "http://here");
  return pathname === SOCKETS.editing
    ? searchParams.get("cell") === cell
    : request.method === "GET" && pathname === `/api/v1/cells/${encodeURIComponent(cell)}`;
}
