import type { EmittedFile, UploadedProgram } from "@twincell/core";
import { ADDED, COMMAND, CYCLE, SERVICE, word, writeSelection } from "../codec/index.ts";
import type { Client } from "./client.ts";
import type { FileClient } from "./files.ts";
import type { Hand } from "./hand.ts";
import { badName, noJob, notTaken } from "./words.ts";

const PATIENCE_S = [0.3, 0.5, 1];

/**
 * Saves jobs, and what they mean by numbers, on the controller, and selects the first job; started it runs once to its
 * end.
 */
export async function handJob(
  files: readonly EmittedFile[],
  client: Client,
  store: FileClient,
  hand: Hand,
): Promise<UploadedProgram> {
  const { stops } = hand;
  const first = files.find(({ name }) => /\.jbi$/i.test(name));
  if (!first) return { kind: "refused", why: noJob() };
  for (const { name, text } of files) {
    if (!/^[\x20-\x7E]{1,32}\.[A-Za-z]{3}$/.test(name)) return { kind: "refused", why: badName(name) };
    let saved = await store.save(name, text);
    // A controller that does not write over a job: the old one goes first.
    if (saved.kind === "refused" && saved.added === ADDED.sameJob) {
      const removed = await store.remove(name);
      saved = removed.kind === "done" ? await store.save(name, text) : removed;
    }
    if (saved.kind === "refused") return { kind: "refused", why: saved.why };
  }
  const select = await client.ask({
    command: COMMAND.select,
    instance: 1,
    attribute: 0,
    service: SERVICE.setAll,
    data: writeSelection(first.name.slice(0, -4)),
    patience_s: PATIENCE_S,
  });
  if (select.kind === "silent" || select.reply.status !== 0)
    return { kind: "refused", why: notTaken(`Selecting ${first.name}`, select) };
  const cycle = await client.ask({
    command: COMMAND.cycle,
    instance: 2,
    attribute: 1,
    service: SERVICE.setOne,
    data: word(CYCLE.once),
    patience_s: PATIENCE_S,
  });
  if (cycle.kind === "silent" || cycle.reply.status !== 0)
    return { kind: "refused", why: notTaken("Choosing one cycle", cycle) };
  return {
    kind: "handed",
    start: () => hand.runJob(stops),
    drop() {
      /* A job that is selected moves nothing. */
    },
  };
}
