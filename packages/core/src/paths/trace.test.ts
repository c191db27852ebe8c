import { describe, expect, test } from "vitest";
import {
  armScratch,
  boxMesh,
  compose,
  cylinderMesh,
  degrees,
  extrudedMesh,
  flangeOfTcp,
  flangePose,
  fromAxisAngle,
  inverse,
  nearestSolution,
  norm,
  pose,
  radians,
  robotById,
  rotate,
  type Pose,
  type Vector3,
} from "../index.ts";
import {
  curveOfChain,
  curvesOfLoop,
  distanceToPolyline,
  edgeLoop,
  edgeNearPoint,
  featureEdges,
  helperCurve,
  moveCurve,
  pathDeviation,
  refineJointPath,
  traceEdges,
  type RefineArm,
  type TraceOptions,
} from "./index.ts";

const UP: Vector3 = [0, 0, 1];
const THRESHOLD = radians(30);
const toolZ = (tcp: Pose): Vector3 => rotate(tcp.quaternion, [0, 0, 1]);
const toolX = (tcp: Pose): Vector3 => rotate(tcp.quaternion, [1, 0, 0]);
const angle_deg = (a: Vector3, b: Vector3): number =>
  degrees(Math.acos((a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / norm(a) / norm(b)));
const close = (a: readonly number[], b: readonly number[], digits = 12): void => {
  a.forEach((v, k) => {
    expect(v).toBeCloseTo(b[k]!, digits);
  });
};

const carton = featureEdges(boxMesh([0.4, 0.3, 0.2]), THRESHOLD);
const topOf = (features = carton, at: Vector3 = [0.2, 0, 0.1]) =>
  curvesOfLoop(edgeLoop(features, edgeNearPoint(features, at, 0.001)!.chain, UP));
const AT_45: TraceOptions = { tilt_rad: Math.PI / 4, chord_m: 0.0001, leadIn_m: 0.05, leadOut_m: 0.04 };

describe("N-53 the four top edges of a box, the tool at 45°", () => {
  const edges = traceEdges(topOf(), AT_45);

  test("each edge has its two ends, taught with its own tool direction, and leads against the tool", () => {
    expect(edges.map(({ points }) => points.map(({ role }) => role))).toEqual(
      Array.from({ length: 4 }, () => ["lead-in", "edge", "edge", "lead-out"]),
    );
    for (const { points } of edges) {
      const [into, from, to, out] = points as [
        (typeof points)[0] & object,
        (typeof points)[0] & object,
        (typeof points)[0] & object,
        (typeof points)[0] & object,
      ];
      const back = (p: Pose, q: Pose): Vector3 => [0, 1, 2].map(k => p.position[k]! - q.position[k]!) as Vector3;
      close(
        back(into.pose, from.pose),
        toolZ(from.pose).map(v => -0.05 * v),
      );
      close(
        back(out.pose, to.pose),
        toolZ(to.pose).map(v => -0.04 * v),
      );
      expect([into, from, to, out].map(({ onEdge }) => onEdge)).toEqual([false, true, true, false]);
    }
  });

  test("the tool points inward and down at 45° to both faces, x along the edge", () => {
    for (const { points, tangent } of edges)
      for (const { pose: tcp, onEdge } of points) {
        const z = toolZ(tcp);
        const [x, y] = tcp.position;
        expect(angle_deg(z, [0, 0, -1])).toBeCloseTo(45, 9);
        if (onEdge) expect(z[0] * x + z[1] * y).toBeLessThan(0);
        close(toolX(tcp), tangent);
      }
  });

  test("the edges follow each other around: a corner is taught twice", () => {
    edges.forEach(({ points }, i) => {
      const end = points[2]!.pose;
      const begin = edges[(i + 1) % 4]!.points[1]!.pose;
      close(end.position, begin.position);
      expect(angle_deg(toolX(end), toolX(begin))).toBeCloseTo(90, 9);
    });
  });
});

describe("options", () => {
  const [first] = topOf();
  const z = (options: Partial<TraceOptions>): Vector3 =>
    toolZ(traceEdges([first!], { ...AT_45, ...options })[0]!.points[1]!.pose);
  const n2 = first!.second[0]!;

  test("tilt counts from the first face", () => {
    close(z({ tilt_rad: Math.PI / 2 }), [0, 0, -1]);
    close(
      z({ tilt_rad: 0 }),
      n2.map(v => -v),
    );
    expect(angle_deg(z({ tilt_rad: radians(30) }), [0, 0, -1])).toBeCloseTo(60, 9);
  });

  test("spin turns about the tool's own axis and leaves it alone", () => {
    const [plain, spun] = [0, 1].map(spin_rad => traceEdges([first!], { ...AT_45, spin_rad })[0]!.points[1]!.pose) as [
      Pose,
      Pose,
    ];
    close(toolZ(plain), toolZ(spun));
    close(compose(inverse(plain), spun).quaternion, fromAxisAngle([0, 0, 1], 1));
  });

  test("a fixed x direction spares the wrist: neighbouring edges turn it less than following them would", () => {
    const turn = (xAxis: TraceOptions["xAxis"] & object): number[] => {
      const edges = traceEdges(topOf(), { ...AT_45, xAxis });
      return edges.slice(1).map((edge, i) => angle_deg(toolX(edges[i]!.points[1]!.pose), toolX(edge.points[1]!.pose)));
    };
    expect(Math.max(...turn([1, 0, 0]))).toBeLessThan(60);
  });

  test("swinging corners need no lead between edges, but at both ends of the loop", () => {
    const roles = traceEdges(topOf(), { ...AT_45, corners: "swing" }).map(({ points }) =>
      points.map(({ role }) => role).join(" "),
    );
    expect(roles).toEqual(["lead-in edge edge", "edge edge", "edge edge", "edge edge lead-out"]);
  });

  test("overrun, longest step", () => {
    const { points, tangent } = traceEdges([first!], { ...AT_45, overrun_m: 0.01, maxStep_m: 0.1, leadOut_m: 0 })[0]!;
    const length = Math.hypot(...[0, 1, 2].map(k => points.at(-1)!.pose.position[k]! - points[1]!.pose.position[k]!));
    expect(points.length).toBe(2 + Math.ceil(length / 0.1 - 1e-9));
    const ahead = [0, 1, 2].reduce(
      (sum, k) => sum + (points[0]!.pose.position[k]! - points[1]!.pose.position[k]!) * tangent[k]!,
      0,
    );
    expect(ahead).toBeCloseTo(-0.01, 12);
  });
});

describe("curved and other edges", () => {
  const can = featureEdges(cylinderMesh(0.1, 0.2, 360), THRESHOLD);

  test("a round rim gets as many points as the chord tolerance asks for, and keeps it", () => {
    const counts = [0.001, 0.0001].map(chord_m => {
      const { points, polyline } = traceEdges(topOf(can, [0.1, 0, 0.1]), {
        tilt_rad: Math.PI / 4,
        chord_m,
        chord_rad: 1,
      })[0]!;
      close(points[0]!.pose.position, points.at(-1)!.pose.position);
      expect(
        pathDeviation(
          points.map(({ pose: { position } }) => position),
          polyline,
        ).max_m,
      ).toBeLessThanOrEqual(chord_m);
      for (const { pose: tcp } of points) {
        expect(angle_deg(toolZ(tcp), [0, 0, -1])).toBeCloseTo(45, 6);
        close(
          [toolZ(tcp)[0] * 0.1 * Math.SQRT2, toolZ(tcp)[1] * 0.1 * Math.SQRT2],
          [-tcp.position[0], -tcp.position[1]],
          6,
        );
      }
      return points.length;
    });
    // Sagitta s of a chord: n = π / acos(1 − s/r), at most twice that by halving.
    for (const [i, s] of [0.001, 0.0001].entries()) {
      expect(counts[i]!).toBeGreaterThan(Math.PI / Math.acos(1 - s / 0.1));
      expect(counts[i]!).toBeLessThan((2.2 * Math.PI) / Math.acos(1 - s / 0.1) + 2);
    }
  });

  test("on a seam between floor and wall the tool stands in the free corner", () => {
    const step = featureEdges(
      extrudedMesh(
        [
          [0, 0],
          [2, 0],
          [2, 1],
          [1, 1],
          [1, 2],
          [0, 2],
        ],
        0,
        1,
      ),
      THRESHOLD,
    );
    const seam = step.chains.find(({ kind }) => kind === "concave")!;
    for (const prefer of [
      [0, 1, 0],
      [1, 0, 0],
    ] as Vector3[]) {
      const tcp = traceEdges([curveOfChain(seam, prefer)], { ...AT_45, tilt_rad: Math.PI / 4 })[0]!.points[1]!.pose;
      close(toolZ(tcp), [-Math.SQRT1_2, -Math.SQRT1_2, 0]);
    }
  });

  test("N-60 a helper curve on a surface with a given normal", () => {
    const wave = helperCurve(
      Array.from({ length: 101 }, (_, i) => [i / 100, 0.05 * Math.sin(i / 10), 0.3] as Vector3),
      () => UP,
    );
    const { points, polyline } = traceEdges([wave], { tilt_rad: Math.PI / 2, chord_m: 0.0005, chord_rad: 10 })[0]!;
    for (const { pose: tcp } of points) close(toolZ(tcp), [0, 0, -1]);
    expect(points.length).toBeLessThan(40);
    expect(
      pathDeviation(
        points.map(({ pose: { position } }) => position),
        polyline,
      ).max_m,
    ).toBeLessThanOrEqual(0.0005);
  });

  test("a moved curve traces as the moved trace", () => {
    const worldFromPart = pose([1, 2, 3], fromAxisAngle([0.6, 0, 0.8], 1));
    const moved = traceEdges(
      topOf().map(curve => moveCurve(curve, worldFromPart)),
      AT_45,
    );
    const still = traceEdges(topOf(), AT_45);
    moved.forEach(({ points }, e) => {
      points.forEach(({ pose: tcp }, i) => {
        close(tcp.position, compose(worldFromPart, still[e]!.points[i]!.pose as Pose).position, 9);
      });
    });
  });
});

test("deviation of points from a line", () => {
  const line: Vector3[] = [
    [0, 0, 0],
    [1, 0, 0],
    [1, 1, 0],
  ];
  expect(distanceToPolyline(line, [0.5, 0.2, 0])).toBeCloseTo(0.2, 12);
  const { max_m, rms_m, at } = pathDeviation(line, [
    [0, 0, 0],
    [1.3, 0.5, 0.4],
    [1, 2, 0],
  ]);
  expect([max_m, at]).toEqual([1, 2]);
  expect(rms_m).toBeCloseTo(Math.sqrt((0.25 + 1) / 3), 12);
});

describe("N-58 sparse points and joint interpolation", () => {
  const robot = robotById("staubli_rx90l")!;
  const scratch = armScratch();
  const flangeFromTcp = pose<"flange", "tcp">([0, 0, 0.12]);
  const arm: RefineArm = {
    solve: (tcp, near) => {
      const q = new Float64Array(6);
      const flange = flangeOfTcp(pose(), tcp as Pose<"world", "tcp">, flangeFromTcp);
      return nearestSolution(robot, flange, near, q) ? q : "The point is out of reach.";
    },
    forward: (q, out) => {
      compose(flangePose(robot.arm, q, pose(), scratch) as Pose, flangeFromTcp as Pose, out);
    },
  };
  const worldFromPart = pose([0.6, 0, 0.1]);
  const edge = traceEdges([moveCurve(topOf()[0]!, worldFromPart)], { ...AT_45, xAxis: [1, 0, 0] })[0]!;
  const ends = edge.points.filter(({ onEdge }) => onEdge).map(({ pose: tcp }) => tcp as Pose);
  const tolerances = { tolerance_m: 0.0002, tolerance_rad: radians(0.2) };

  test("two points leave the edge; inserted ones keep the executed path within tolerance, as a denser look confirms", () => {
    const refined = refineJointPath(ends, robot.home_rad, arm, tolerances);
    if (refined.kind !== "refined") throw new Error(refined.kind);
    expect(refined.before[0]!.position_m).toBeGreaterThan(0.001);
    expect(refined.points.length).toBeGreaterThan(3);
    expect(refined.points.length).toBeLessThan(100);
    expect(refined.points.filter(({ inserted }) => !inserted).length).toBe(2);
    for (const { position_m, angle_rad } of refined.after) {
      expect(position_m).toBeLessThanOrEqual(0.0002);
      expect(angle_rad).toBeLessThanOrEqual(radians(0.2));
    }
    const executed: Vector3[] = [];
    const tcp: Pose = pose();
    refined.points.slice(1).forEach(({ q }, i) => {
      for (let s = 0; s <= 97; s++) {
        arm.forward(
          refined.points[i]!.q.map((v, k) => v + ((q[k]! - v) * s) / 97),
          tcp,
        );
        executed.push([...tcp.position]);
      }
    });
    expect(pathDeviation(edge.polyline, executed).max_m).toBeLessThan(0.00021);
  });

  test("a looser tolerance needs fewer points, a path already good none", () => {
    const loose = refineJointPath(ends, robot.home_rad, arm, { tolerance_m: 0.01, tolerance_rad: radians(10) });
    const tight = refineJointPath(ends, robot.home_rad, arm, tolerances);
    if (loose.kind !== "refined" || tight.kind !== "refined") throw new Error("not refined");
    expect(loose.points.length).toBeLessThan(tight.points.length);
    const again = refineJointPath(
      tight.points.map(point => point.pose),
      robot.home_rad,
      arm,
      tolerances,
    );
    expect(again.kind === "refined" && again.points.length).toBe(tight.points.length);
  });

  test("a limit, a point out of reach and a posture that must change are said with their place", () => {
    expect(refineJointPath(ends, robot.home_rad, arm, { ...tolerances, maxPoints: 3 })).toMatchObject({
      kind: "too-many-points",
      segment: 0,
      limit: 3,
    });
    const far = pose([3, 0, 0.5], ends[1]!.quaternion);
    expect(refineJointPath([ends[0]!, far], robot.home_rad, arm, tolerances)).toMatchObject({
      kind: "unreachable",
      segment: 0,
      at: 1,
      sentence: "The point is out of reach.",
    });
    // Half way along the edge the wrist turns over: the same pose with joints 4 and 6 half a turn on and joint 5
    // mirrored.
    const turningOver: RefineArm = {
      ...arm,
      solve: tcp => {
        const q = arm.solve(tcp, Float64Array.from(robot.home_rad));
        return typeof q !== "string" && tcp.position[1] > 0.01
          ? Float64Array.of(q[0]!, q[1]!, q[2]!, q[3]! + Math.PI, -q[4]!, q[5]! + Math.PI)
          : q;
      },
    };
    const turned = refineJointPath(ends, robot.home_rad, turningOver, tolerances);
    if (turned.kind !== "posture-change") throw new Error(turned.kind);
    expect([4, 6]).toContain(turned.joint);
    expect(turned.jump_rad).toBeGreaterThan(3);
  });
});
