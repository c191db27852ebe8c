import { censusOfEdges, PlainFault, type Random, type TriangleMesh, type Vector3 } from "@twincell/core";
import { MeshoptSimplifier } from "meshoptimizer/simplifier";
import { surfaceDeviation } from "./deviation.ts";
import { boundsOf, joinedMesh } from "./finish.ts";
import { withFewColors } from "./merge.ts";
import type { ImportedPart } from "./part.ts";

/** What came of fewer triangles (T-49, T-50). */
export interface LightReport {
  readonly faces_before: number;
  readonly faces: number;
  readonly materials_before: number;
  readonly materials: number;
  readonly lower_m: Vector3;
  readonly upper_m: Vector3;
  /** How far a side of the box around everything moved at most [m]. */
  readonly bounds_change_m: number;
  /** Measured at samples of both surfaces, from each to the other [m]. */
  readonly max_deviation_m: number;
  readonly rms_deviation_m: number;
  readonly samples: number;
  /** Edges with one triangle, before and after: a closed surface should stay closed. */
  readonly open_edges_before: number;
  readonly open_edges: number;
}

export interface Lightened {
  readonly parts: readonly ImportedPart[];
  readonly report: LightReport;
}

/**
 * Goals of the steps, times the goal of the end: every step makes its quadrics anew from the present surface, so that
 * errors of the early collapses do not add up.
 */
const STEPS = [9, 8, 7, 6, 5, 4, 3, 2.5, 2, 1.7, 1.4, 1.2, 1];
/** A closed surface has at least four. */
const FEWEST = 4;
const SAMPLES = 30_000;
const MOST_MATERIALS = 20;

/**
 * Parts with at most about so many triangles together and at most 20 colours, and the measured price of it.
 *
 * Each part gets its share by its triangles; corners are moved to where the sum of squared distances to the old planes
 * is least (Garland, Heckbert 1997). Bodies whose faces wear several colours keep the lines between the colours.
 *
 * @param adapters   triangles wanted, at least 4.
 * @param random  numbers in [0, 1) for the samples: the same numbers give the same report.
 */
export async function lightened(parts: readonly ImportedPart[], adapters: number, random: Random): Promise<Lightened> {
  if (!(adapters >= FEWEST))
    throw new PlainFault("formats.faces", `${adapters} triangles are too few.`, `Ask for at least ${FEWEST}.`);
  await MeshoptSimplifier.ready;
  const before = countOf(parts);
  const share = Math.min(1, adapters / before);
  const bodies = new Map<string, number>();
  for (const part of parts) bodies.set(bodyOf(part), (bodies.get(bodyOf(part)) ?? 0) + 1);
  const light = withFewColors(parts, MOST_MATERIALS).map((part, i) => ({
    ...part,
    mesh:
      share === 1
        ? part.mesh
        : simplified(
            part.mesh,
            Math.max(FEWEST, Math.floor((part.mesh.indices.length / 3) * share)),
            bodies.get(bodyOf(parts[i]!))! > 1,
          ),
  }));
  const kept = light.filter(({ mesh }) => mesh.indices.length > 0);
  const old = boundsOf(parts.map(({ mesh }) => mesh));
  const box = boundsOf(kept.map(({ mesh }) => mesh));
  const shift = [0, 1, 2].flatMap(k => [
    Math.abs(box.lower[k]! - old.lower[k]!),
    Math.abs(box.upper[k]! - old.upper[k]!),
  ]);
  const deviation =
    share === 1
      ? { max_m: 0, rms_m: 0, samples: 0 }
      : surfaceDeviation(
          joinedMesh(parts.map(({ mesh }) => mesh)),
          joinedMesh(kept.map(({ mesh }) => mesh)),
          SAMPLES,
          random,
        );
  return {
    parts: kept,
    report: {
      faces_before: before,
      faces: countOf(kept),
      materials_before: colorsOf(parts),
      materials: colorsOf(kept),
      lower_m: box.lower,
      upper_m: box.upper,
      bounds_change_m: Math.max(...shift),
      max_deviation_m: deviation.max_m,
      rms_deviation_m: deviation.rms_m,
      samples: deviation.samples,
      open_edges_before: openEdges(parts),
      open_edges: openEdges(kept),
    },
  };
}

const bodyOf = ({ path, name }: ImportedPart): string => JSON.stringify([path, name]);
const countOf = (parts: readonly ImportedPart[]): number =>
  parts.reduce((sum, { mesh }) => sum + mesh.indices.length / 3, 0);
const colorsOf = (parts: readonly ImportedPart[]): number => new Set(parts.map(({ color }) => color)).size;
const openEdges = (parts: readonly ImportedPart[]): number =>
  parts.reduce((sum, { mesh }) => sum + censusOfEdges(mesh).open, 0);

/** The part with fewer triangles; its own where the simplifier finds no way to the goal. */
function simplified(mesh: TriangleMesh, adapters: number, keepsBorder: boolean): TriangleMesh {
  if (mesh.indices.length / 3 <= adapters) return mesh;
  // Single precision counts from the middle of the part, where its digits are worth most.
  const { lower, upper } = boundsOf([mesh]);
  const middle = [0, 1, 2].map(k => (lower[k]! + upper[k]!) / 2);
  const positions = Float32Array.from(mesh.positions, (value, i) => (value - middle[i % 3]!) * 1000);
  const attributes = new Float32Array(positions.length / 3);
  let indices: Uint32Array = Uint32Array.from(mesh.indices);
  for (const step of STEPS) {
    const goal = Math.round(adapters * step) * 3;
    if (goal >= indices.length) continue;
    const [count] = MeshoptSimplifier.simplifyWithUpdate(
      indices,
      positions,
      3,
      attributes,
      1,
      [0],
      null,
      goal,
      1e9,
      keepsBorder ? ["ErrorAbsolute", "LockBorder"] : ["ErrorAbsolute"],
    );
    indices = indices.slice(0, count);
  }
  return compacted(
    indices,
    Float64Array.from(positions, (value, i) => value / 1000 + middle[i % 3]!),
  );
}

function compacted(indices: Uint32Array, positions: Float64Array): TriangleMesh {
  const newOf = new Int32Array(positions.length / 3).fill(-1);
  const kept: number[] = [];
  const renumbered = indices.map(old => {
    if (newOf[old] === -1) {
      newOf[old] = kept.length / 3;
      kept.push(positions[3 * old]!, positions[3 * old + 1]!, positions[3 * old + 2]!);
    }
    return newOf[old]!;
  });
  return { positions: Float64Array.from(kept), indices: renumbered };
}
