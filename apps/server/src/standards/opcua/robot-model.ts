import { isSlide } from "@twincell/core";
import type { AddressSpace, DataType, EUInformation, UAObject, UAVariable, Variant } from "node-opcua";
import type { RobotState } from "../robot-states.ts";

type Library = typeof import("node-opcua");
/** Enumerations of OPC 40010-1. */
const ARTICULATED = 1;
const ROTARY = 1;
const LINEAR = 3;
const MODE_OF = { manual: 1, automatic: 3, remote: 4 } as const;
const SAMPLING_MS = 10;

export interface RobotModel {
  add(robot: RobotState, version: string): void;
  /** Variables for lines that had none yet. */
  lines(robot: RobotState): void;
  remove(robot: RobotState): void;
}
interface Added {
  readonly system: UAObject;
  readonly lines: UAObject;
  readonly known: Set<string>;
}

/** Motion device systems below DeviceSet, one a robot: values in the unit that each says, degrees for angles. */
export function createRobotModel(opcua: Library, space: AddressSpace): RobotModel {
  const {
    coerceNodeId,
    DataType: Type,
    StatusCodes,
    standardUnits,
    Variant: Value,
    VariantArrayType,
    LocalizedText,
  } = opcua;
  const robotics = space.getNamespaceIndex("http://opcfoundation.org/UA/Robotics/");
  const devices = space.getNamespaceIndex("http://opcfoundation.org/UA/DI/");
  const own = space.getOwnNamespace();
  const added = new Map<RobotState, Added>();
  const typeOf = (name: string) => space.findObjectType(name, robotics)!;
  const part = <Node extends UAObject | UAVariable>(of: UAObject, name: string): Node =>
    (of.getComponentByName(name, robotics) ??
      of.getComponentByName(name, devices) ??
      of.getPropertyByName(name, robotics) ??
      of.getPropertyByName(name, devices)) as Node;
  const variable = (of: UAObject, name: string): UAVariable => part<UAVariable>(of, name);
  const set = (of: UAObject, name: string, dataType: DataType, value: unknown): void => {
    variable(of, name).setValueFromSource({ dataType, value });
  };
  const text = (of: UAObject, name: string, value: string): void => {
    set(of, name, Type.LocalizedText, new LocalizedText({ text: value }));
  };
  /** What is asked for each time it is read or sampled. Without a value it says that it waits for the first. */
  const bind = (node: UAVariable, dataType: DataType, get: () => unknown): void => {
    node.minimumSamplingInterval = SAMPLING_MS;
    node.bindVariable(
      {
        get: (): Variant | typeof StatusCodes.BadWaitingForInitialData => {
          const value = get();
          return value === undefined ? StatusCodes.BadWaitingForInitialData : new Value({ dataType, value });
        },
      },
      true,
    );
  };
  const unit = (node: UAVariable, which: EUInformation): void => {
    const property = node.getPropertyByName("EngineeringUnits") as UAVariable | null;
    property?.setValueFromSource({
      dataType: Type.ExtensionObject,
      value: which,
      arrayType: VariantArrayType.Scalar,
    });
  };
  /** Of a motor nobody says who made it. */
  const identify = (of: UAObject, robot: RobotState | null): void => {
    text(of, "Manufacturer", robot?.model?.vendor ?? "");
    text(of, "Model", robot?.model?.name ?? "");
    set(of, "ProductCode", Type.String, robot?.model?.id ?? "");
    set(of, "SerialNumber", Type.String, "");
  };

  function axis(robot: RobotState, axes: UAObject, i: number): UAObject {
    const slides = isSlide(robot.model!.arm.joints[i]!);
    const scale = slides ? 1000 : 180 / Math.PI;
    const node = typeOf("AxisType").instantiate({
      browseName: { name: `Axis_${i + 1}`, namespaceIndex: own.index },
      displayName: robot.joints[i]!,
      componentOf: axes,
      optionals: ["ParameterSet.ActualSpeed"],
    });
    set(node, "MotionProfile", Type.Int32, slides ? LINEAR : ROTARY);
    const parameters = part<UAObject>(node, "ParameterSet");
    const position = variable(parameters, "ActualPosition");
    const speed = variable(parameters, "ActualSpeed");
    bind(position, Type.Double, () => (robot.sample === null ? undefined : robot.q_rad[i]! * scale));
    bind(speed, Type.Double, () => (robot.sample === null ? undefined : robot.speed_rad_s[i]! * (slides ? 1 : scale)));
    unit(position, slides ? standardUnits.millimetre : standardUnits.degree);
    unit(speed, slides ? standardUnits.metre_per_second : opcua.makeEUInformation("E96", "°/s", "degree per second"));
    return node;
  }
  function motionDevice(robot: RobotState, folder: UAObject): UAObject {
    const device = typeOf("MotionDeviceType").instantiate({
      browseName: { name: robot.id, namespaceIndex: own.index },
      displayName: robot.name,
      componentOf: folder,
      optionals: ["ParameterSet.InControl"],
    });
    identify(device, robot);
    set(device, "MotionDeviceCategory", Type.Int32, ARTICULATED);
    const parameters = part<UAObject>(device, "ParameterSet");
    bind(variable(parameters, "SpeedOverride"), Type.Double, () =>
      robot.sample === null ? undefined : robot.sample.override * 100,
    );
    bind(variable(parameters, "InControl"), Type.Boolean, () => robot.sample?.moving);
    const axes = part<UAObject>(device, "Axes");
    const trains = part<UAObject>(device, "PowerTrains");
    robot.joints.forEach((_, i) => {
      const moved = axis(robot, axes, i);
      // What motors a robot has is published by few makers: each axis has a train without figures, as the model asks.
      const train = typeOf("PowerTrainType").instantiate({
        browseName: { name: `PowerTrain_${i + 1}`, namespaceIndex: own.index },
        componentOf: trains,
      });
      const motor = typeOf("MotorType").instantiate({
        browseName: { name: "Motor", namespaceIndex: own.index },
        componentOf: train,
      });
      identify(motor, null);
      const temperature = variable(part<UAObject>(motor, "ParameterSet"), "MotorTemperature");
      unit(temperature, standardUnits.degree_celsius);
      temperature.setValueFromSource({ dataType: Type.Double, value: 0 }, StatusCodes.BadNotSupported);
      train.addReference({ referenceType: coerceNodeId(MOVES, robotics), nodeId: moved });
    });
    return device;
  }
  function controller(robot: RobotState, system: UAObject, device: UAObject, version: string): void {
    const node = typeOf("ControllerType").instantiate({
      browseName: { name: "Controller", namespaceIndex: own.index },
      componentOf: part<UAObject>(system, "Controllers"),
    });
    identify(node, robot);
    const software = space.findObjectType("SoftwareType", devices)!.instantiate({
      browseName: { name: "Twincell", namespaceIndex: own.index },
      componentOf: part<UAObject>(node, "Software"),
    });
    text(software, "Manufacturer", "Twincell");
    text(software, "Model", "Twincell");
    set(software, "SoftwareRevision", Type.String, version);
    const user = part<UAObject>(node, "CurrentUser");
    bind(variable(user, "Level"), Type.String, () => robot.connection.guard.state.holder ?? "");
    const task = typeOf("TaskControlType").instantiate({
      browseName: { name: "Task", namespaceIndex: own.index },
      componentOf: part<UAObject>(node, "TaskControls"),
    });
    set(task, "ComponentName", Type.LocalizedText, new LocalizedText({ text: "Task" }));
    const parameters = part<UAObject>(task, "ParameterSet");
    bind(variable(parameters, "TaskProgramName"), Type.String, () => robot.sample?.step);
    bind(variable(parameters, "TaskProgramLoaded"), Type.Boolean, () =>
      robot.sample === null ? undefined : robot.sample.step !== "",
    );
    node.addReference({ referenceType: coerceNodeId(CONTROLS, robotics), nodeId: device });
  }
  function safety(robot: RobotState, system: UAObject): void {
    const state = typeOf("SafetyStateType").instantiate({
      browseName: { name: "Safety", namespaceIndex: own.index },
      componentOf: part<UAObject>(system, "SafetyStates"),
    });
    const parameters = part<UAObject>(state, "ParameterSet");
    bind(variable(parameters, "EmergencyStop"), Type.Boolean, () =>
      robot.sample === null
        ? undefined
        : robot.sample.safety === "emergency-stop" || robot.connection.guard.state.emergency,
    );
    bind(variable(parameters, "ProtectiveStop"), Type.Boolean, () =>
      robot.sample === null
        ? undefined
        : robot.sample.safety === "protective-stop" || robot.sample.safety === "guard-stop",
    );
    bind(variable(parameters, "OperationalMode"), Type.Int32, () =>
      robot.sample === null ? undefined : MODE_OF[robot.sample.mode],
    );
  }
  function line(robot: RobotState, { lines, known }: Added, name: string): void {
    known.add(name);
    const isNumber = typeof robot.signals.get(name) === "number";
    const node = own.addVariable({
      browseName: { name, namespaceIndex: own.index },
      nodeId: `s=${robot.id}/lines/${name}`,
      componentOf: lines,
      dataType: isNumber ? Type.Double : Type.Boolean,
      minimumSamplingInterval: SAMPLING_MS,
    });
    bind(node, isNumber ? Type.Double : Type.Boolean, () => robot.signals.get(name));
  }
  return {
    add(robot, version) {
      if (robot.model === null) return;
      const system = typeOf("MotionDeviceSystemType").instantiate({
        browseName: { name: robot.id, namespaceIndex: own.index },
        displayName: robot.name,
        organizedBy: space.findNode(coerceNodeId(DEVICE_SET, devices))!,
      });
      const device = motionDevice(robot, part<UAObject>(system, "MotionDevices"));
      controller(robot, system, device, version);
      safety(robot, system);
      const lines = own.addObject({ browseName: { name: "Lines", namespaceIndex: own.index }, componentOf: system });
      added.set(robot, { system, lines, known: new Set() });
    },
    lines(robot) {
      const found = added.get(robot);
      if (!found) return;
      for (const name of robot.signals.keys()) if (!found.known.has(name)) line(robot, found, name);
    },
    remove(robot) {
      const found = added.get(robot);
      added.delete(robot);
      if (found) space.deleteNode(found.system);
    },
  };
}
/** DeviceSet of DI. */
const DEVICE_SET = 5001;
/** Types of reference of OPC 40010-1. */
const CONTROLS = 4002;
const MOVES = 18178;
