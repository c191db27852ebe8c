import { type RefObject } from "react";
import { type Camera, Vector3 } from "three";
import { WORDS } from "../words.ts";
import type { CameraWishes } from "./controls.tsx";

const { sides } = WORDS;
/**
 * Each face: its name, how it is turned in CSS, and the way the camera looks at it (scene coordinates; the robot faces
 * +x).
 */
const FACES: readonly { readonly side: keyof typeof sides; readonly css: string; readonly way: Vector3 }[] = [
  { side: "right", css: "rotateY(0deg)", way: new Vector3(0, 0, -1) },
  { side: "front", css: "rotateY(90deg)", way: new Vector3(-1, 0, 0) },
  { side: "left", css: "rotateY(180deg)", way: new Vector3(0, 0, 1) },
  { side: "back", css: "rotateY(-90deg)", way: new Vector3(1, 0, 0) },
  { side: "top", css: "rotateX(90deg) rotateZ(-90deg)", way: new Vector3(-0.0004, -1, 0) },
  { side: "bottom", css: "rotateX(-90deg) rotateZ(90deg)", way: new Vector3(-0.0004, 1, 0) },
];

/**
 * A cube that shows how the view stands and takes it to a side when clicked. Plain DOM: keyboard and screen reader
 * work.
 */
export function ViewCube({
  cube,
  wishes,
}: {
  readonly cube: RefObject<HTMLDivElement | null>;
  readonly wishes: CameraWishes;
}) {
  return (
    <div className="view-cube">
      <div className="view-cube-body" ref={cube}>
        {FACES.map(({ side, css, way }) => (
          <button
            key={side}
            type="button"
            style={{ transform: `${css} translateZ(27px)` }}
            aria-label={WORDS.viewFrom(sides[side].toLowerCase())}
            onClick={() => wishes.look(way)}
          >
            {sides[side]}
          </button>
        ))}
      </div>
      <button
        type="button"
        className="view-fit"
        title={`${WORDS.fit} (F)`}
        aria-label={WORDS.fit}
        onClick={() => wishes.fit()}
      >
        <svg
          width="15"
          height="15"
          viewBox="0 0 16 16"
          fill="none"
          stroke="currentColor"
          strokeWidth="1.5"
          strokeLinecap="round"
          aria-hidden="true"
        >
          <path d="M2 5.5V2h3.5M10.5 2H14v3.5M14 10.5V14h-3.5M5.5 14H2v-3.5" />
          <circle cx="8" cy="8" r="1.6" />
        </svg>
      </button>
    </div>
  );
}

/** CSS y points down, the camera's up: the rotation of the view with both flips. */
export function turnCube(cube: HTMLElement, camera: Camera): void {
  const e = camera.matrixWorldInverse.elements;
  const n = (value: number): string => value.toFixed(5);
  cube.style.transform = `matrix3d(${n(e[0]!)},${n(-e[1]!)},${n(e[2]!)},0,${n(-e[4]!)},${n(e[5]!)},${n(-e[6]!)},0,${n(e[8]!)},${n(-e[9]!)},${n(e[10]!)},0,0,0,0,1)`;
}
