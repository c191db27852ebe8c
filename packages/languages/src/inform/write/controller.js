import { compose } from "@twincell/core";
import { rectanText } from "./location.ts";
import { titleText } from "./names.ts";
import { TextWriter } from "./text-writer.ts";
/** Tools 0 … 63 and user frames 1 … 63; variables of a kind 0 … 99. */
const LAST_FRAME = 63, LAST_VARIABLE = 99;
/** What a controller keeps outside of jobs, numbered in the order of use: tools, user frames, variables. */
export class Controller {
    /** Numbers that ran out. */
    spent = new Set();
    place;
    tools = new Map([["flange", 0]]);
    users = new Map();
    used = { I: 0, D: 0, P: 0 };
    constructor(place) { this.place = place; }
    tool(name) { return this.numbered(this.tools, name, this.tools.size, "tools"); }
    user(name) { return this.numbered(this.users, name, this.users.size + 1, "user frames"); }
    variable(letter) {
        if (this.used[letter] > LAST_VARIABLE)
            this.spent.add(`${letter} variables`);
        return `${letter}${String(this.used[letter]++).padStart(3, "0")}`;
    }
    /** The user frame of a name, in robot coordinates. */
    vendorFromFrame(name) { return compose(this.place.vendorFromWorld, this.place.worldFromFrame(name)); }
    /** TOOL.CND and UFRAME.CND with the numbers that the jobs mean. */
    files() {
        const files = [];
        if (this.tools.size > 1) {
            const out = new TextWriter();
            for (const [name, number] of this.tools) {
                if (number === 0)
                    continue;
                out.add(`//TOOL ${number}`);
                out.add(`///NAME ${titleText(name)}`);
                out.add(rectanText(this.place.tool(name)));
            }
            files.push(out.file("TOOL.CND"));
        }
        if (this.users.size > 0) {
            const out = new TextWriter();
            for (const [name, number] of this.users) {
                out.add(`//UFRAME ${number}`);
                out.add(`///NAME ${titleText(name)}`);
                out.add("///TOOL 0");
                out.add(`////BUSER ${rectanText(this.vendorFromFrame(name))}`);
            }
            files.push(out.file("UFRAME.CND"));
        }
        return files;
    }
    numbered(of, name, next, what) {
        const known = of.get(name);
        if (known !== undefined)
            return known;
        if (next > LAST_FRAME)
            this.spent.add(what);
        of.set(name, next);
        return next;
    }
}
