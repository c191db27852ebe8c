/** Numbers of the robot commands. */
export const COMMAND = {
  alarm: 0x70,
  alarmHistory: 0x71,
  status: 0x72,
  job: 0x73,
  axisNames: 0x74,
  position: 0x75,
  positionError: 0x76,
  torque: 0x77,
  io: 0x78,
  register: 0x79,
  byte: 0x7a,
  integer: 0x7b,
  double: 0x7c,
  real: 0x7d,
  string: 0x7e,
  robotPosition: 0x7f,
  basePosition: 0x80,
  externalAxis: 0x81,
  reset: 0x82,
  power: 0x83,
  cycle: 0x84,
  display: 0x85,
  start: 0x86,
  select: 0x87,
  managementTime: 0x88,
  systemInfo: 0x89,
  moveCartesian: 0x8a,
  movePulse: 0x8b,
} as const;
/** A command for many values in a row has the number of the one for a single value and this. */
export const PLURAL = 0x288;

export const SERVICE = {
  getAll: 0x01,
  setAll: 0x02,
  getOne: 0x0e,
  setOne: 0x10,
  getMany: 0x33,
  setMany: 0x34,
  deleteFile: 0x09,
  saveFile: 0x15,
  loadFile: 0x16,
  listFiles: 0x32,
} as const;

/** What a status of an answer says. */
export const STATUS = { well: 0, noCommand: 0x08, noAttribute: 0x09, refused: 0x1f, noInstance: 0x28 } as const;

/** Instances of 0x82, 0x83, 0x84 and of the moves; 1 is on and 2 is off. */
export const RESET = { alarm: 1, error: 2 } as const;
export const POWER = { hold: 1, servo: 2, hlock: 3 } as const;
export const ON = 1;
export const OFF = 2;
export const CYCLE = { step: 1, once: 2, continuous: 3 } as const;
export const PULSE_PATH = { joint: 1, straight: 2 } as const;
export const CARTESIAN_PATH = { joint: 1, straight: 2, straightBy: 3 } as const;
/** Units of the speed of a move: 0.01 %, 0.1 mm/s, 0.1°/s. */
export const SPEED_CLASS = { ratio: 0, linear: 1, angular: 2 } as const;
/** Types of a position and frames of a move. */
export const FRAME = { pulse: 0, base: 16, robot: 17, tool: 18, user: 19, master: 20 } as const;
export const MOVE_FRAME = { base: 16, robot: 17, user: 18, tool: 19 } as const;

/** Added status: why a controller refuses. */
export const ADDED = {
  moving: 0x2010,
  heldByPendant: 0x2020,
  heldByPanel: 0x2030,
  heldOutside: 0x2040,
  heldByCommand: 0x2050,
  alarm: 0x2060,
  servoOff: 0x2070,
  wrongMode: 0x2080,
  fileInUse: 0x2090,
  noCommandRemote: 0x2100,
  notAccessible: 0x2110,
  confirmPosition: 0x3050,
  servoRefuses: 0x3450,
  memoryFull: 0x4010,
  editProhibited: 0x4020,
  sameJob: 0x4030,
  noSuchJob: 0x4040,
  noJobSelected: 0x4060,
  badJobName: 0x4190,
  syntax: 0x5110,
  noNopOrEnd: 0x5130,
  format: 0x5170,
  range: 0x5200,
  noCommand: 0xa000,
  noInstance: 0xa001,
  noAttribute: 0xa002,
  tooLarge: 0xa100,
  noPosition: 0xb001,
  size: 0xb003,
  outOfRange: 0xb004,
  noGroup: 0xb008,
  speed: 0xb009,
  frame: 0xb00b,
  positionType: 0xb00c,
  tool: 0xb00d,
  userFrame: 0xb00e,
  receiveTimeout: 0xe28b,
  fileEmpty: 0xe29c,
  cannotDelete: 0xe2af,
  remoteOff: 0xe2b2,
  noSuchFile: 0xe2b3,
  busy: 0xe444,
} as const;

const SENTENCES: Readonly<Record<number, string>> = {
  0x2010: "The manipulator is moving.",
  0x2020: "The teach pendant holds the robot.",
  0x2030: "The playback panel holds the robot.",
  0x2040: "An external signal holds the robot.",
  0x2050: "A command holds the robot.",
  0x2060: "An alarm or an error is present.",
  0x2070: "The servo power is off.",
  0x2080: "The mode switch stands wrong for this.",
  0x2090: "Somebody else is using the file.",
  0x2100: "Command remote is not set.",
  0x2110: "The data cannot be accessed.",
  0x2120: "The data cannot be loaded.",
  0x2130: "The data is being edited.",
  0x3010: "The servo power has to be turned on first.",
  0x3040: "The home position has to be set first.",
  0x3050: "The position of the robot has to be confirmed first.",
  0x3220: "The panel is locked.",
  0x3230: "The panel is locked.",
  0x3450: "The servo power cannot be turned on.",
  0x4010: "The memory is full.",
  0x4012: "The memory is full.",
  0x4020: "Editing of jobs is prohibited.",
  0x4030: "There is a job of this name already.",
  0x4040: "There is no such job.",
  0x4060: "No job has been selected.",
  0x4130: "The job has no position there.",
  0x4190: "That is no name for a job.",
  0x5110: "The job has a syntax error.",
  0x5130: "The job has no NOP or no END.",
  0x5170: "The job has a format error.",
  0x5200: "A value is out of range.",
  0xa000: "The command is not defined.",
  0xa001: "The instance of the command is not there.",
  0xa002: "The attribute of the command is not there.",
  0xa100: "The answer would be too large.",
  0xa101: "The answer would be too large.",
  0xb001: "The position variable is not set.",
  0xb003: "The data has the wrong size.",
  0xb004: "A value is out of range.",
  0xb005: "The data is not defined.",
  0xb008: "The control group is wrong.",
  0xb009: "The speed is out of range.",
  0xb00a: "The speed is out of range.",
  0xb00b: "The coordinate frame is not there.",
  0xb00c: "The type of position is not there.",
  0xb00d: "The tool is not there.",
  0xb00e: "The user frame is not there.",
  0xd8f1: "The controller is busy.",
  0xd8fa: "The controller is busy.",
  0xe28b: "The transfer took too long.",
  0xe29c: "The file is missing or empty.",
  0xe2a7: "The file is not in the list.",
  0xe2af: "The file cannot be deleted.",
  0xe2b2: "The controller is not in remote mode.",
  0xe2b3: "The file was not found.",
  0xe444: "The controller is busy.",
  0xfff6: "There are too many requests.",
  0xfffe: "Remote mode was lost.",
};

/** A refusal in words, with the codes a person finds in the manual. */
export function refusalSentence(status: number, added: number): string {
  const known =
    SENTENCES[added] ??
    (status === STATUS.noCommand
      ? "The controller does not know the command."
      : status === STATUS.noInstance
        ? "The controller does not have that instance."
        : status === STATUS.noAttribute
          ? "The controller does not have that attribute."
          : "The controller refused the command.");
  return `${known} (status ${hex(status, 2)}${added === 0 ? "" : `, ${hex(added, 4)}`})`;
}
const hex = (value: number, digits: number): string => value.toString(16).toUpperCase().padStart(digits, "0");
