import { runCommand } from "../../stores/commands.ts";
import { headsetStore } from "../../stores/headset.ts";
import { gripperHeld } from "./controller-input.ts";
import { feel } from "./haptics.ts";

/**
 * Button A, or X of a left hand: held down the gripper closes, let go it opens, each a step of the program (row X-32).
 * Only while points are taught, so that a thumb that slips while a program is watched changes nothing.
 */
export class GripperButton {
  #closed = false;

  read(sources: Iterable<XRInputSource>): void {
    const { use, tab } = headsetStore.getState();
    let held: XRInputSource | null = null;
    let has = false;
    for (const source of sources) {
      const down = source.gamepad ? gripperHeld(source.gamepad, use) : null;
      if (down === null) continue;
      has = true;
      if (down) held = source;
    }
    if (!has || tab !== "teach" || (held !== null) === this.#closed) return;
    this.#closed = held !== null;
    runCommand(this.#closed ? "program.gripper-close" : "program.gripper-open");
    if (held) feel(held, "gripper");
  }
}
