import { robotById, type JointSample, type Robot } from "@twincell/core";
import { readConnectionEvent, type ConnectionEvent, type RobotServer, type ServedConnection } from "@twincell/protocol";

/** What is known of one open robot; written in place, so that whoever reads it at its own pace allocates nothing. */
export interface RobotState {
  readonly id: string;
  readonly name: string;
  /** Null for a model that this release does not know. */
  readonly model: Robot | null;
  readonly virtual: boolean;
  readonly connection: ServedConnection;
  /** Names of the joints, base first. */
  readonly joints: readonly string[];
  readonly q_rad: Float64Array;
  /** From the last two samples and the controller's own time. */
  readonly speed_rad_s: Float64Array;
  readonly signals: Map<string, boolean | number>;
  /** Null before the first sample. */
  sample: Omit<JointSample, "q_rad" | "target_rad" | "signals"> | null;
  /** When the last sample came, on the clock of the day [ms]. */
  heard_ms: number;
}

export interface RobotStateListener {
  readonly opened?: (robot: RobotState) => void;
  readonly closed?: (robot: RobotState) => void;
  /** At the rate of the controller. */
  readonly sample?: (robot: RobotState) => void;
  /** A line in or out is new or has another value. */
  readonly signals?: (robot: RobotState) => void;
  /** Acts, notices, links and guards as they are told. */
  readonly event?: (event: ConnectionEvent) => void;
}

/** The open robots of a server as interfaces of other makers read them. */
export interface RobotStates {
  readonly all: ReadonlyMap<string, RobotState>;
  /** Told of the robots that are open already as well. */
  listen(listener: RobotStateListener): () => void;
  close(): void;
}
const MOST_SAID = 100;
const OWN_WORDS = /^\{"type":"(sample|pendant|answer|pong|ahead)"/;

/**
 * @param now_ms   clock of the day.
 * @param trouble  told, once for each sentence, of a listener that failed: an interface keeps no robot from working.
 */
export function robotStates(host: RobotServer, now_ms: () => number, trouble: (sentence: string) => void): RobotStates {
  const all = new Map<string, RobotState>();
  const offs = new Map<string, () => void>();
  const listeners = new Set<RobotStateListener>();
  const said = new Set<string>();
  const tell = (call: (listener: RobotStateListener) => void, only?: RobotStateListener): void => {
    for (const listener of only ? [only] : listeners)
      try {
        call(listener);
      } catch (problem) {
        const sentence = `An interface failed: ${problem instanceof Error ? problem.message : String(problem)}.`;
        if (said.has(sentence) || said.size >= MOST_SAID) continue;
        said.add(sentence);
        trouble(sentence);
      }
  };

  function take(robot: RobotState, sample: JointSample): void {
    const { q_rad, speed_rad_s } = robot;
    const passed_s = robot.sample === null ? 0 : sample.time_s - robot.sample.time_s;
    for (let i = 0; i < q_rad.length; i++) {
      const q = sample.q_rad[i] ?? 0;
      speed_rad_s[i] = passed_s > 0 ? (q - q_rad[i]!) / passed_s : 0;
      q_rad[i] = q;
    }
    let changed = false;
    if (sample.signals)
      for (const [name, value] of sample.signals)
        if (robot.signals.get(name) !== value) {
          robot.signals.set(name, value);
          changed = true;
        }
    const { sequence, time_s, moving, mode, safety, override, gripperClosed, step, message } = sample;
    robot.sample = { sequence, time_s, moving, mode, safety, override, gripperClosed, step, message };
    robot.heard_ms = now_ms();
    tell(listener => listener.sample?.(robot));
    if (changed) tell(listener => listener.signals?.(robot));
  }
  function open(connection: ServedConnection): void {
    const { id, name, robot: model, virtual } = connection.words;
    const known = robotById(model) ?? null;
    const joints = known?.arm.joints.map(joint => joint.name) ?? [];
    const robot: RobotState = {
      id,
      name,
      model: known,
      virtual,
      connection,
      joints,
      q_rad: new Float64Array(joints.length),
      speed_rad_s: new Float64Array(joints.length),
      signals: new Map(),
      sample: null,
      heard_ms: 0,
    };
    all.set(id, robot);
    offs.set(
      id,
      connection.onSample(sample => {
        take(robot, sample);
      }),
    );
    tell(listener => listener.opened?.(robot));
  }
  function shut(id: string): void {
    const robot = all.get(id);
    if (!robot) return;
    offs.get(id)?.();
    offs.delete(id);
    all.delete(id);
    tell(listener => listener.closed?.(robot));
  }
  const place = host.join("interfaces", {
    send(text) {
      if (OWN_WORDS.test(text)) return;
      const heard = readConnectionEvent(text);
      if (heard.kind === "fault") return;
      const { message } = heard;
      if (message.type === "opened") {
        const connection = host.stations.find(({ words }) => words.id === message.id);
        if (connection && all.get(message.id)?.connection !== connection) {
          shut(message.id);
          open(connection);
        }
      } else if (message.type === "closed") shut(message.station);
      tell(listener => listener.event?.(message));
    },
    close: () => undefined,
  });
  for (const connection of host.stations) open(connection);
  return {
    all,
    listen(listener) {
      listeners.add(listener);
      for (const robot of all.values()) tell(each => each.opened?.(robot), listener);
      return () => {
        listeners.delete(listener);
      };
    },
    close() {
      place.leave();
      for (const id of [...all.keys()]) shut(id);
      listeners.clear();
    },
  };
}
