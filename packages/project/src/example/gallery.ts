import type { StepsCell } from "../document.ts";
import { conveyorPalletCell } from "./conveyor-pallet.ts";
import { edgeTraceCell } from "./edge-trace.ts";
import {
  deburringCell,
  gluingCell,
  infeasibleLineCell,
  inspectionCell,
  machineTendingCell,
  palletOfNineCell,
  pickAndPlaceCell,
  twinLapCell,
  weldingCell,
} from "./tasks.ts";
import { tracedCartonCell } from "./traced-carton.ts";

export interface Example {
  /** The folder of its files under examples/. */
  readonly id: string;
  /** What a person sees there, in one sentence. */
  readonly sentence: string;
  /** What its check answers: `empty` has nothing taught yet, `bad` is there to be looked into. */
  readonly check: "clear" | "empty" | "bad";
  readonly make: () => StepsCell;
}

/** The examples in the order of the start page. */
export const EXAMPLES: readonly Example[] = [
  {
    id: "01-edge-trace",
    sentence: "Click the top edges of a carton and get the program that traces them.",
    check: "empty",
    make: edgeTraceCell,
  },
  {
    id: "02-traced-carton",
    sentence: "All four edges of the carton, traced with the torch at 45°.",
    check: "clear",
    make: tracedCartonCell,
  },
  {
    id: "03-conveyor-pallet",
    sentence: "Boxes come on a belt, a photo-cell stops it, nine places take them.",
    check: "clear",
    make: conveyorPalletCell,
  },
  {
    id: "04-pick-and-place",
    sentence: "A part is carried from one side of a table to the other.",
    check: "clear",
    make: pickAndPlaceCell,
  },
  {
    id: "05-pallet-of-nine",
    sentence: "Nine boxes from a feeder onto a pallet of three by three.",
    check: "clear",
    make: palletOfNineCell,
  },
  {
    id: "06-twin-of-a-gp8",
    sentence: "A lap for a twin: connect a virtual Yaskawa, run it there, and travel back along it.",
    check: "clear",
    make: twinLapCell,
  },
  {
    id: "07-line-out-of-reach",
    sentence: "A line that leaves the reach of the arm: find out where, and mend it.",
    check: "bad",
    make: infeasibleLineCell,
  },
  {
    id: "08-machine-tending",
    sentence: "A raw part goes into the vice when the machine asks for it.",
    check: "clear",
    make: machineTendingCell,
  },
  {
    id: "09-deburring",
    sentence: "A spindle goes round the top edges of a block.",
    check: "clear",
    make: deburringCell,
  },
  { id: "10-welding", sentence: "Two parallel seams, the arc on along each.", check: "clear", make: weldingCell },
  { id: "11-gluing", sentence: "A bead of glue along three sides of a cover.", check: "clear", make: gluingCell },
  {
    id: "12-inspection",
    sentence: "A camera looks at five points of a part and is told when to measure.",
    check: "clear",
    make: inspectionCell,
  },
];
