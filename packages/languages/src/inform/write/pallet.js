import { palletPitch, rotate } from "@twincell/core";
/** Shifts are counted in µm. */
const PER_M = 1e6;
/** A pallet as loops: counters, the shift worked out from them, and SFTON around the motions to its places. */
export class PalletLoop {
    /** The variable that holds the shift. */
    shift;
    pallet;
    step;
    add;
    frame;
    pitch;
    i;
    d;
    ends = [];
    /** @param vendorFromWorld  shifts along the world are given along the axes of the robot. */
    constructor({ id }, pallet, controller, vendorFromWorld, add) {
        this.pallet = pallet;
        this.step = id;
        this.add = add;
        const pitch = palletPitch(pallet), isWorld = pallet.frame === "world", along = (by) => isWorld ? rotate(vendorFromWorld.quaternion, by) : by;
        this.pitch = { column: along(pitch.column), row: along(pitch.row), layer: along(pitch.layer) };
        this.frame = isWorld ? "BF" : `UF#(${controller.user(pallet.frame)})`;
        this.shift = controller.variable("P");
        const i = () => controller.variable("I"), d = () => controller.variable("D");
        this.i = { layer: i(), line: i(), along: i(), last: i() };
        this.d = { row: d(), column: d(), odd: d(), sum: d(), part: d() };
    }
    begin() {
        const { pallet, i, d } = this, order = pallet.order ?? "rows", byRows = order.startsWith("rows"), isZigzag = order.endsWith("zigzag"), isShifted = pallet.interleave === "odd-rows-shifted";
        const line = byRows ? d.row : d.column, within = byRows ? d.column : d.row;
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
            this.say(`SET ${d.part} ${i.last}`, `SUB ${d.part} ${i.along}`, `SUB ${d.part} ${i.along}`, `MUL ${d.part} ${d.odd}`, `ADD ${within} ${d.part}`);
        }
        if (isShifted) {
            this.odd(d.row);
            // By columns, a shifted row has no place in the last one.
            if (!byRows) {
                this.say(`SET ${d.part} ${d.column}`, `ADD ${d.part} ${d.odd}`);
                this.open(`IFTHENEXP ${d.part}<${pallet.columns}`, "ENDIF");
            }
        }
        for (const n of [0, 1, 2])
            this.element(n, isShifted);
    }
    end() { for (const line of this.ends.reverse())
        this.say(line); }
    on() { return `SFTON ${this.shift} ${this.frame}`; }
    element(n, isShifted) {
        const { d, i, pitch } = this, by = (vector) => Math.round(vector[n] * PER_M);
        this.say(`SET ${d.sum} 0`);
        const share = (counter, each) => {
            if (each !== 0)
                this.say(`SET ${d.part} ${each}`, `MUL ${d.part} ${counter}`, `ADD ${d.sum} ${d.part}`);
        };
        share(d.column, by(pitch.column));
        if (isShifted)
            share(d.odd, Math.round(pitch.column[n] * PER_M / 2));
        share(d.row, by(pitch.row));
        share(i.layer, by(pitch.layer));
        this.say(`SETE ${this.shift} (${n + 1}) ${d.sum}`);
    }
    /** 1 in every second row, worked out with divisions of whole numbers. */
    odd(of) {
        const { odd, part } = this.d;
        this.say(`SET ${part} ${of}`, `DIV ${part} 2`, `MUL ${part} 2`, `SET ${odd} ${of}`, `SUB ${odd} ${part}`);
    }
    open(line, end) {
        this.say(line);
        this.ends.push(end);
    }
    say(...lines) { for (const line of lines)
        this.add(line, this.step); }
}
