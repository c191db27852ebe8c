import { personAt, type PeopleZone, type Person, type Sensor } from "@twincell/core";
import type { CellDocument } from "@twincell/project";
import { useFrame } from "@react-three/fiber";
import { useMemo, useRef } from "react";
import { BufferGeometry, Float32BufferAttribute, type Group, Line, LineBasicMaterial, LineLoop } from "three";
import { physicsNow } from "../../runtime/physics/physics.ts";
import type { SceneTheme } from "../theme.ts";

/** What the cell watches: beams and ranges of sensors, zones on the floor, and the people who walk there. */
export function WatchedView({ document, theme }: { readonly document: CellDocument; readonly theme: SceneTheme }) {
  return (
    <>
      {document.sensors?.map((sensor, i) =>
        sensor.kind === "beam" ? (
          <Beam key={sensor.id} sensor={sensor} index={i} theme={theme} />
        ) : (
          <Range key={sensor.id} sensor={sensor} theme={theme} />
        ),
      )}
      {document.zones?.map(zone => (
        <Zone key={zone.id} zone={zone} theme={theme} />
      ))}
      {document.people?.map((person, i) => (
        <Walker key={person.id} person={person} index={i} theme={theme} />
      ))}
    </>
  );
}

const lineOf = (points: readonly number[], closed: boolean): Line => {
  const geometry = new BufferGeometry().setAttribute("position", new Float32BufferAttribute(points, 3));
  const material = new LineBasicMaterial({ toneMapped: false, transparent: true, opacity: 0.85 });
  const made = closed ? new LineLoop(geometry, material) : new Line(geometry, material);
  made.userData.unpickable = true;
  made.raycast = () => undefined;
  return made;
};

/** The light of a photo-cell; another colour while it is cut. */
function Beam({
  sensor,
  index,
  theme,
}: {
  readonly sensor: Extract<Sensor, { kind: "beam" }>;
  readonly index: number;
  readonly theme: SceneTheme;
}) {
  const line = useMemo(() => lineOf([...sensor.from_m, ...sensor.to_m], false), [sensor]);
  const material = line.material as LineBasicMaterial;
  useMemo(() => {
    material.color = theme.bad;
  }, [material, theme]);
  useFrame(() => {
    material.color = physicsNow()?.tripped[index] === 1 ? theme.near : theme.bad;
  }, -9);
  return (
    <>
      <primitive object={line} />
      {[sensor.from_m, sensor.to_m].map((at, i) => (
        <mesh key={i} position={at} castShadow>
          <boxGeometry args={[0.03, 0.03, 0.03]} />
          <meshStandardMaterial color="#33393d" roughness={0.5} metalness={0.2} />
        </mesh>
      ))}
    </>
  );
}

const Range = ({
  sensor,
  theme,
}: {
  readonly sensor: Extract<Sensor, { kind: "proximity" }>;
  readonly theme: SceneTheme;
}) => (
  <mesh position={sensor.at_m} raycast={() => undefined}>
    <sphereGeometry args={[sensor.range_m, 24, 16]} />
    <meshBasicMaterial color={theme.accent} transparent opacity={0.08} depthWrite={false} />
  </mesh>
);

function Zone({ zone, theme }: { readonly zone: PeopleZone; readonly theme: SceneTheme }) {
  const line = useMemo(
    () =>
      lineOf(
        zone.outline_m.flatMap(([x, y]) => [x, y, 0.004]),
        true,
      ),
    [zone],
  );
  useMemo(() => {
    (line.material as LineBasicMaterial).color = zone.reaction.kind === "stop" ? theme.bad : theme.near;
  }, [line, zone, theme]);
  return <primitive object={line} />;
}

/** Someone who walks: legs, trunk, arms, head, in the proportions that the sensors see. */
function Walker({
  person,
  index,
  theme,
}: {
  readonly person: Person;
  readonly index: number;
  readonly theme: SceneTheme;
}) {
  const group = useRef<Group>(null);
  const start = useMemo(() => personAt(person, 0), [person]);
  const h = person.height_m;
  useFrame(() => {
    const people = physicsNow()?.people;
    const x = people?.[3 * index] ?? start.x_m;
    const y = people?.[3 * index + 1] ?? start.y_m;
    const heading = people?.[3 * index + 2] ?? start.heading_rad;
    group.current?.position.set(x, y, 0);
    group.current?.rotation.set(0, 0, heading);
  }, -9);
  const limb = (key: string, y: number, from: number, to: number, radius: number) => (
    <mesh key={key} position={[0, y * h, ((from + to) / 2) * h]} rotation-x={Math.PI / 2} castShadow>
      <capsuleGeometry args={[radius * h, (to - from) * h, 6, 16]} />
      <meshStandardMaterial color={theme.accent} roughness={0.8} />
    </mesh>
  );
  return (
    <group ref={group}>
      {[1, -1].map(side => limb(`leg ${side}`, side * 0.055, 0.05, 0.47, 0.05))}
      {limb("trunk", 0, 0.55, 0.77, 0.11)}
      {[1, -1].map(side => limb(`arm ${side}`, side * 0.14, 0.45, 0.8, 0.025))}
      <mesh position={[0, 0, 0.93 * h]} castShadow>
        <sphereGeometry args={[0.07 * h, 20, 14]} />
        <meshStandardMaterial color={theme.text} roughness={0.8} />
      </mesh>
    </group>
  );
}
