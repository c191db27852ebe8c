import type { Scheduler } from "@twincell/core";
import type { ByteStream } from "../../transport/index.ts";
import {
  askInputs,
  askOutputs,
  askProtocol,
  askVersion,
  dataBuffer,
  packData,
  readText,
  readVersion,
  recipeAnswered,
  recipeOf,
  RTDE,
  rtdeFrames,
  start,
  unexpected,
  unpackData,
  viewOf,
  type Recipe,
  type Version,
} from "../codec/rtde.ts";
import { INPUT_FIELDS, OUTPUT_FIELDS, SLOTS, type Field } from "../codec/rtde-fields.ts";

export interface RtdeClient {
  /** The last state that came, by the slots of the fields. */
  readonly state: Float64Array;
  /** What is written next, by the slots of the fields. */
  readonly inputs: Float64Array;
  readonly version: Version;
  /** Bytes not yet taken: a line that is stuck. */
  readonly waiting: number;
  /** Sends the slots of one of the groups of inputs, by its place in the list. */
  send(group: number): void;
  close(): void;
}
export interface RtdeEvents {
  /** A state has come. */
  state(): void;
  says(message: string): void;
  lost(sentence: string): void;
}
export type RtdeOpened =
  | { readonly kind: "open"; readonly client: RtdeClient }
  | { readonly kind: "failed"; readonly sentence: string };

/** One step of setting up is not answered for this long: failed [s]. */
const PATIENCE_S = 2;
const named = (table: ReadonlyMap<string, Field>, names: readonly string[]): Field[] =>
  names.flatMap(name => table.get(name) ?? []);

/** Sets up protocol 2 with these outputs and groups of inputs, and starts. The stream is this client's from here on. */
export async function openRtde(
  stream: ByteStream,
  scheduler: Scheduler,
  outputs: readonly string[],
  groups: readonly (readonly string[])[],
  frequency_Hz: number,
  events: RtdeEvents,
): Promise<RtdeOpened> {
  const frames = rtdeFrames();
  const state = new Float64Array(SLOTS);
  const inputs = new Float64Array(SLOTS);
  const recipes: { recipe: Recipe; buffer: Uint8Array; view: DataView }[] = [];
  let waitsFor = 0;
  let answer: ((payload: Uint8Array | null) => void) | null = null;
  let output: Recipe | null = null;
  let running = false;
  let over = false;
  let version: Version = [0, 0, 0, 0];

  function end(sentence: string | null): void {
    if (over) return;
    over = true;
    stream.close();
    answer?.(null);
    if (sentence === null) return;
    said = sentence;
    if (running) events.lost(sentence);
  }
  let said = `RTDE did not answer for ${PATIENCE_S} s.`;
  function take(type: number, payload: Uint8Array): void {
    if (over) return;
    if (type === RTDE.data) {
      // Packages under way while a recipe changes are of another length.
      if (output && running && payload[0] === output.id && unpackData(output, payload.subarray(1), state))
        events.state();
      return;
    }
    if (type === RTDE.text) {
      events.says(readText(payload, 2).message);
      return;
    }
    if (type !== waitsFor || !answer) return;
    const waiting = answer;
    answer = null;
    waiting(payload.slice());
  }
  stream.onEnd(ending => {
    end(ending.sentence);
  });
  stream.onBytes(lent => {
    const why = frames.push(lent, take);
    if (why !== null) end(why);
  });

  const ask = (type: number, bytes: Uint8Array): Promise<Uint8Array | null> =>
    over
      ? Promise.resolve(null)
      : new Promise(resolve => {
          waitsFor = type;
          const stop = scheduler.every(PATIENCE_S, () => {
            stop();
            end(said);
          });
          answer = payload => {
            stop();
            resolve(payload);
          };
          stream.send(bytes);
        });
  const failed = (sentence: string): RtdeOpened => {
    end(null);
    return { kind: "failed", sentence };
  };

  const protocol = await ask(RTDE.protocolVersion, askProtocol(2));
  if (!protocol) return failed(said);
  if (protocol[0] !== 1) return failed("The controller does not speak protocol 2 of RTDE: its software is too old.");
  const built = await ask(RTDE.controllerVersion, askVersion());
  if (!built) return failed(said);
  version = readVersion(built) ?? version;

  const wanted = named(OUTPUT_FIELDS, outputs);
  const set = await ask(RTDE.outputs, askOutputs(outputs, frequency_Hz));
  if (!set) return failed(said);
  const { id, types } = recipeAnswered(set, true);
  const missing = unexpected(wanted, types);
  if (missing.length > 0) return failed(`The controller does not tell ${missing.join(", ")}.`);
  output = recipeOf(id, wanted);

  for (const names of groups) {
    const fields = named(INPUT_FIELDS, names);
    const had = await ask(RTDE.inputs, askInputs(names));
    if (!had) return failed(said);
    const is = recipeAnswered(had, true);
    const taken = fields.filter((_, i) => is.types[i] === "IN_USE");
    if (taken.length > 0)
      return failed(`Another client writes ${taken.map(({ name }) => name).join(", ")}: one driver at a time.`);
    const wrong = unexpected(fields, is.types);
    if (wrong.length > 0 || is.id === 0) return failed(`The controller does not take ${wrong.join(", ")}.`);
    const recipe = recipeOf(is.id, fields);
    const buffer = dataBuffer(recipe, true);
    recipes.push({ recipe, buffer, view: viewOf(buffer) });
  }
  running = true;
  const begun = await ask(RTDE.start, start());
  if (!begun || begun[0] !== 1) {
    running = false;
    return failed(begun ? "The controller does not start sending states." : said);
  }
  // The end may have come with the answer.
  if (over) return { kind: "failed", sentence: said };
  return {
    kind: "open",
    client: {
      state,
      inputs,
      version,
      get waiting() {
        return stream.waiting;
      },
      send(group) {
        const entry = recipes[group];
        if (!entry || over) return;
        packData(entry.recipe, inputs, entry.buffer, entry.view);
        stream.send(entry.buffer);
      },
      close() {
        end(null);
      },
    },
  };
}
