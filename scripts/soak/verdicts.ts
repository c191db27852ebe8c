// Verdicts on contact beside coal's, pair of meshes by pair of meshes:
//   node scripts/soak/verdicts.ts [CONFIGURATIONS per pair] [ROBOT…]
// For every pair of links of a robot with published meshes, half of the configurations are random postures inside the
// joint limits, half random placements near each other. coal tests surfaces on the same triangles; where one solid
// holds the other ours says contact and coal none, which a sum of solid angles decides apart. Any other disagreement is
// kept with its distance. Result in verdicts.json.
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { fileURLToPath } from "node:url";
import {
  between,
  buildSolid,
  fromAxisAngle,
  identity,
  linkPoses,
  normalize,
  pairScratch,
  pose,
  rigid,
  rigidFromPose,
  seededRandom,
  solidDistance,
  solidsTouch,
  surfacesTouch,
  type SerialArm,
  type TriangleMesh,
} from "@twincell/core";
import { armFromUrdf, readDae, readStl, readUrdf, urdfSolids } from "@twincell/formats";
import { pythonPeer } from "../../bench/peer.ts";

const SEED = 4004;
const COAL = "coal==3.0.3";
const count = Number(process.argv[2] ?? 2000);
const only = process.argv.slice(3);
const robots = new URL("../../../shared/robots/", import.meta.url);

const PYTHON = `
import json, sys
import numpy as np, coal
task = json.load(sys.stdin)
def mesh(m):
    v, t = np.array(m["positions"]).reshape(-1, 3), np.array(m["indices"]).reshape(-1, 3)
    model = coal.BVHModelOBBRSS()
    model.beginModel(len(t), len(v))
    vs = coal.StdVec_Vec3s()
    for p in v: vs.append(p)
    ts = coal.StdVec_Triangle()
    for a, b, c in t: ts.append(coal.Triangle(int(a), int(b), int(c)))
    model.addSubModel(vs, ts)
    model.endModel()
    return model, v, t
def inside(point, v, t):
    a, b, c = (v[t[:, k]] - point for k in range(3))
    la, lb, lc = (np.linalg.norm(x, axis=1) for x in (a, b, c))
    top = np.einsum("ij,ij->i", a, np.cross(b, c))
    low = la * lb * lc + np.einsum("ij,ij->i", a, b) * lc + np.einsum("ij,ij->i", b, c) * la + np.einsum("ij,ij->i", c, a) * lb
    return abs(np.sum(2 * np.arctan2(top, low)) / (4 * np.pi)) > 0.5
(ma, va, ta), (mb, vb, tb) = mesh(task["a"]), mesh(task["b"])
here = coal.Transform3s()
touch, far, held = [], [], []
for motion, ours in zip(task["motions"], task["ours"]):
    R, p = np.array(motion[:9]).reshape(3, 3), np.array(motion[9:])
    there, result = coal.Transform3s(R, p), coal.CollisionResult()
    said = coal.collide(ma, here, mb, there, coal.CollisionRequest(), result) > 0
    touch.append(int(said))
    if said == bool(ours): continue
    answer = coal.DistanceResult()
    far.append(0.0 if said else float(coal.distance(ma, here, mb, there, coal.DistanceRequest(True), answer)))
    held.append(int(any(inside(R @ q + p, va, ta) for q in vb[:: max(1, len(vb) // 40)]) or any(inside(R.T @ (q - p), vb, tb) for q in va[:: max(1, len(va) // 40)])))
json.dump({"touch": touch, "far": far, "held": held}, sys.stdout)
`;

interface PairResult {
  readonly pair: string;
  readonly touching: number;
  readonly contained: number;
  readonly disagreements: readonly { readonly ours: boolean; readonly distance_m: number }[];
}

function meshesOf(
  id: string,
):
  | { readonly arm: SerialArm; readonly links: readonly { readonly link: number; readonly mesh: TriangleMesh }[] }
  | string {
  const folder = new URL(`${id}/`, robots);
  if (!existsSync(new URL("robot.urdf", folder))) return "has no URDF beside the checkout";
  const urdf = readUrdf(readFileSync(new URL("robot.urdf", folder), "utf8"));
  const chain = urdf.kind === "read" ? armFromUrdf(urdf.robot) : urdf;
  if (chain.kind !== "chain") return chain.sentence;
  const { solids } = urdfSolids(chain, reference => {
    const place = new URL(reference, folder);
    const bytes = readFileSync(fileURLToPath(place));
    const answer = reference.toLowerCase().endsWith(".dae") ? readDae(bytes) : readStl(bytes);
    if (answer.kind !== "read") throw new Error(`${reference}: ${answer.sentence}`);
    return answer.mesh;
  });
  return { arm: chain.arm, links: solids };
}

function comparePair(
  arm: SerialArm,
  i: { readonly link: number; readonly mesh: TriangleMesh },
  j: typeof i,
  seed: number,
): PairResult | undefined {
  const random = seededRandom(seed);
  const a = buildSolid(i.mesh);
  const b = buildSolid(j.mesh);
  const scratch = pairScratch();
  const nearest = new Float64Array(6);
  const relative = rigid();
  const links = Array.from({ length: arm.joints.length + 1 }, () => identity<"base", "link">());
  const motions: number[][] = [];
  const ours: number[] = [];
  const surfaces: boolean[] = [];
  const far_m: number[] = [];
  const centre = (s: typeof a): number[] => [...s.bvh.boxes.slice(0, 3)];
  const half = (s: typeof a): number => Math.hypot(...s.bvh.boxes.slice(3, 6));
  for (let n = 0; n < count; n++) {
    if (n % 2 === 0) {
      linkPoses(
        arm,
        arm.joints.map(({ limits: { lower_rad, upper_rad } }) => lower_rad + random() * (upper_rad - lower_rad)),
        links,
      );
      between(rigidFromPose(links[i.link]!), rigidFromPose(links[j.link]!), relative);
    } else {
      const unit = (): number => 2 * random() - 1;
      const turn = fromAxisAngle(normalize([unit(), unit(), unit()]), Math.PI * unit());
      const reach = 0.6 * (half(a) + half(b));
      const [ca, cb] = [centre(a), centre(b)];
      rigidFromPose(pose([0, 0, 0], turn), relative);
      for (let k = 0; k < 3; k++)
        relative[9 + k] =
          ca[k]! +
          reach * unit() -
          relative[3 * k]! * cb[0]! -
          relative[3 * k + 1]! * cb[1]! -
          relative[3 * k + 2]! * cb[2]!;
    }
    motions.push([...relative]);
    ours.push(solidsTouch(a, b, relative, scratch) ? 1 : 0);
    surfaces.push(surfacesTouch(a.bvh, b.bvh, relative, scratch));
    scratch.witness.fill(-1);
    far_m.push(ours.at(-1) === 1 ? 0 : solidDistance(a, b, relative, 0.001, scratch, nearest));
  }
  const plain = ({ positions, indices }: TriangleMesh): object => ({
    positions: [...positions],
    indices: [...indices],
  });
  const answer = pythonPeer("coal", [COAL, "numpy"], PYTHON, { a: plain(i.mesh), b: plain(j.mesh), motions, ours }) as
    | { touch: number[]; far: number[]; held: number[] }
    | undefined;
  if (answer === undefined) return undefined;
  const disagreements: { ours: boolean; distance_m: number }[] = [];
  let contained = 0;
  let at = 0;
  answer.touch.forEach((said, n) => {
    if (said === ours[n]) return;
    const k = at++;
    if (ours[n] === 1 && !surfaces[n]! && answer.held[k] === 1) {
      contained++;
      return;
    }
    disagreements.push({ ours: ours[n] === 1, distance_m: said === 1 ? far_m[n]! : answer.far[k]! });
  });
  return {
    pair: `link ${i.link}, link ${j.link}`,
    touching: ours.filter(says => says === 1).length,
    contained,
    disagreements,
  };
}

const results: object[] = [];
let worst_m = 0;
let disagreeing = 0;
let contained = 0;
let compared = 0;
const began = performance.now();
for (const id of [
  "kuka_kr6r900sixx",
  "ur10e",
  "kuka_lbr_iiwa_14_r820",
  "yaskawa_gp8",
  "staubli_rx160",
  "abb_irb120",
  "fanuc_lrmate200id",
]) {
  if (only.length > 0 && !only.includes(id)) continue;
  const made = meshesOf(id);
  if (typeof made === "string") {
    process.stderr.write(`${id} is left out: ${made}\n`);
    continue;
  }
  const pairs: PairResult[] = [];
  for (let x = 0; x < made.links.length; x++)
    for (let y = x + 1; y < made.links.length; y++) {
      const result = comparePair(made.arm, made.links[x]!, made.links[y]!, SEED + 100 * x + y);
      if (result === undefined) throw new Error("coal does not run here.");
      pairs.push(result);
    }
  const all = pairs.flatMap(({ disagreements }) => disagreements);
  const held = pairs.reduce((sum, pair) => sum + pair.contained, 0);
  worst_m = Math.max(worst_m, ...all.map(({ distance_m }) => distance_m));
  disagreeing += all.length;
  contained += held;
  compared += pairs.length * count;
  results.push({
    robot: id,
    triangles: made.links.reduce((sum, { mesh }) => sum + mesh.indices.length / 3, 0),
    pairs: pairs.length,
    configurations: pairs.length * count,
    touching: pairs.reduce((sum, { touching }) => sum + touching, 0),
    contained: held,
    disagreements: pairs
      .filter(({ disagreements }) => disagreements.length > 0)
      .map(({ pair, disagreements }) => ({ pair, disagreements })),
  });
  process.stderr.write(`${JSON.stringify(results.at(-1)).slice(0, 400)}\n`);
}
const result = {
  what: "contact verdicts of pairs of link meshes beside coal 3.0.3 on the same triangles; contained: one inside the other, which a test of surfaces does not see, decided by a sum of solid angles; disagreements with the distance the other side measures",
  date: new Date().toISOString().slice(0, 10),
  machine: `${cpus()[0]?.model ?? "unknown"}, Node ${process.versions.node}`,
  seed: SEED,
  configurationsPerPair: count,
  seconds: Math.round((performance.now() - began) / 1000),
  configurations: compared,
  contained,
  disagreements: disagreeing,
  worst_m,
  robots: results,
};
if (only.length === 0) writeFileSync(new URL("verdicts.json", import.meta.url), `${JSON.stringify(result, null, 1)}\n`);
process.stdout.write(`${JSON.stringify({ ...result, robots: undefined })}\n`);
