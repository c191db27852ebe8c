import type { PhysicalScene, Seen, Sensor, Signals } from "@twincell/core";
import type { Engine, MjData, MjModel } from "./engine.ts";
import { GROUP } from "./model/contact-bits.ts";
import { SENSOR_POINT_M } from "./model/scene.ts";

/** Sensors are read every so many steps: 250 times a second, as slow photo-cells are. */
const EVERY = 2;
const GROUPS = 6;

/** Photo-cells and proximity sensors: they look at the solids and drive their lines (rows T-27, T-55). */
export class SensorBank {
  readonly tripped: Uint8Array;
  private readonly scene: PhysicalScene;
  private readonly signals: Signals;
  private readonly engine: Engine;
  private readonly model: MjModel;
  private readonly data: MjData;
  private readonly rays: readonly (
    | { readonly from: number[]; readonly along: number[]; readonly groups: number[] }
    | undefined
  )[];
  private readonly points: readonly number[];
  private readonly geom: ReturnType<Engine["IntBuffer"]["FromArray"]>;
  private readonly ends: ReturnType<Engine["DoubleBuffer"]["FromArray"]>;
  private readonly normal: ReturnType<Engine["DoubleBuffer"]["FromArray"]>;

  constructor(engine: Engine, model: MjModel, data: MjData, scene: PhysicalScene, signals: Signals) {
    this.engine = engine;
    this.model = model;
    this.data = data;
    this.scene = scene;
    this.signals = signals;
    this.tripped = new Uint8Array(scene.sensors.length);
    this.rays = scene.sensors.map(sensor =>
      sensor.kind !== "beam"
        ? undefined
        : {
            from: [...sensor.from_m],
            along: sensor.from_m.map((from, k) => sensor.to_m[k]! - from),
            groups: groupsOf(sensor.sees),
          },
    );
    this.points = scene.sensors.map((_, i) => engine.mj_name2id(model, engine.mjtObj.mjOBJ_GEOM.value, `sensor${i}`));
    this.ends = engine.DoubleBuffer.FromArray([0, 0, 0, 0, 0, 0]);
    this.geom = engine.IntBuffer.FromArray([0]);
    this.normal = engine.DoubleBuffer.FromArray([0, 0, 0]);
  }

  look(steps: number): void {
    if (steps % EVERY !== 0) return;
    this.scene.sensors.forEach((sensor, i) => {
      const ray = this.rays[i];
      const now = ray !== undefined ? this.cut(ray) : sensor.kind === "proximity" && this.near(sensor, this.points[i]!);
      if (now === (this.tripped[i] === 1) && steps > 0) return;
      this.tripped[i] = now ? 1 : 0;
      this.signals.write(sensor.signal, now);
    });
  }

  reset(): void {
    this.tripped.fill(0);
  }

  close(): void {
    this.geom.delete();
    this.normal.delete();
    this.ends.delete();
  }

  /** Something is hit before the far end: distances count in lengths of the beam. */
  private cut({
    from,
    along,
    groups,
  }: {
    readonly from: number[];
    readonly along: number[];
    readonly groups: number[];
  }): boolean {
    const share = this.engine.mj_ray(this.model, this.data, from, along, groups, true, -1, this.geom, this.normal);
    return share >= 0 && share <= 1;
  }

  /** Something that is seen is nearer than the range; balls around solids rule the far ones out. */
  private near({ at_m, range_m, sees }: Extract<Sensor, { kind: "proximity" }>, point: number): boolean {
    const { model, data } = this;
    const groups = groupsOf(sees);
    const group = model.geom_group as Int32Array;
    const at = data.geom_xpos as Float64Array;
    const ball = model.geom_rbound as Float64Array;
    for (let g = 0; g < group.length; g++) {
      if (groups[group[g]!] !== 1) continue;
      const dx = at[3 * g]! - at_m[0];
      const dy = at[3 * g + 1]! - at_m[1];
      const dz = at[3 * g + 2]! - at_m[2];
      if (Math.sqrt(dx * dx + dy * dy + dz * dz) - ball[g]! > range_m) continue;
      if (this.engine.mj_geomDistance(model, data, point, g, range_m, this.ends) + SENSOR_POINT_M < range_m)
        return true;
    }
    return false;
  }
}

const groupsOf = (sees: readonly Seen[]): number[] =>
  Array.from({ length: GROUPS }, (_, group) => (sees.some(seen => GROUP[seen] === group) ? 1 : 0));
