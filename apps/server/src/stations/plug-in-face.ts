import {
  stepOfMotion,
  type ControllerAdapter,
  type AdapterEvents,
  type AdapterOptions,
  type Opened,
} from "@twincell/controllers";
import { emptyProgram, type CommandOutcome, type JointSample, type Refusal, type Step } from "@twincell/core";
import { createClient, PLUG_IN_PORT, type Client, type ConnectionEvent, type EventOf } from "@twincell/protocol";
import { lines } from "./lines.ts";

/** What a plug-in calls its one robot. */
const STATION = "robot";
/**
 * Without a sample for this long the link is lost; a sign of life goes out this often [s]. Shorter than the pause
 * before a lost link is tried again (0.25 s): the guard goes by silence, and a plug-in that comes back at once must not
 * come back unnoticed.
 */
const STALE_S = 0.2;
const ALIVE_S = 0.05;

const refusal = (code: string, sentence: string, hint: string): Refusal => ({ code, sentence, hint });
const failed = (why: Refusal, again: boolean): Opened => ({ kind: "failed", why, again });
const gone = refusal(
  "plug-in.gone",
  "The connection to the plug-in is gone.",
  "Connect again; motion goes on only when you command it.",
);
const unfit = (sentence: string): Opened =>
  failed(
    refusal(
      "plug-in.other-robot",
      sentence,
      "Start the plug-in for this robot, or choose the robot that it drives, and connect again.",
    ),
    false,
  );

/** One connection from its first byte on. */
interface Session {
  readonly client: Client;
  end(): void;
}

/**
 * A robot whose driver is somebody else's process. It is spoken with in the messages of `@twincell/protocol`, one JSON
 * text a line, over TCP: the process is the host of one station, this side is who commands. How it speaks with its
 * robot is its own affair.
 */
export function createPlugInAdapter({ robot, scheduler, network, host, ports }: AdapterOptions): ControllerAdapter {
  const port = ports?.["plug-in"] ?? PLUG_IN_PORT;
  const n = robot.arm.joints.length;
  /** `complaint`: what an order without an answer of its own came to, told with the states until the next motion. */
  let session: Session | null = null;
  let complaint = "";
  /**
   * Number of the last sample handed on: a plug-in that was started again counts from its beginning, and its clock may
   * go on.
   */
  let last = 0;

  async function open(events: AdapterEvents): Promise<Opened> {
    const connected = await network.connect({ host, port });
    if (connected.kind === "refused")
      return failed(
        refusal("plug-in.no-answer", connected.sentence, "Start the plug-in, or look at its address."),
        true,
      );
    const { stream } = connected;
    const encoder = new TextEncoder();
    let isOpen = false;
    let offset = NaN;
    let settle: (opened: Opened) => void = () => undefined;
    let pinging = false;
    const settled = new Promise<Opened>(resolve => {
      settle = resolve;
    });
    /** Ends this connection for that reason, whether it was open yet or not. */
    const end = (
      sentence: string,
      opened: Opened = failed(refusal("plug-in.lost", sentence, "Look at the plug-in's own log."), true),
    ): void => {
      if (session !== mine) return;
      mine.end();
      session = null;
      if (isOpen) events.lost(sentence);
      else settle(opened);
    };
    const endAsUnfit = (sentence: string): void => {
      end(sentence, unfit(sentence));
    };
    const client = createClient(
      {
        send: text => {
          stream.send(encoder.encode(`${text}\n`));
        },
        close() {
          stream.close();
        },
      },
      () => scheduler.now_s(),
      hear,
    );
    const life = scheduler.every(ALIVE_S, () => {
      client.alive(STATION);
      if (pinging || !isOpen) return;
      pinging = true;
      void client.ping().then(seconds => {
        pinging = false;
        if (session === mine && Number.isFinite(seconds)) events.roundTrip(seconds);
      });
    });
    const mine: Session = {
      client,
      end() {
        life();
        client.gone();
        stream.close();
      },
    };
    session = mine;

    const signals = new Map<string, boolean | number>();
    const q_rad = new Float64Array(n);
    const lent: { -readonly [K in keyof JointSample]: JointSample[K] } = {
      sequence: 0,
      time_s: 0,
      q_rad,
      moving: false,
      mode: "remote",
      safety: "normal",
      override: 1,
      gripperClosed: false,
      step: "",
      message: "",
      signals,
    };
    function sample(message: EventOf<"sample">): void {
      if (message.q_rad.length !== n) {
        endAsUnfit(`The plug-in of “${named}” tells ${message.q_rad.length} joints; ${robot.name} has ${n}.`);
        return;
      }
      q_rad.set(message.q_rad);
      for (const signal in message.signals) signals.set(signal, message.signals[signal]!);
      if (Number.isNaN(offset)) offset = last + 1 - message.sequence;
      last = Math.max(last, message.sequence + offset);
      lent.sequence = message.sequence + offset;
      lent.time_s = message.time_s;
      lent.moving = message.moving;
      lent.mode = message.mode;
      lent.safety = message.safety;
      lent.override = message.override;
      lent.gripperClosed = message.gripperClosed;
      lent.message = message.message === "" ? complaint : message.message;
      if (isOpen) events.sample(lent);
      else if (taken) {
        isOpen = true;
        settle({ kind: "open" });
      }
    }
    let named = "";
    let taken = false;
    const name = (as: string): void => {
      named = as;
      if (as !== robot.id) endAsUnfit(`The plug-in drives “${as}”; the station is of “${robot.id}”.`);
    };
    async function begin(): Promise<void> {
      const wanted = { station: STATION, brand: "plug-in", robot: robot.id };
      for (const request of [
        ...(named === "" ? [{ type: "open", ...wanted } as const] : []),
        { type: "connect", station: STATION } as const,
        { type: "take", station: STATION } as const,
      ]) {
        const outcome = await client.ask(request);
        if (outcome.kind !== "done") {
          end(outcome.why.sentence, failed(outcome.why, true));
          return;
        }
        if (named === "") {
          end("The plug-in does not say which robot it drives.");
          return;
        }
      }
      taken = true;
    }
    function hear(message: Exclude<ConnectionEvent, EventOf<"answer" | "pong">>): void {
      if (session !== mine) return;
      switch (message.type) {
        case "hello": {
          // One that was opened before and goes on running has it open still.
          const there = message.stations.find(({ id }) => id === STATION);
          if (there) name(there.robot);
          void begin();
          break;
        }
        case "opened":
          if (message.id === STATION) name(message.robot);
          break;
        case "sample":
          sample(message);
          break;
        case "link":
          if (isOpen && message.state !== "open")
            end(`The plug-in says: ${message.sentence || `its link is ${message.state}`}`);
          break;
        case "closed":
          end("The plug-in closed its station.");
          break;
        case "fault":
          end(message.sentence);
          break;
        case "guard":
        case "notice":
          break;
      }
    }
    stream.onEnd(({ sentence }) => {
      end(sentence);
    });
    stream.onBytes(
      lines(text => {
        client.hear(text);
      }, end),
    );
    return settled;
  }

  /** Runs one step as a program of its own. */
  const carryOut = async (step: Step): Promise<CommandOutcome> => {
    const mine = session;
    if (!mine) return { kind: "refused", why: gone };
    const outcome = await mine.client.ask({
      type: "run",
      station: STATION,
      program: { ...emptyProgram(robot.id, step.type), steps: [step] },
      asText: false,
    });
    return session === mine ? outcome : { kind: "stopped", why: gone };
  };
  /** What is not waited for: a refusal of it is told with the states. */
  const tell = (outcome: Promise<CommandOutcome>): null => {
    void outcome.then(came => {
      if (came.kind !== "done") complaint = came.why.sentence;
    });
    return null;
  };

  return {
    brand: "Plug-in",
    robot,
    stale_s: STALE_S,
    watchdog: {
      kind: "none",
      because:
        "what its robot does when the line breaks is its maker's to say; it is asked to stop when the signs of life stay away.",
    },
    open,
    close() {
      session?.end();
      session = null;
    },
    // What its maker's controller can say is asked of it with each command.
    cannotSay: () => null,
    move(motion) {
      complaint = "";
      return carryOut(stepOfMotion(motion));
    },
    stop(emergency) {
      session?.client.stop(STATION, emergency);
    },
    setOverride(ratio) {
      return session ? tell(session.client.ask({ type: "speed", station: STATION, percent: 100 * ratio })) : gone;
    },
    reset: () =>
      session?.client.ask({ type: "reset", station: STATION }) ?? Promise.resolve({ kind: "refused", why: gone }),
    setSignal: (signal, to) => (session ? tell(carryOut({ id: "set", type: "set", signal, to })) : gone),
    setGripper: closed => (session ? tell(carryOut({ id: "gripper", type: "gripper", closed })) : gone),
    setPayload: (mass_kg, center_m) =>
      session ? tell(carryOut({ id: "payload", type: "payload", mass_kg, center_m: [...center_m] })) : gone,
  };
}
