import { allowedOverride, personInZone, type PhysicalScene, type ZoneReaction } from "@twincell/core";
import type { MujocoWorld } from "../world.ts";
import type { PhysicsEvent } from "./events.ts";

/**
 * Watches people zones and stopping sensors (rows T-27, T-57). Slowing down ends when the zone is left; a stop stays
 * until a person lets the robot go on. A prediction: what a real safety controller does is its own affair.
 */
export class SafetyWatch {
  private readonly scene: PhysicalScene;
  private readonly inside: boolean[];
  private readonly tripped: Uint8Array;
  private stopped = false;
  private last = 1;

  constructor(scene: PhysicalScene) {
    const { zones, people, sensors } = scene;
    this.scene = scene;
    this.inside = zones.flatMap(() => people.map(() => false));
    this.tripped = new Uint8Array(sensors.length);
  }

  /** What the robot may run at, 0 … 1; what changed goes to `log`. */
  look(world: MujocoWorld, log: (event: PhysicsEvent) => void): number {
    const { zones, people, sensors } = this.scene;
    const at_s = world.state.time_s;
    const reactions: ZoneReaction[] = [];
    zones.forEach((zone, z) => {
      people.forEach((person, p) => {
        const now = personInZone(zone, world.people.places[p]!);
        const at = z * people.length + p;
        if (now !== this.inside[at]) {
          this.inside[at] = now;
          log({
            at_s,
            kind: "zone",
            zone: zone.id,
            person: person.id,
            inside: now,
            sentence: `${person.name} ${now ? "entered" : "left"} “${zone.name}”.`,
          });
        }
        if (now) {
          reactions.push(zone.reaction);
          if (zone.reaction.kind === "stop") this.stopped = true;
        }
      });
    });
    sensors.forEach((sensor, i) => {
      const now = world.tripped[i]!;
      if (now !== this.tripped[i])
        log({
          at_s,
          kind: "sensor",
          sensor: sensor.id,
          tripped: now === 1,
          sentence: `“${sensor.name}” ${now === 1 ? "was tripped" : "is free again"}.`,
        });
      this.tripped[i] = now;
      if (now === 1 && sensor.stops === true) this.stopped = true;
    });
    const override = this.stopped ? 0 : allowedOverride(reactions);
    if (override !== this.last)
      log({
        at_s,
        kind: "override",
        override,
        sentence:
          override === 0
            ? "The robot is stopped; it goes on when somebody lets it."
            : override < 1
              ? `The robot is slowed down to ${Math.round(override * 100)} %.`
              : "The robot runs at its own speed again.",
      });
    this.last = override;
    return override;
  }

  /** A person lets the robot go on. Refused while what stopped it is still there. */
  resume(): { readonly kind: "done" } | { readonly kind: "refused"; readonly sentence: string } {
    const { zones, people, sensors } = this.scene;
    const zone = zones.find(
      (each, z) => each.reaction.kind === "stop" && people.some((_, p) => this.inside[z * people.length + p]),
    );
    if (zone) return { kind: "refused", sentence: `Somebody is in “${zone.name}”: the robot stays where it is.` };
    const sensor = sensors.find((each, i) => each.stops === true && this.tripped[i] === 1);
    if (sensor) return { kind: "refused", sentence: `“${sensor.name}” is tripped: the robot stays where it is.` };
    this.stopped = false;
    return { kind: "done" };
  }
}
