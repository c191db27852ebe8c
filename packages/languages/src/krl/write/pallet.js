import { compose, identity, palletPitch } from "@twincell/core";
import { singleText } from "../../text/index.ts";
import { frameText } from "./location.ts";
import { krlName } from "./names.ts";
const AXES = ["X", "Y", "Z"];
/** A pallet as loops: three counters, the place worked out from them, and the base that stands in it. */
export class PalletLoop {
    /** The base of the place being visited. */
    base;
    pallet;
    step;
    out;
    parent;
    origin;
    place;
    layer;
    row;
    column;
    along;
    ends = [];
    constructor({ id, pallet: name }, pallet, out, data, place) {
        this.pallet = pallet;
        this.step = id;
        this.out = out;
        const parentPose = compose(place.vendorFromWorld, place.worldFromFrame(pallet.frame));
        this.parent = data.frame("BASE_", pallet.frame, () => parentPose);
        const frame = (prefix, pose) => {
            const variable = krlName(name, data.taken, prefix);
            data.add(`DECL FRAME ${variable}={${frameText(pose)}}`);
            return variable;
        };
        this.origin = frame("FIRST_", pallet.origin);
        this.place = frame("PLACE_", pallet.origin);
        this.base = frame("BASE_", identity());
        const counter = (word) => data.counter(`${word}_${name}`);
        this.layer = counter("LAYER");
        this.row = counter("ROW");
        this.column = counter("COL");
        this.along = pallet.order?.endsWith("zigzag") === true ? counter("ALONG") : "";
    }
    begin() {
        const { pallet, row, column } = this, order = pallet.order ?? "rows", byRows = order.startsWith("rows");
        const line = byRows ? row : column, within = byRows ? column : row, isShifted = pallet.interleave === "odd-rows-shifted";
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
        if (!byRows && isShifted)
            this.open(`IF ${column}<${pallet.columns}-(${row} B_AND 1) THEN`, "ENDIF");
        this.where(isShifted);
        this.add(`${this.base}=${this.parent}:${this.place}`);
    }
    end() {
        for (const word of this.ends.reverse()) {
            this.out.depth--;
            this.add(word);
        }
    }
    where(isShifted) {
        const pitch = palletPitch(this.pallet);
        const share = (counter, by, i) => {
            const text = singleText(by[i] * 1000);
            return text === "0" ? "" : `+${counter}*${text.startsWith("-") ? `(${text})` : text}`;
        };
        for (const [i, axis] of AXES.entries()) {
            const sum = share(isShifted ? `(${this.column}+0.5*(${this.row} B_AND 1))` : this.column, pitch.column, i) + share(this.row, pitch.row, i) + share(this.layer, pitch.layer, i);
            if (sum !== "")
                this.add(`${this.place}.${axis}=${this.origin}.${axis}${sum}`);
        }
    }
    open(line, end) {
        this.add(line);
        this.out.depth++;
        if (end !== "")
            this.ends.push(end);
    }
    add(line) { this.out.add(line, this.step); }
}
