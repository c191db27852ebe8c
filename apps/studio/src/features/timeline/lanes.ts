import { isBlock, palletCount, type BlockStep, type Plan, type Program, type Step } from "@twincell/core";

/** A loop, pallet or decision while it is being carried out, from its first step to its last. */
export interface LaneBar {
  readonly key: string;
  /** The block step. */
  readonly step: string;
  /** 0 for the outermost. */
  readonly depth: number;
  readonly start_s: number;
  readonly end_s: number;
  /** When each pass begins; the first is the start. */
  readonly passes_s: readonly number[];
}

/** Where a step stands in the order in which the program is written, routines in place of their calls. */
interface Occurrence {
  readonly rank: number;
  readonly chain: readonly BlockStep[];
}
/** Routines call each other no deeper than this; a program with more is drawn without them. */
const DEEPEST = 20;

function occurrences(program: Program): ReadonlyMap<string, readonly Occurrence[]> {
  const found = new Map<string, Occurrence[]>();
  let rank = 0;
  const visit = (steps: readonly Step[], chain: readonly BlockStep[], depth: number): void => {
    if (depth > DEEPEST) return;
    for (const step of steps) {
      const at = { rank: rank++, chain };
      const known = found.get(step.id);
      if (known) known.push(at);
      else found.set(step.id, [at]);
      if (step.type === "call") visit(program.routines[step.routine] ?? [], chain, depth + 1);
      else if (step.type === "if") {
        visit(step.then, [...chain, step], depth + 1);
        visit(step.else ?? [], [...chain, step], depth + 1);
      } else if (isBlock(step)) visit(step.steps, [...chain, step], depth + 1);
    }
  };
  visit(program.steps, [], 0);
  return found;
}

/** How often a block is gone through; as often as it takes where only running it tells. */
function passesOf(block: BlockStep, program: Program): number {
  if (block.type === "if") return 1;
  if (block.type === "repeat") return block.times === "forever" ? Infinity : block.times;
  const pallet = block.type === "pallet" ? program.pallets[block.pallet] : undefined;
  return pallet === undefined ? Infinity : palletCount(pallet);
}

/**
 * The blocks of a program over its time line, nested ones one below the other, with the passes of each. A new pass
 * begins where the steps of a block begin again.
 */
export function laneBars(program: Program, plan: Plan): readonly LaneBar[] {
  const places = occurrences(program);
  const bars: LaneBar[] = [];
  const open: { block: BlockStep; start_s: number; passes_s: number[]; rank: number }[] = [];
  let last = "";
  let end_s = 0;
  const close = (depth: number): void => {
    while (open.length > depth) {
      const { block, start_s, passes_s } = open.pop()!;
      bars.push({
        key: `${block.id} ${start_s}`,
        step: block.id,
        depth: open.length,
        start_s,
        end_s,
        passes_s,
      });
    }
  };
  for (const { step, start_s, duration_s } of plan.segments) {
    if (step !== last) {
      const place = chosen(places.get(step) ?? [], open, program);
      const chain = place?.chain ?? [];
      let shared = 0;
      while (shared < chain.length && open[shared]?.block === chain[shared]) shared++;
      let again = place !== undefined && shared > 0 && place.rank <= open[shared - 1]!.rank ? shared - 1 : -1;
      // A block that has had all its passes is begun anew by the one around it.
      while (again > 0 && open[again]!.passes_s.length >= passesOf(open[again]!.block, program)) again--;
      // What begins again in an outer block begins its inner ones anew.
      close(again < 0 ? shared : again + 1);
      if (again >= 0) open[again]!.passes_s.push(start_s);
      for (const block of chain.slice(open.length)) open.push({ block, start_s, passes_s: [start_s], rank: -1 });
      if (place) for (const each of open) each.rank = place.rank;
      last = step;
    }
    end_s = start_s + duration_s;
  }
  close(0);
  return bars.sort((a, b) => a.depth - b.depth || a.start_s - b.start_s);
}

/** Of the places that a step of a routine may stand for, the one that goes on with what is being done. */
function chosen(
  all: readonly Occurrence[],
  open: readonly { readonly block: BlockStep; readonly passes_s: readonly number[]; readonly rank: number }[],
  program: Program,
): Occurrence | undefined {
  const [first] = all;
  if (all.length < 2) return first;
  const inner = open.at(-1);
  const own = inner && all.filter(({ chain }) => chain.includes(inner.block));
  if (inner && own && own.length > 0) {
    const onwards = own.find(({ rank }) => rank > inner.rank);
    if (onwards) return onwards;
    if (inner.passes_s.length < passesOf(inner.block, program)) return own[0];
  }
  return all.find(({ rank }) => rank > (inner?.rank ?? -1)) ?? first;
}
