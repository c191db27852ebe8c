import { compose, identity, palletPitch, type Pallet, type PalletStep, type Pose, type Vector3 } from "@twincell/core";
import { singleText } from "../../parser/index.ts";
import type { DataList } from "./data.ts";
import { frameText } from "./location.ts";
import { krlName } from "./names.ts";
import type { BlockWriter, WalkedPlace } from "../../emitter/index.ts";

const AXES = ["X", "Y", "Z"] as const;

/** A pallet as loops: three counters, the place worked out from them, and the base that stands in it. */
export class PalletLoop {
  /** The base of the place being visited. */
  readonly base: string;
  private readonly pallet: Pallet;
  private readonly step: string;
  private readonly out: BlockWriter;
  private readonly parent: string;
  private readonly origin: string;
  private readonly place: string;
  private readonly layer: string;
  private readonly row: string;
  private readonly column: string;
  private readonly along: string;
  private readonly ends: string[] = [];

  constructor({ id, pallet: name }: PalletStep, pallet: Pallet, out: BlockWriter, data: DataList, place: WalkedPlace) {
    this.pallet = pallet;
    this.step = id;
    this.out = out;
    const parentPose: Pose = compose(place.vendorFromWorld, place.worldFromFrame(pallet.frame));
    this.parent = data.frame("BASE_", pallet.frame, () => parentPose);
    const frame = (prefix: string, pose: Pose): string => {
      const variable = krlName(name, data.taken, prefix);
      data.add(`DECL FRAME ${variable}={${frameText(pose)}}`);
      return variable;
    };
    this.origin = frame("FIRST_", pallet.origin);
    this.place = frame("PLACE_", pallet.origin);
    this.base = frame("BASE_", identity());
    const counter = (word: string): string => data.counter(`${word}_${name}`);
    this.layer = counter("LAYER");
    this.row = counter("ROW");
    this.column = counter("COL");
    this.along = pallet.order?.endsWith("zigzag") === true ? counter("ALONG") : "";
  }

  begin(): void {
    const { pallet, row, column } = this;
    const order = pallet.order ?? "rows";
    const byRows = order.startsWith("rows");
    const line = byRows ? row : column;
    const within = byRows ? column : row;
    const isShifted = pallet.interleave === "odd-rows-shifted";
    this.open(`FOR ${this.layer}=0 TO ${pallet.layers - 1}`, "ENDFOR");
    this.open(`FOR ${line}=0 TO ${(byRows ? pallet.rows : pallet.columns) - 1}`, "ENDFOR");
    const last = byRows ? `${pallet.columns - 1}${isShifted ? `-(${row} B_AND 1)` : ""}` : `${pallet.rows - 1}`;
    this.open(`FOR ${this.along === "" ? within : this.along}=0 TO ${last}`, "ENDFOR");
    if (this.along !== "") {
      this.add(`${within}=${this.along}`);
      this.open(`IF (${line} B_AND 1)==1 THEN`, "");
      this.add(`${within}=${last}-${this.along}`);
      this.out.depth--;
      this.add("ENDIF");
    }
    // By columns, a shifted row has no place in the last one.
    if (!byRows && isShifted) this.open(`IF ${column}<${pallet.columns}-(${row} B_AND 1) THEN`, "ENDIF");
    this.where(isShifted);
    this.add(`${this.base}=${this.parent}:${this.place}`);
  }

  end(): void {
    for (const word of this.ends.reverse()) {
      this.out.depth--;
      this.add(word);
    }
  }

  private where(isShifted: boolean): void {
    const pitch = palletPitch(this.pallet);
    const share = (counter: string, by: Vector3, i: number): string => {
      const text = singleText(by[i]! * 1000);
      return text === "0" ? "" : `+${counter}*${text.startsWith("-") ? `(${text})` : text}`;
    };
    for (const [i, axis] of AXES.entries()) {
      const sum =
        share(isShifted ? `(${this.column}+0.5*(${this.row} B_AND 1))` : this.column, pitch.column, i) +
        share(this.row, pitch.row, i) +
        share(this.layer, pitch.layer, i);
      if (sum !== "") this.add(`${this.place}.${axis}=${this.origin}.${axis}${sum}`);
    }
  }

  private open(line: string, end: string): void {
    this.add(line);
    this.out.depth++;
    if (end !== "") this.ends.push(end);
  }

  private add(line: string): void {
    this.out.add(line, this.step);
  }
}
