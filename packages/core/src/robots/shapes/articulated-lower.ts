import type { TriangleMesh } from "../../mesh/mesh.ts";
import type { Vector3 } from "../../spatial/vector.ts";
import { backwards, bolts, farSide, loft, merge, prism, revolve, sideways, upright, type Frame } from "./loft.ts";
import type { PartMaterial } from "../../model/form.ts";
import type { LinkDesign, LinkPart } from "./link-shape.ts";
import { circle, filleted, roundedRectangle, stadium, type Point2 } from "./outline.ts";
import { shell, sized, type Standing } from "./standing.ts";

/** Lateral place [m for size 1] of the faces between shoulder, upper arm and elbow. */
export const INNER_FACE_M = 0.13;
export const OUTER_FACE_M = 0.226;

export const part = (name: string, material: PartMaterial, ...meshes: readonly TriangleMesh[]): LinkPart => ({
  name,
  material,
  mesh: merge(meshes),
});

/** Foot, column and the plug panel at the back. */
export function base(at: Standing): LinkDesign {
  const s = at.size;
  const foot = upright([0, 0, 0]);
  const top_m = at.axis1.z - 0.16 * s;
  const column = filleted(
    [
      [0.158 * s, 0.02 * s],
      [0.112 * s, 0.02 * s],
      [0.1 * s, 0.09 * s],
      [0.1 * s, top_m - 0.034 * s],
      [0.108 * s, top_m - 0.022 * s],
      [0.108 * s, top_m],
    ],
    0.022 * s,
    4,
  );
  const panel: Frame = backwards([-0.07 * s, 0, 0.13 * s]);
  const plugs = [-0.026, 0.026].map(y =>
    revolve(
      backwards([-0.132 * s, y * s, 0.128 * s]),
      sized(s, [
        [0.015, -0.004],
        [0.015, 0.016],
        [0.012, 0.02],
        [0.012, 0.034],
        [0.009, 0.036],
      ]),
      20,
    ),
  );
  return {
    parts: [
      part("column", "casting", revolve(foot, column)),
      part(
        "foot",
        "dark",
        revolve(
          foot,
          [
            [0.161 * s, 0],
            [0.165 * s, 0.004 * s],
            [0.165 * s, 0.02 * s],
            [0.161 * s, 0.024 * s],
            [0.11 * s, 0.024 * s],
          ],
          64,
        ),
        revolve(foot, [
          [0.1 * s, top_m - 0.01 * s],
          [0.1 * s, top_m + 0.012 * s],
        ]),
      ),
      part(
        "plug panel",
        "dark",
        prism(
          panel,
          roundedRectangle(0.05 * s, 0.055 * s, 0.012 * s, [0, 0], 4),
          filleted(
            sized(s, [
              [0, 0],
              [0, 0.062],
              [0.02, 0.062],
            ]),
            0.006 * s,
          ),
        ),
        ...plugs,
      ),
      part("bolts", "metal", bolts(upright([0, 0, 0.024 * s]), 8, 0.14 * s, 0.0105 * s, 0.011 * s, Math.PI / 8)),
    ],
    shells: [
      shell(foot, circle(0.166 * s, 16, "around"), 0, 0.036 * s),
      prism(
        foot,
        circle(0.142 * s, 16, "around"),
        sized(s, [
          [0, 0.02],
          [0.03, 0.06],
          [0.036, 0.09],
        ]),
      ),
      shell(foot, circle(0.1085 * s, 16, "around"), 0.06 * s, top_m + 0.013 * s),
      shell(
        backwards([-0.06 * s, 0, 0.13 * s]),
        roundedRectangle(0.052 * s, 0.057 * s, 0.01 * s, [0, 0], 1, "around"),
        0,
        0.11 * s,
      ),
    ],
  };
}

/**
 * The turret: a round foot on axis 1 that grows, and leans out where axis 2 stands ahead, into the drum of axis 2, with
 * that axis's motor on the far side.
 */
export function shoulder(at: Standing): LinkDesign {
  const s = at.size;
  const { x, z } = at.axis1;
  const origin: Vector3 = [x, 0, z];
  // The foot stands on axis 1; higher up the turret spans from there to the drum.
  const spanning = (u: number, v: number, r: number, w: number, share: number): { points: Point2[]; w_m: number } => ({
    points: roundedRectangle(u * s + (x / 2) * share, v * s, r * s, [-x + (x / 2) * share, 0])(0),
    w_m: w * s,
  });
  const neck = loft(upright(origin), [
    ...(
      [
        [0.108, -0.152],
        [0.114, -0.148],
        [0.118, -0.14],
        [0.119, -0.115],
      ] as const
    ).map(([r, w]) => spanning(r, r, r - 1e-6, w, 0)),
    spanning(0.12, 0.118, 0.112, -0.09, 0.7),
    spanning(0.121, 0.115, 0.098, -0.06, 0.95),
    spanning(0.121, 0.113, 0.086, -0.03, 1),
    spanning(0.119, 0.11, 0.08, 0, 1),
  ]);
  const drum = prism(
    sideways(origin),
    circle(0.122 * s, 56),
    filleted(
      sized(s, [
        [0.05, -0.116],
        [0, -0.116],
        [0, 0.112],
        [0.012, 0.112],
      ]),
      0.014 * s,
      4,
    ),
  );
  const motor = prism(
    farSide(origin),
    circle(0.082 * s),
    filleted(
      sized(s, [
        [0, 0.11],
        [0, 0.17],
        [0.05, 0.17],
      ]),
      0.022 * s,
      5,
    ),
  );
  const joint = prism(
    sideways(origin),
    circle(0.11 * s),
    sized(s, [
      [0, 0.1],
      [0, INNER_FACE_M + 0.004],
    ]),
  );
  const rim = bolts(farSide([x, 0.1155 * s, z]), 10, 0.1 * s, 0.0062 * s, 0.006 * s);
  return {
    parts: [
      part("turret", "casting", neck, drum),
      part("motor of axis 2", "cover", motor),
      part("bearing of axis 2", "dark", joint),
      part("bolts", "metal", rim),
    ],
    shells: [
      shell(upright([0, 0, z]), circle(0.1215 * s, 16, "around"), -0.153 * s, -0.08 * s),
      shell(
        upright([x / 2, 0, z]),
        roundedRectangle(0.122 * s + x / 2, 0.12 * s, 0.05 * s, [0, 0], 2, "around"),
        x > 0 ? -0.116 * s : -0.091 * s,
        0.001 * s,
      ),
      shell(sideways(origin), circle(0.1225 * s, 20, "around"), -0.1235 * s, INNER_FACE_M * s + 0.005 * s),
      shell(farSide(origin), circle(0.083 * s, 14, "around"), 0.1 * s, 0.171 * s),
    ],
  };
}

/** The wide casting between axes 2 and 3, rounded at both ends, with a recessed cover outside. */
export function upperArm(at: Standing): LinkDesign {
  const s = at.size;
  const a: Point2 = [at.axis1.x, at.axis1.z];
  const b: Point2 = [at.elbow.x, at.elbow.z];
  const frame = sideways([0, 0, 0]);
  const ra = 0.12 * s;
  const rb = 0.09 * s;
  const rim = OUTER_FACE_M;
  const casting = prism(frame, stadium(a, ra, b, rb, 24), [
    ...filleted(
      sized(s, [
        [0.05, INNER_FACE_M],
        [0, INNER_FACE_M],
        [0, rim],
        [0.02, rim],
        [0.023, rim - 0.008],
        [0.06, rim - 0.008],
      ]),
      0.016 * s,
      4,
    ),
  ]);
  const cover = prism(
    frame,
    stadium(a, ra, b, rb, 24),
    filleted(
      sized(s, [
        [0.027, rim - 0.01],
        [0.027, rim - 0.002],
        [0.07, rim - 0.002],
      ]),
      0.004 * s,
    ),
  );
  const cap = (point: Point2, radius: number): TriangleMesh[] => {
    const origin: Vector3 = [point[0], 0, point[1]];
    return [
      revolve(
        sideways(origin),
        filleted(
          sized(s, [
            [radius, rim - 0.004],
            [radius, rim + 0.006],
            [radius * 0.6, rim + 0.009],
            [radius * 0.4, rim + 0.009],
          ]),
          0.003 * s,
        ),
      ),
    ];
  };
  const screws = [a, b].map((point, i) =>
    bolts(
      sideways([point[0], -(rim - 0.0025) * s, point[1]]),
      i === 0 ? 8 : 6,
      (i === 0 ? 0.078 : 0.052) * s,
      0.0055 * s,
      0.0055 * s,
      0.2,
    ),
  );
  return {
    parts: [
      part("upper arm", "casting", casting),
      part("cover", "cover", cover),
      part("bearing caps", "dark", ...cap(a, 0.056), ...cap(b, 0.04)),
      part("bolts", "metal", ...screws),
    ],
    shells: [
      shell(
        frame,
        stadium(a, ra + 0.0005 * s, b, rb + 0.0005 * s, 6, "around"),
        (INNER_FACE_M - 0.001) * s,
        (rim + 0.0095) * s,
      ),
    ],
  };
}
