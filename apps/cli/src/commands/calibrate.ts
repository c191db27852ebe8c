import {
  fitAccelerometer,
  flangePose,
  frameFromThreePoints,
  pose,
  profileOfHand,
  registerPoints,
  tcpFromTouches,
  tcpOrientation,
  type Pose,
  type Robot,
  type Vector3,
} from "@twincell/core";
import { given } from "../io/arguments.ts";
import { readText } from "../io/files.ts";
import { robotOf } from "../io/robot.ts";
import { UseFault, type Command } from "../io/usage.ts";
import { jointsAt, poseAt } from "../io/values.ts";

export const calibrateCommand: Command = {
  name: "calibrate",
  summary: "a tool tip from touches, a frame from measured points, or the glove of a hand, with what is left over",
  usage: `twincell calibrate tcp FILE [--robot R]
twincell calibrate frame FILE
twincell calibrate hand FILE

FILE is JSON, "-" is standard input. Lengths in metres. Writes one JSON object; ends with 1 where the measurements do not suffice,
and "sentence" says what is missing.

tcp     {"touches":[POSE, POSE, POSE, POSE, …]}   poses of the flange while the tip touches one fixed point, four or more, tilted about two
        directions; {"q":[…]} in place of a POSE with --robot. Adds the orientation where "alongX" and "inXy" are given: the same while a
        point on the tool's +x axis and one of its xy plane (y > 0) touch.
        → {"kind":"calibrated","flangeFromTcp":POSE,"fixedPoint":[…],"rms_m","worst_m","worst","each_m":[…],"spread_rad","weakest":[…],"uncertainty_m","sentence"}
frame   {"origin":[x,y,z],"alongX":[x,y,z],"inXy":[x,y,z]}
        → {"kind":"frame","frame":POSE,"alongX_m","inPlane_m","angle_rad","offSquare_rad","sentence"}
        or {"points":[{"known":[x,y,z],"measured":[x,y,z]}, …]}, three or more, known in the thing's own frame
        → {"kind":"registered","frame":POSE,"rms_m","worst_m","worst","each_m":[…],"sentence"}
hand    {"name":"Ana","fingers":[[raw, …] five times],"accelerometer":[{"voltage_V","acceleration_mps2"}, …]}   raw readings (0…4095) of each finger
        while the hand opens and closes, thumb first; voltages of the tracker at known accelerations, turned to +g, 0 and −g for instance
        → the profile of that hand for "twincell demonstrate raw", with "rms_mps2"`,
  async run(args) {
    const options = given(args, { robot: { type: "string" }, json: { type: "boolean" } });
    const [what, path] = options.positionals;
    if (what !== "tcp" && what !== "frame" && what !== "hand")
      throw new UseFault(
        what === undefined ? "What to calibrate is missing." : `"${what}" cannot be calibrated.`,
        "Give tcp, frame or hand, then FILE.",
      );
    if (path === undefined) throw new UseFault("FILE is missing.", 'Give the path of a JSON file, or "-".');
    const file = recordOf(path, await readText(path));
    const robot = options.text("robot") === undefined ? undefined : (await robotOf(options)).robot;
    const answer = what === "tcp" ? tcp(path, file, robot) : what === "frame" ? frame(path, file) : hand(path, file);
    process.stdout.write(`${JSON.stringify(answer)}\n`);
    return answer["sentence"] === undefined || GOOD.has(answer["kind"]) ? 0 : 1;
  },
};

type Answer = Record<string, unknown>;

function tcp(path: string, file: Answer, robot: Robot | undefined): Answer {
  const touchAt = (value: unknown, where: string): Pose<"base", "flange"> => {
    if (!isRecord(value) || !("q" in value)) return poseAt(value, `${path}: ${where}`) as Pose<"base", "flange">;
    if (robot === undefined) throw new UseFault(`${path}: ${where} holds joint angles; --robot is missing.`);
    return flangePose(robot.arm, jointsAt(value, `${path}: ${where}`, robot.arm.joints.length, robot.name));
  };
  const touches = file["touches"];
  const { alongX, inXy } = file;
  if (!Array.isArray(touches)) throw new UseFault(`${path} wants "touches" as a list of poses.`);
  if ((alongX === undefined) !== (inXy === undefined))
    throw new UseFault(`${path}: the orientation wants both "alongX" and "inXy".`);
  const answer = tcpFromTouches(touches.map((touch: unknown, i) => touchAt(touch, `touch ${i + 1}`)));
  if (answer.kind !== "calibrated") return { ...answer };
  const { tip, residual, ...rest } = answer;
  if (alongX === undefined) return { ...rest, flangeFromTcp: pose(tip), ...residual };
  const turned = tcpOrientation(tip, answer.fixedPoint, touchAt(alongX, "alongX"), touchAt(inXy, "inXy"));
  return turned.kind === "frame"
    ? { ...rest, flangeFromTcp: turned.intoFromFrame, ...residual, offSquare_rad: turned.offSquare_rad }
    : { ...turned };
}

function frame(path: string, file: Answer): Answer {
  const points = file["points"];
  if (points === undefined) {
    const answer = frameFromThreePoints(
      pointAt(path, file["origin"], '"origin"'),
      pointAt(path, file["alongX"], '"alongX"'),
      pointAt(path, file["inXy"], '"inXy"'),
    );
    if (answer.kind !== "frame") return { ...answer };
    const { intoFromFrame, ...rest } = answer;
    return { ...rest, frame: intoFromFrame };
  }
  if (!Array.isArray(points)) throw new UseFault(`${path} wants "points" as a list.`);
  const answer = registerPoints(
    points.map((pair: unknown, i) => {
      if (!isRecord(pair)) throw new UseFault(`${path}: point ${i + 1} wants {"known":[…],"measured":[…]}.`);
      return {
        known: pointAt(path, pair["known"], `"known" of point ${i + 1}`),
        measured: pointAt(path, pair["measured"], `"measured" of point ${i + 1}`),
      };
    }),
  );
  if (answer.kind !== "registered") return { ...answer };
  return { kind: answer.kind, frame: answer.intoFromFrame, ...answer.residual, sentence: answer.sentence };
}

const GOOD = new Set<unknown>(["calibrated", "frame", "registered"]);

function hand(path: string, file: Answer): Answer {
  const { name, fingers, accelerometer } = file;
  if (typeof name !== "string" || name.trim() === "") throw new UseFault(`${path} wants "name", the person's.`);
  if (!Array.isArray(fingers) || !fingers.every(isNumbers))
    throw new UseFault(`${path} wants "fingers" as five lists of numbers.`);
  const readings = (Array.isArray(accelerometer) ? accelerometer : []).map((reading: unknown, i) => {
    const { voltage_V, acceleration_mps2 } = isRecord(reading) ? reading : {};
    if (typeof voltage_V !== "number" || typeof acceleration_mps2 !== "number")
      throw new UseFault(`${path}: reading ${i + 1} wants {"voltage_V","acceleration_mps2"}.`);
    return { voltage_V, acceleration_mps2 };
  });
  const line = fitAccelerometer(readings);
  if (line.kind !== "fitted") return { ...line };
  const answer = profileOfHand(name, fingers, line.line);
  return answer.kind === "profile" ? { ...answer.profile, rms_mps2: line.rms_mps2 } : { ...answer };
}
const isNumbers = (value: unknown): value is number[] =>
  Array.isArray(value) && value.every(each => typeof each === "number");

const isRecord = (value: unknown): value is Answer =>
  typeof value === "object" && value !== null && !Array.isArray(value);

function recordOf(path: string, text: string): Answer {
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch (problem) {
    throw new UseFault(`${path} is not JSON: ${(problem as Error).message}.`);
  }
  if (!isRecord(value)) throw new UseFault(`${path} wants one JSON object.`);
  return value;
}

function pointAt(path: string, value: unknown, name: string): Vector3 {
  if (
    !Array.isArray(value) ||
    value.length !== 3 ||
    !value.every(each => typeof each === "number" && Number.isFinite(each))
  )
    throw new UseFault(`${path}: ${name} wants three finite numbers.`);
  return value as Vector3;
}
