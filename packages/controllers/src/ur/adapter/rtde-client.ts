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
export function openRtde(
  stream: ByteStream,
  scheduler: Scheduler,
  outputs: readonly string[],
  groups: readonly (readonly string[])[],
  frequency_Hz: number,
  events: RtdeEvents,
): Promise<RtdeOpened> {
  return new RtdeOpening(stream, scheduler, outputs, groups, frequency_Hz, events).open();
}

class RtdeOpening {
  readonly stream: ByteStream;
  readonly scheduler: Scheduler;
  readonly outputs: readonly string[];
  readonly groups: readonly (readonly string[])[];
  readonly frequency_Hz: number;
  readonly events: RtdeEvents;
  readonly frames = rtdeFrames();
  readonly state = new Float64Array(SLOTS);
  readonly inputs = new Float64Array(SLOTS);
  readonly recipes: { recipe: Recipe; buffer: Uint8Array; view: DataView }[] = [];
  waitsFor = 0;
  answer: ((payload: Uint8Array | null) => void) | null = null;
  output: Recipe | null = null;
  running = false;
  over = false;
  version: Version = [0, 0, 0, 0];
  said = `RTDE did not answer for ${PATIENCE_S} s.`;
  protocol!: Uint8Array | null;
  built!: Uint8Array | null;
  wanted!: Field[];
  set!: Uint8Array | null;
  id!: number;
  types!: string[];
  missing!: string[];
  begun!: Uint8Array | null;

  constructor(
    stream: ByteStream,
    scheduler: Scheduler,
    outputs: readonly string[],
    groups: readonly (readonly string[])[],
    frequency_Hz: number,
    events: RtdeEvents,
  ) {
    this.stream = stream;
    this.scheduler = scheduler;
    this.outputs = outputs;
    this.groups = groups;
    this.frequency_Hz = frequency_Hz;
    this.events = events;
    this.stream.onEnd(ending => {
      this.end(ending.sentence);
    });
    this.stream.onBytes(lent => {
      const why = this.frames.push(lent, this.take);
      if (why !== null) this.end(why);
    });
  }

  async open(): Promise<RtdeOpened> {
    this.protocol = await this.ask(RTDE.protocolVersion, askProtocol(2));
    if (!this.protocol) return this.failed(this.said);
    if (this.protocol[0] !== 1)
      return this.failed("The controller does not speak protocol 2 of RTDE: its software is too old.");
    this.built = await this.ask(RTDE.controllerVersion, askVersion());
    if (!this.built) return this.failed(this.said);
    this.version = readVersion(this.built) ?? this.version;
    this.wanted = named(OUTPUT_FIELDS, this.outputs);
    this.set = await this.ask(RTDE.outputs, askOutputs(this.outputs, this.frequency_Hz));
    if (!this.set) return this.failed(this.said);
    this.id = recipeAnswered(this.set, true).id;
    this.types = recipeAnswered(this.set, true).types;
    this.missing = unexpected(this.wanted, this.types);
    if (this.missing.length > 0) return this.failed(`The controller does not tell ${this.missing.join(", ")}.`);
    this.output = recipeOf(this.id, this.wanted);
    for (const names of this.groups) {
      const fields = named(INPUT_FIELDS, names);
      const had = await this.ask(RTDE.inputs, askInputs(names));
      if (!had) return this.failed(this.said);
      const is = recipeAnswered(had, true);
      const taken = fields.filter((_, i) => is.types[i] === "IN_USE");
      if (taken.length > 0)
        return this.failed(`Another client writes ${taken.map(({ name }) => name).join(", ")}: one driver at a time.`);
      const wrong = unexpected(fields, is.types);
      if (wrong.length > 0 || is.id === 0) return this.failed(`The controller does not take ${wrong.join(", ")}.`);
      const recipe = recipeOf(is.id, fields);
      const buffer = dataBuffer(recipe, true);
      this.recipes.push({ recipe, buffer, view: viewOf(buffer) });
    }
    this.running = true;
    this.begun = await this.ask(RTDE.start, start());
    if (!this.begun || this.begun[0] !== 1) {
      this.running = false;
      return this.failed(this.begun ? "The controller does not start sending states." : this.said);
    }
    // The end may have come with the answer.
    if (this.over) return { kind: "failed", sentence: this.said };
    return rtdeClientOf(this);
  }

  end(sentence: string | null): void {
    if (this.over) return;
    this.over = true;
    this.stream.close();
    this.answer?.(null);
    if (sentence === null) return;
    this.said = sentence;
    if (this.running) this.events.lost(sentence);
  }

  readonly take = (type: number, payload: Uint8Array): void => {
    if (this.over) return;
    if (type === RTDE.data) {
      // Packages under way while a recipe changes are of another length.
      if (
        this.output &&
        this.running &&
        payload[0] === this.output.id &&
        unpackData(this.output, payload.subarray(1), this.state)
      )
        this.events.state();
      return;
    }
    if (type === RTDE.text) {
      this.events.says(readText(payload, 2).message);
      return;
    }
    if (type !== this.waitsFor || !this.answer) return;
    const waiting = this.answer;
    this.answer = null;
    waiting(payload.slice());
  };

  ask(type: number, bytes: Uint8Array): Promise<Uint8Array | null> {
    return this.over
      ? Promise.resolve(null)
      : new Promise(resolve => {
          this.waitsFor = type;
          const stop = this.scheduler.every(PATIENCE_S, () => {
            stop();
            this.end(this.said);
          });
          this.answer = payload => {
            stop();
            resolve(payload);
          };
          this.stream.send(bytes);
        });
  }

  failed(sentence: string): RtdeOpened {
    this.end(null);
    return { kind: "failed", sentence };
  }
}

function rtdeClientOf(own: RtdeOpening): RtdeOpened {
  return {
    kind: "open",
    client: {
      state: own.state,
      inputs: own.inputs,
      version: own.version,
      get waiting() {
        return own.stream.waiting;
      },
      send(group) {
        const entry = own.recipes[group];
        if (!entry || own.over) return;
        packData(entry.recipe, own.inputs, entry.buffer, entry.view);
        own.stream.send(entry.buffer);
      },
      close() {
        own.end(null);
      },
    },
  };
}
