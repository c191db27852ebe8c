import {
  CONTACT_S,
  DENSITY_KGM3,
  FRICTION,
  PHYSICS_STEP_S,
  GRAVITY_MPS2,
  type DynamicsModel,
  type PhysicalObject,
  type PhysicalScene,
} from "@twincell/core";
import { armXml } from "./arm.ts";
import { CONTACT, GROUP } from "./contact-bits.ts";
import { solidGeoms, solidMass } from "./solid-geoms.ts";
import { element, placed, type Attributes } from "./xml.ts";

/** Friction against turning on the spot and against rolling, of a hard dry contact [m]; assumed. */
const SPIN_M = 0.004;
const ROLL_M = 0.0005;

/** The point that a proximity sensor measures from, as the engine measures: from a ball around it [m]. */
export const SENSOR_POINT_M = 1e-4;

/** What a part weighs: what is said, else its volume at the assumed density [kg]. */
export const partMass = ({ mass_kg, density_kgm3, shape }: PhysicalObject): number =>
  mass_kg ?? solidMass(shape).volume_m3 * (density_kgm3 ?? DENSITY_KGM3);

/** A finger touches a part: the name of the sensor that says so, in the order in which they stand in the model. */
export const FINGERS = ["finger-a", "finger-b"] as const;
/** Numbers of one such sensor: how many contacts, and their force in the world. */
export const TOUCH_SIZE = 4;

/**
 * The whole cell as an MJCF text: angles in rad, lengths in m. Bodies stand in the order arm, gripper, belts, parts,
 * people, which is that of their coordinates.
 */
export function sceneXml(scene: PhysicalScene, masses: DynamicsModel | undefined): string {
  const arm = armXml(scene, masses);
  const meshes = [...arm.meshes];
  const parts = scene.objects.filter(({ role }) => role === "part");
  const fixtures = scene.objects.filter(({ role }) => role === "fixture");
  const geoms = (object: PhysicalObject, name: string): string[] => geomsOf(object, name, meshes);
  const belts = fixtures.filter(({ belt }) => belt !== undefined);
  const still = fixtures.filter(({ belt }) => belt === undefined);
  const world = [
    ...floorOf(scene),
    ...sensorPoints(scene),
    ...still.map((object, i) =>
      element("body", { name: `fixture${i}`, ...placed(object.worldFromObject) }, geoms(object, `f${i}`)),
    ),
    arm.body,
    ...belts.map((object, i) =>
      element("body", { name: `belt${i}`, ...placed(object.worldFromObject), gravcomp: 1 }, [
        // The belt stands where it is and has a speed: its place is set back after every step. Nothing slows it down.
        element("joint", { type: "slide", axis: object.belt!.direction, armature: 1e4 }),
        element("inertial", { mass: 1, pos: [0, 0, 0], diaginertia: [1, 1, 1] }),
        ...geoms(object, `b${i}`),
      ]),
    ),
    ...parts.map((object, i) =>
      element("body", { name: `part${i}`, ...placed(object.worldFromObject) }, [
        element("freejoint"),
        inertial(object),
        ...geoms(object, `p${i}`),
      ]),
    ),
    ...scene.people.map((person, i) =>
      element("body", { name: `person${i}`, mocap: "true" }, mannequin(person.height_m)),
    ),
  ];
  const touches =
    scene.gripper === undefined
      ? []
      : FINGERS.flatMap(finger =>
          parts.map((_, i) =>
            element("contact", { body1: finger, body2: `part${i}`, num: 1, reduce: "netforce", data: "found force" }),
          ),
        );
  return element("mujoco", { model: "twincell" }, [
    ...settings(scene.step_s ?? PHYSICS_STEP_S),
    element("size", { memory: "24M" }),
    element("asset", {}, meshes.length > 0 ? meshes : [element("material", { name: "none" })]),
    element("worldbody", {}, world),
    ...(arm.equalities.length > 0 ? [element("equality", {}, arm.equalities)] : []),
    ...(arm.actuators.length > 0 ? [element("actuator", {}, arm.actuators)] : []),
    ...(touches.length > 0 ? [element("sensor", {}, touches)] : []),
  ]);
}

/** How the engine computes: angles in rad, elliptic friction cones, an implicit integrator with steps of `step_s`. */
const settings = (step_s: number): string[] => [
  element("compiler", {
    angle: "radian",
    autolimits: "false",
    boundmass: 0,
    balanceinertia: "false",
    inertiafromgeom: "auto",
    fusestatic: "false",
  }),
  element(
    "option",
    {
      timestep: step_s,
      gravity: [0, 0, -GRAVITY_MPS2],
      integrator: "implicitfast",
      cone: "elliptic",
      impratio: 20,
      iterations: 60,
    },
    [element("flag", { autoreset: "disable", multiccd: "enable" })],
  ),
];

/** The floor as a plane, where the scene has one. */
function floorOf({ floor_m }: PhysicalScene): string[] {
  if (floor_m === undefined) return [];
  return [
    element("geom", {
      name: "floor",
      type: "plane",
      size: [20, 20, 0.1],
      pos: [0, 0, floor_m],
      group: GROUP.fixture,
      ...CONTACT.fixture,
      friction: [FRICTION, SPIN_M, ROLL_M],
      solref: [CONTACT_S, 1],
    }),
  ];
}

/** The balls from which proximity sensors measure; they touch nothing. Named by the sensor's place in the scene. */
const sensorPoints = ({ sensors }: PhysicalScene): string[] =>
  sensors.flatMap((sensor, i) =>
    sensor.kind === "proximity"
      ? element("geom", {
          name: `sensor${i}`,
          type: "sphere",
          size: SENSOR_POINT_M,
          pos: sensor.at_m,
          group: GROUP.sensor,
          ...CONTACT.none,
        })
      : [],
  );

/**
 * The shapes of an object in its own frame; its mass is given apart from them.
 *
 * @param meshes  receives the meshes that hulls refer to.
 */
function geomsOf(object: PhysicalObject, name: string, meshes: string[]): string[] {
  return solidGeoms(object.shape).map((geom, i) => {
    const common = { name: `${name}g${i}`, mass: 0, ...surface(object) };
    switch (geom.kind) {
      case "box":
        return element("geom", {
          ...common,
          type: "box",
          size: geom.size_m.map(length => length / 2),
          pos: geom.at_m,
        });
      case "sphere":
        return element("geom", { ...common, type: "sphere", size: geom.radius_m, pos: geom.at_m, condim: 6 });
      case "cylinder":
        return element("geom", {
          ...common,
          type: "cylinder",
          size: [geom.radius_m, geom.height_m / 2],
          pos: geom.at_m,
          condim: 6,
        });
      case "hull":
        meshes.push(element("mesh", { name: `${name}m${i}`, vertex: geom.points_m, inertia: "convex" }));
        return element("geom", { ...common, type: "mesh", mesh: `${name}m${i}` });
    }
  });
}

/** A surface that says its friction decides where it touches one that does not. */
const surface = ({ role, friction, softness_s }: PhysicalObject): Attributes => ({
  group: role === "part" ? GROUP.part : GROUP.fixture,
  ...(role === "part" ? CONTACT.part : CONTACT.fixture),
  condim: 4,
  friction: [friction ?? FRICTION, (friction ?? 1) === 0 ? 0 : SPIN_M, (friction ?? 1) === 0 ? 0 : ROLL_M],
  priority: friction === undefined ? 0 : 1,
  solref: [Math.max(CONTACT_S, softness_s ?? CONTACT_S), 1],
});

function inertial(object: PhysicalObject): string {
  const { volume_m3, center_m, inertia_m5 } = solidMass(object.shape);
  const mass_kg = partMass(object);
  const density = mass_kg / volume_m3;
  return element("inertial", { mass: mass_kg, pos: center_m, fullinertia: inertia_m5.map(each => each * density) });
}

/** Legs, trunk and head that rays and distances meet; it pushes nothing. */
function mannequin(height_m: number): string[] {
  const look = { group: GROUP.person, ...CONTACT.none, mass: 0 } as const;
  const h = height_m;
  return [
    ...[1, -1].map(side =>
      element("geom", {
        ...look,
        type: "capsule",
        fromto: [0, side * 0.055 * h, 0.05 * h, 0, side * 0.055 * h, 0.47 * h],
        size: 0.05 * h,
      }),
    ),
    element("geom", { ...look, type: "capsule", fromto: [0, 0, 0.55 * h, 0, 0, 0.77 * h], size: 0.11 * h }),
    ...[1, -1].map(side =>
      element("geom", {
        ...look,
        type: "capsule",
        fromto: [0, side * 0.14 * h, 0.45 * h, 0, side * 0.14 * h, 0.8 * h],
        size: 0.025 * h,
      }),
    ),
    element("geom", { ...look, type: "sphere", pos: [0, 0, 0.93 * h], size: 0.07 * h }),
  ];
}
