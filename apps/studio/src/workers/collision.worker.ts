import { watchCell, type Sight } from "@twincell/core";
import type { FromWatcher, ToWatcher } from "./messages.ts";

let look: ((q_rad: ArrayLike<number>) => Sight) | undefined;
let edition = 0;
const answer = (message: FromWatcher): void => {
  postMessage(message);
};

addEventListener("message", ({ data }: MessageEvent<ToWatcher>) => {
  try {
    if (data.kind === "cell") {
      look = watchCell(data.cell);
      edition = data.edition;
      return;
    }
    if (!look) return;
    const began = performance.now();
    const { contacts, touched, clearance } = look(data.q_rad);
    answer({
      kind: "sight",
      edition,
      contacts: contacts.map(({ a, b }) => [a, b] as const),
      touched: [...touched],
      clearance_m: clearance.distance_m,
      nearest: [clearance.a, clearance.b],
      took_ms: performance.now() - began,
    });
  } catch (problem) {
    answer({
      kind: "trouble",
      sentence: `The collision check stopped: ${problem instanceof Error ? problem.message : String(problem)}.`,
    });
  }
});
