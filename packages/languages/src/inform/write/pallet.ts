import { palletPitch, rotate, type Pallet, type PalletStep, type Pose, type Vector3 } from "@twincell/core";
import type { Controller } from "./controller.ts";

/** Shifts are counted in µm. */
const PER_M = 1e6;

/** A pallet as loops: counters, the shift worked out from them, and SFTON around the motions to its places. */
export class PalletLoop {
  /** The variable that holds the shift. */
  readonly shift: string;
  private readonly pallet: Pallet;
  private readonly step: string;
  private readonly add: (line: string, step: string) => void;
  private readonly frame: string;
  private readonly pitch: { readonly column: Vector3; readonly row: Vector3; readonly layer: Vector3 };
  private readonly i: { readonly layer: string; readonly line: string; readonly along: string; readonly last: string };
  private readonly d: {
    readonly row: string;
    readonly column: string;
    readonly odd: string;
    readonly sum: string;
    readonly part: string;
  };
  private readonly ends: string[] = [];

  /** @param vendorFromWorld  shifts along the world are given along the axes of the robot. */
  constructor(
    { id }: PalletStep,
    pallet: Pallet,
    controller: Controller,
    vendorFromWorld: Pose,
    add: (line: string, step: string) => void,
  ) {
    this.pallet = pallet;
    this.step = id;
    this.add = add;
    const pitch = palletPitch(pallet);
    const isWorld = pallet.frame === "world";
    const along = (by: Vector3): Vector3 => (isWorld ? rotate(vendorFromWorld.quaternion, by) : by);
    this.pitch = { column: along(pitch.column), row: along(pitch.row), layer: along(pitch.layer) };
    this.frame = isWorld ? "BF" : `UF#(${controller.user(pallet.frame)})`;
    this.shift = controller.variable("P");
    const i = (): string => controller.variable("I");
    const d = (): string => controller.variable("D");
    this.i = { layer: i(), line: i(), along: i(), last: i() };
    this.d = { row: d(), column: d(), odd: d(), sum: d(), part: d() };
  }

  begin(): void {
    const { pallet, i, d } = this;
    const order = pallet.order ?? "rows";
    const byRows = order.startsWith("rows");
    const isZigzag = order.endsWith("zigzag");
    const isShifted = pallet.interleave === "odd-rows-shifted";
    const line = byRows ? d.row : d.column;
    const within = byRows ? d.column : d.row;
    this.open(`FOR ${i.layer} START= 0 TO ${pallet.layers - 1}`, `NEXT ${i.layer}`);
    this.open(`FOR ${i.line} START= 0 TO ${(byRows ? pallet.rows : pallet.columns) - 1}`, `NEXT ${i.line}`);
    this.say(`SET ${line} ${i.line}`);
    this.say(`SET ${i.last} ${(byRows ? pallet.columns : pallet.rows) - 1}`);
    if (byRows && isShifted) {
      this.odd(d.row);
      this.say(`SUB ${i.last} ${d.odd}`);
    }
    this.open(`FOR ${i.along} START= 0 TO ${i.last}`, `NEXT ${i.along}`);
    this.say(`SET ${within} ${i.along}`);
    if (isZigzag) {
      // In every second line the count runs backwards: along + odd · (last - 2 · along).
      this.odd(line);
      this.say(
        `SET ${d.part} ${i.last}`,
        `SUB ${d.part} ${i.along}`,
        `SUB ${d.part} ${i.along}`,
        `MUL ${d.part} ${d.odd}`,
        `ADD ${within} ${d.part}`,
      );
    }
    if (isShifted) {
      this.odd(d.row);
      // By columns, a shifted row has no place in the last one.
      if (!byRows) {
        this.say(`SET ${d.part} ${d.column}`, `ADD ${d.part} ${d.odd}`);
        this.open(`IFTHENEXP ${d.part}<${pallet.columns}`, "ENDIF");
      }
    }
    for (const n of [0, 1, 2]) this.element(n, isShifted);
  }

  end(): void {
    for (const line of this.ends.reverse()) this.say(line);
  }

  on(): string {
    return `SFTON ${this.shift} ${this.frame}`;
  }

  private element(n: number, isShifted: boolean): void {
    const { d, i, pitch } = this;
    const by = (vector: Vector3): number => Math.round(vector[n]! * PER_M);
    this.say(`SET ${d.sum} 0`);
    const share = (counter: string, each: number): void => {
      if (each !== 0) this.say(`SET ${d.part} ${each}`, `MUL ${d.part} ${counter}`, `ADD ${d.sum} ${d.part}`);
    };
    share(d.column, by(pitch.column));
    if (isShifted) share(d.odd, Math.round((pitch.column[n]! * PER_M) / 2));
    share(d.row, by(pitch.row));
    share(i.layer, by(pitch.layer));
    this.say(`SETE ${this.shift} (${n + 1}) ${d.sum}`);
  }

  /** 1 in every second row, worked out with divisions of whole numbers. */
  private odd(of: string): void {
    const { odd, part } = this.d;
    this.say(`SET ${part} ${of}`, `DIV ${part} 2`, `MUL ${part} 2`, `SET ${odd} ${of}`, `SUB ${odd} ${part}`);
  }

  private open(line: string, end: string): void {
    this.say(line);
    this.ends.push(end);
  }

  private say(...lines: string[]): void {
    for (const line of lines) this.add(line, this.step);
  }
}
