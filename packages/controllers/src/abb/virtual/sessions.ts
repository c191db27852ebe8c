import { md5Hex } from "../../http/index.ts";
import { SESSION_COOKIES } from "../codec/index.ts";

export interface Session {
  readonly id: string;
  used_s: number;
}
/** Domains in which one client at a time may write. */
export const DOMAINS = ["cfg", "motion", "rapid"] as const;
export type Domain = (typeof DOMAINS)[number];
export type Remote = "NONE" | "PENDING" | "GRANTED" | "DENIED";

const MOST_SESSIONS = 70;
const IDLE_S = 300;

/** Who is logged in, who may write in manual mode, and who holds the mastership of what. */
export class Sessions {
  private readonly now_s: () => number;
  private readonly all = new Map<string, Session>();
  private readonly masters = new Map<Domain, Session>();
  private remote: { readonly session: Session; state: Remote } | null = null;
  private count = 0;

  constructor(now_s: () => number) {
    this.now_s = now_s;
  }

  get size(): number {
    return this.all.size;
  }
  find(cookies: string): Session | undefined {
    for (const each of cookies.split(";")) {
      const [name, value = ""] = each.trim().split("=", 2);
      const session = (SESSION_COOKIES as readonly string[]).includes(name!) ? this.all.get(value) : undefined;
      if (session && this.now_s() - session.used_s <= IDLE_S) {
        session.used_s = this.now_s();
        return session;
      }
    }
    return undefined;
  }
  /** Undefined when there are as many as there may be. */
  begin(): Session | undefined {
    for (const session of this.all.values()) if (this.now_s() - session.used_s > IDLE_S) this.end(session);
    if (this.all.size >= MOST_SESSIONS) return undefined;
    const session = { id: md5Hex(`session ${++this.count} ${this.now_s()}`), used_s: this.now_s() };
    this.all.set(session.id, session);
    return session;
  }
  clear(): void {
    for (const session of [...this.all.values()]) this.end(session);
  }
  end(session: Session): void {
    this.all.delete(session.id);
    for (const [domain, master] of this.masters) if (master === session) this.masters.delete(domain);
    if (this.remote?.session === session) this.remote = null;
  }

  /** The manual-mode privilege: asked for here, given by a person at the pendant. */
  askRemote(session: Session): void {
    this.remote = { session, state: "PENDING" };
  }
  remoteOf(session: Session): Remote {
    return this.remote?.session === session ? this.remote.state : "NONE";
  }
  answerRemote(granted: boolean): void {
    if (this.remote?.state === "PENDING") this.remote.state = granted ? "GRANTED" : "DENIED";
  }

  isHeldByOther(domain: Domain, session: Session): boolean {
    const master = this.masters.get(domain);
    return master !== undefined && master !== session;
  }
  masterOf(domain: Domain): Session | undefined {
    return this.masters.get(domain);
  }
  request(domain: Domain, session: Session): boolean {
    if (this.isHeldByOther(domain, session)) return false;
    this.masters.set(domain, session);
    return true;
  }
  release(domain: Domain, session: Session): boolean {
    return this.masters.get(domain) === session && this.masters.delete(domain);
  }
}
