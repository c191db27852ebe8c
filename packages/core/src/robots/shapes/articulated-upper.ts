import type { Vector3 } from "../../spatial/vector.ts";
import { INNER_FACE_M, part } from "./articulated-lower.ts";
import type { LinkDesign } from "./link-shape.ts";
import { bolts, farSide, loft, prism, revolve, sideways, upright, type Frame } from "./loft.ts";
import { circle, filleted, roundedRectangle, stadium, type Point2 } from "./outline.ts";
import { shell, sized, type Standing } from "./standing.ts";

/** Lateral place of the two plates that hold the wrist [m for size 1]. */
const FORK_INNER_M = 0.0445;
const FORK_OUTER_M = 0.0625;

/** The drum of axis 3, the neck that holds the forearm and the motors at its back. */
export function elbow(at: Standing): LinkDesign {
  const s = at.size;
  const x = at.elbow.x;
  const z = at.elbow.z;
  const origin: Vector3 = [x, 0, z];
  const axis4: Vector3 = [at.wrist.x, 0, z];
  const drum = prism(
    sideways(origin),
    circle(0.091 * s),
    filleted(
      sized(s, [
        [0.05, -0.088],
        [0, -0.088],
        [0, 0.114],
        [0.012, 0.114],
      ]),
      0.013 * s,
      4,
    ),
  );
  const bearing = prism(
    sideways(origin),
    circle(0.082 * s),
    sized(s, [
      [0, 0.1],
      [0, INNER_FACE_M + 0.004],
    ]),
  );
  const block = [
    [-0.098, 0.066, 0.062, 0.02],
    [-0.092, 0.073, 0.069, 0.022],
    [-0.08, 0.076, 0.072, 0.024],
    [0.03, 0.079, 0.076, 0.03],
    [0.085, 0.078, 0.076, 0.05],
    [0.112, 0.076, 0.075, 0.07],
    [0.128, 0.075, 0.075, 0.0749],
    [0.134, 0.072, 0.072, 0.0719],
  ] as const;
  const neck = loft(
    upright(axis4),
    block.map(([w, u, v, r]) => ({ points: roundedRectangle(u * s, v * s, r * s)(0), w_m: w * s })),
  );
  const motors = prism(
    upright(axis4),
    roundedRectangle(0.06 * s, 0.056 * s, 0.02 * s),
    filleted(
      sized(s, [
        [0.03, -0.128],
        [0, -0.128],
        [0, -0.094],
        [0.02, -0.094],
      ]),
      0.014 * s,
      4,
    ),
  );
  const cap = prism(
    farSide([x, 0, z]),
    circle(0.062 * s),
    filleted(
      sized(s, [
        [0, 0.086],
        [0, 0.1],
        [0.04, 0.1],
      ]),
      0.008 * s,
    ),
  );
  return {
    parts: [
      part("elbow", "casting", drum, neck),
      part("caps", "cover", cap),
      part(
        "motors of the wrist",
        "dark",
        motors,
        bearing,
        revolve(
          upright(axis4),
          sized(s, [
            [0.066, 0.13],
            [0.066, 0.142],
          ]),
        ),
      ),
      part("bolts", "metal", bolts(farSide([x, 0.0875 * s, z]), 8, 0.074 * s, 0.0052 * s, 0.005 * s)),
    ],
    shells: elbowShells(at),
  };
}

/** Convex shells around drum and neck, and around the piece between axis 3 and axis 4 where these are apart. */
function elbowShells(at: Standing): LinkDesign["shells"] {
  const s = at.size;
  const { x, z } = at.elbow;
  const reach = at.wrist.x - x;
  const origin: Vector3 = [x, 0, z];
  const axis4: Vector3 = [at.wrist.x, 0, z];
  return [
    shell(sideways(origin), circle(0.0915 * s, 16, "around"), -0.101 * s, (INNER_FACE_M + 0.005) * s),
    shell(
      upright(axis4),
      roundedRectangle(0.0795 * s, 0.0765 * s, 0.02 * s, [0, 0], 1, "around"),
      -0.0985 * s,
      0.143 * s,
    ),
    shell(
      upright(axis4),
      roundedRectangle(0.061 * s, 0.057 * s, 0.014 * s, [0, 0], 1, "around"),
      -0.129 * s,
      -0.09 * s,
    ),
    ...(reach === 0
      ? []
      : [
          shell(
            upright([x, 0, z]),
            roundedRectangle(Math.abs(reach) + 0.0795 * s, 0.0765 * s, 0.02 * s, [0, 0], 1, "around"),
            -0.0985 * s,
            0.09 * s,
          ),
        ]),
  ];
}

/** The tapered tube that turns about its own axis, ending in the fork of the wrist. */
export function forearm(at: Standing): LinkDesign {
  const s = at.size;
  const wrist: Vector3 = [at.wrist.x, 0, at.wrist.z];
  const length = at.wrist.z - at.elbow.z;
  const start = 0.142 * s - length;
  const axis: Frame = upright(wrist);
  const round = (r: number, w: number): { points: Point2[]; w_m: number } => ({
    points: roundedRectangle(r, r, r - 1e-6)(0),
    w_m: w,
  });
  const tube = loft(axis, [
    round(0.069 * s, start),
    round(0.0735 * s, start + 0.004 * s),
    round(0.074 * s, start + 0.01 * s),
    round(0.074 * s, start + 0.045 * s),
    round(0.0725 * s, start + 0.055 * s),
    round(0.066 * s, start + 0.075 * s),
    round(0.0635 * s, start + 0.09 * s),
    round(0.0525 * s, -0.205 * s),
    round(0.0515 * s, -0.2 * s),
    round(0.049 * s, -0.198 * s),
  ]);
  const hand = loft(
    axis,
    (
      [
        [-0.2, 0.048, 0.048, 0.0479],
        [-0.19, 0.05, 0.05, 0.0499],
        [-0.165, 0.047, 0.055, 0.044],
        [-0.14, 0.0435, 0.0615, 0.03],
        [-0.125, 0.042, 0.0625, 0.024],
        [-0.108, 0.04, 0.0625, 0.02],
        [-0.102, 0.036, 0.058, 0.016],
      ] as const
    ).map(([w, u, v, r]) => ({ points: roundedRectangle(u * s, v * s, r * s)(0), w_m: w * s })),
  );
  const low = sideways(wrist);
  const high = farSide(wrist);
  const stripe = prism(
    upright([at.wrist.x + 0.0705 * s, 0, at.wrist.z + start + 0.0275 * s]),
    roundedRectangle(0.0045 * s, 0.007 * s, 0.003 * s, [0, 0], 3),
    sized(s, [
      [0, -0.016],
      [0, 0.016],
    ]),
  );
  return {
    parts: [
      part("forearm", "casting", tube),
      part("fork", "dark", hand, forkPlate(low, s, [0, -0.12 * s]), forkPlate(high, s, [-0.12 * s, 0])),
      part("hubs", "metal", forkHub(low, s), forkHub(high, s)),
      part("mark of axis 4", "mark", stripe),
    ],
    shells: [
      shell(axis, circle(0.0755 * s, 14, "around"), start - 0.001 * s, start + 0.08 * s),
      prism(axis, circle(0.0675 * s, 14, "around"), [
        [0, start + 0.07 * s],
        [0.0145 * s, -0.197 * s],
      ]),
      prism(
        axis,
        roundedRectangle(0.051 * s, 0.0635 * s, 0.02 * s, [0, 0], 1, "around"),
        sized(s, [
          [0, -0.2005],
          [0, -0.14],
          [0, -0.1015],
        ]),
      ),
      shell(
        low,
        stadium([0, -0.12 * s], 0.0395 * s, [0, 0], 0.043 * s, 5, "around"),
        (FORK_INNER_M - 0.0005) * s,
        (FORK_OUTER_M + 0.0075) * s,
      ),
      shell(
        high,
        stadium([-0.12 * s, 0], 0.0395 * s, [0, 0], 0.043 * s, 5, "around"),
        (FORK_INNER_M - 0.0005) * s,
        (FORK_OUTER_M + 0.0075) * s,
      ),
    ],
  };
}

/** One of the two plates that hold the wrist, for a robot of size `s`. */
function forkPlate(frame: Frame, s: number, foot: Point2): ReturnType<typeof prism> {
  return prism(
    frame,
    stadium(foot, 0.039 * s, [0, 0], 0.0425 * s, 16),
    filleted(
      sized(s, [
        [0.01, FORK_INNER_M],
        [0, FORK_INNER_M],
        [0, FORK_OUTER_M],
        [0.014, FORK_OUTER_M],
      ]),
      0.006 * s,
    ),
  );
}

/** The cover of the bearing on one of these plates. */
function forkHub(frame: Frame, s: number): ReturnType<typeof prism> {
  return revolve(
    frame,
    filleted(
      sized(s, [
        [0.027, FORK_OUTER_M - 0.002],
        [0.027, FORK_OUTER_M + 0.007],
        [0.014, FORK_OUTER_M + 0.007],
      ]),
      0.003 * s,
    ),
    32,
  );
}

/** The short piece between the plates of the fork that axis 5 bends. */
export function knuckle(at: Standing): LinkDesign {
  const s = at.size;
  const wrist: Vector3 = [at.wrist.x, 0, at.wrist.z];
  const neck = (at.flange_z - at.wrist.z) * 0.58;
  const drum = prism(
    sideways(wrist),
    circle(0.0385 * s, 40),
    filleted(
      sized(s, [
        [0.02, -0.0425],
        [0, -0.0425],
        [0, 0.0425],
        [0.02, 0.0425],
      ]),
      0.004 * s,
    ),
  );
  const stub = revolve(
    upright(wrist),
    filleted(
      [
        [0.034 * s, 0],
        [0.034 * s, neck - 0.004 * s],
        [0.031 * s, neck],
        [0.02 * s, neck],
      ],
      0.003 * s,
    ),
    40,
  );
  return {
    parts: [part("knuckle", "cover", drum), part("neck", "dark", stub)],
    shells: [
      shell(sideways(wrist), circle(0.039 * s, 12, "around"), -0.043 * s, 0.043 * s),
      shell(upright(wrist), circle(0.0345 * s, 12, "around"), -0.001 * s, neck + 0.0005 * s),
    ],
  };
}

/** The tool flange: a machined disc with four holes and a mark, so that its turn shows (row L-62). */
export function flange(at: Standing): LinkDesign {
  const s = at.size;
  const adapter = at.flange_z - at.wrist.z;
  const wrist: Vector3 = [at.wrist.x, 0, at.wrist.z];
  const axis = upright(wrist);
  const foot = adapter * 0.58 + 0.001 * s;
  const disc = revolve(
    axis,
    [
      [0.026 * s, foot],
      [0.026 * s, adapter * 0.7],
      [0.0305 * s, adapter * 0.72],
      [0.0318 * s, adapter * 0.74],
      [0.0318 * s, adapter - 0.003 * s],
      [0.0305 * s, adapter - 0.0012 * s],
      [0.0125 * s, adapter - 0.0012 * s],
      [0.0115 * s, adapter - 0.004 * s],
    ],
    48,
  );
  const holes = [0, 1, 2, 3].map(i => {
    const angle = Math.PI / 4 + (i * Math.PI) / 2;
    return revolve(
      upright([wrist[0] + 0.02 * s * Math.cos(angle), 0.02 * s * Math.sin(angle), wrist[2]]),
      [
        [0.0034 * s, adapter - 0.004 * s],
        [0.0034 * s, adapter - 0.0008 * s],
      ],
      16,
    );
  });
  const mark = prism(
    upright([wrist[0] + 0.0275 * s, 0, wrist[2]]),
    roundedRectangle(0.0062 * s, 0.0052 * s, 0.002 * s, [0, 0], 3),
    [
      [0, adapter * 0.745],
      [0, adapter - 0.0004 * s],
    ],
  );
  return {
    parts: [part("flange", "metal", disc), part("holes", "dark", ...holes), part("mark of axis 6", "mark", mark)],
    shells: [shell(axis, circle(0.0345 * s, 12, "around"), foot - 0.0005 * s, adapter)],
  };
}
