import { personAt, type PersonPlace, type PhysicalScene } from "@twincell/core";

/** Mannequins that walk: bodies that are seen and felt by sensors and push nothing. */
export class People {
  readonly places: readonly PersonPlace[];
  private readonly scene: PhysicalScene;
  constructor(scene: PhysicalScene) {
    this.scene = scene;
    this.places = scene.people.map(person => personAt(person, 0));
  }

  place(time_s: number, mocap_pos: Float64Array, mocap_quat: Float64Array): void {
    for (let i = 0; i < this.places.length; i++) {
      const place = personAt(this.scene.people[i]!, time_s, this.places[i]);
      mocap_pos[3 * i] = place.x_m;
      mocap_pos[3 * i + 1] = place.y_m;
      mocap_pos[3 * i + 2] = this.scene.floor_m ?? 0;
      mocap_quat[4 * i] = Math.cos(place.heading_rad / 2);
      mocap_quat[4 * i + 1] = 0;
      mocap_quat[4 * i + 2] = 0;
      mocap_quat[4 * i + 3] = Math.sin(place.heading_rad / 2);
    }
  }
}
