import { Minus, Plus, Power, RotateCcw } from "lucide-react";
import { useEffect, useMemo, useRef, useState } from "react";
import type { CartesianAxis, CommandOutcome } from "@twincell/core";
import { stationLive } from "../../runtime/robot/stations.ts";
import { connectedRobot, type ConnectedRobot } from "../../runtime/robot/connected-robot.ts";
import { isCarryingOut, type StationState } from "../../stores/stations.ts";
import { Segments } from "../../ui/Choice.tsx";
import { EnablingSwitch } from "../../ui/EnablingSwitch.tsx";
import { HoldButton } from "../../ui/HoldButton.tsx";
import { NumberField } from "../../ui/NumberField.tsx";
import { Slide } from "../../ui/Slide.tsx";
import { useEnablingSwitch } from "../../ui/useEnablingSwitch.ts";
import { say, words } from "../../messages/index.ts";
import { fixed } from "../../messages/numbers.ts";
import { Tester } from "./Tester.tsx";
import { SignalControl } from "./SignalControl.tsx";
import "./direct.css";

/** Everything that moves one connected robot by hand; motion only while the enabling switch is held. */
export function DirectControl({ station }: { readonly station: StationState }) {
  const { id, guard, safety, link } = station;
  const area = useRef<HTMLElement>(null);
  const robot = useMemo(() => connectedRobot(id), [id]);
  const [said, setSaid] = useState("");
  const ready =
    link.state === "open" && guard.link === "up" && !guard.watching && safety === "normal" && !isCarryingOut(station);
  const enabling = useEnablingSwitch(area, enabled => robot.setEnabled(enabled));
  const may = ready && enabling.enabled;
  const off = safety === "emergency-stop" || guard.emergency;
  /** A motion that was stopped by letting go is told by the robot that stands, not by a sentence. */
  const tell = (outcome: Promise<CommandOutcome>): void => {
    void outcome.then(ended => setSaid(ended.kind === "refused" ? say(ended.why.sentence) : ""));
  };
  return (
    <section className="direct" aria-label={words.direct.title} ref={area} tabIndex={-1}>
      <h3 className="small dim">{words.direct.title}</h3>
      <JogKeys id={id} robot={robot} may={may} tell={tell} />
      <div className="direct-buttons">
        <button className="btn" disabled={!may} onClick={() => tell(robot.moveToZero())}>
          {words.direct.zero}
        </button>
        <button className="btn" disabled={!may} onClick={() => tell(robot.moveHome())}>
          {words.direct.home}
        </button>
        <button className="btn" disabled={!may} onClick={() => tell(robot.setGripper(false))}>
          {words.direct.gripperOpen}
        </button>
        <button className="btn" disabled={!may} onClick={() => tell(robot.setGripper(true))}>
          {words.direct.gripperClose}
        </button>
      </div>
      <SignalControl robot={robot} may={may} tell={tell} />
      <Override station={station} onDone={percent => tell(robot.setOverride(percent))} />
      <Tester id={id} robot={robot} may={may} />
      <p className="small direct-says" role="status">
        {off ? words.direct.drivesAreOff : said}
      </p>
      <div className="direct-foot">
        <EnablingSwitch of={enabling} disabled={!ready} />
        {off ? (
          <button className="btn direct-off" onClick={() => tell(robot.reset())}>
            <RotateCcw />
            {words.direct.reset}
          </button>
        ) : (
          <button className="btn direct-off" disabled={link.state !== "open"} onClick={() => robot.drivesOff()}>
            <Power />
            {words.direct.drivesOff}
          </button>
        )}
      </div>
      <p className="small muted">{words.direct.drivesOffNote}</p>
    </section>
  );
}

function Override({ station, onDone }: { readonly station: StationState; readonly onDone: (percent: number) => void }) {
  const [wanted, setWanted] = useState<number | null>(null);
  const percent = wanted ?? Math.round(station.override * 100);
  return (
    <div className="direct-override">
      <span className="small muted">{words.direct.override}</span>
      <Slide
        label={words.direct.override}
        value={percent}
        min={0}
        max={100}
        step={1}
        says={`${percent} %`}
        onChange={setWanted}
        onDone={value => {
          setWanted(null);
          onDone(value);
        }}
      />
      <span className="num small">{percent} %</span>
    </div>
  );
}

type Frame = keyof typeof words.direct.frames;
type JogMode = keyof typeof words.direct.manners;
const entries = <Key extends string>(of: Readonly<Record<Key, string>>) =>
  (Object.keys(of) as Key[]).map(value => ({ value, words: of[value] }));

/** A row for each joint or axis: minus, its angle, plus. */
function JogKeys({
  id,
  robot,
  may,
  tell,
}: {
  readonly id: string;
  readonly robot: ConnectedRobot;
  readonly may: boolean;
  readonly tell: (outcome: Promise<CommandOutcome>) => void;
}) {
  const [frame, setFrame] = useState<Frame>("joint");
  const [manner, setManner] = useState<JogMode>("held");
  const [angle_rad, setAngle] = useState(Math.PI / 180);
  const [length_m, setLength] = useState(0.01);
  const count = frame === "joint" ? (stationLive(id)?.q_rad.length ?? 0) : 6;
  const jog = (row: number, sign: 1 | -1): void => {
    const by = manner === "held" ? Infinity : frame !== "joint" && row < 3 ? length_m : angle_rad;
    tell(
      frame === "joint"
        ? robot.jogJoint(row + 1, sign * by)
        : robot.jogCartesian(row as CartesianAxis, sign * by, frame),
    );
  };
  return (
    <>
      <Segments label={words.direct.frame} value={frame} options={entries(words.direct.frames)} onChange={setFrame} />
      <Segments
        label={words.direct.manner}
        value={manner}
        options={entries(words.direct.manners)}
        onChange={setManner}
      />
      {manner === "step" && (
        <div className="direct-steps">
          <NumberField
            label={words.direct.stepAngle}
            quantity="angle"
            value={angle_rad}
            min={0.0001}
            max={Math.PI / 2}
            onChange={setAngle}
          />
          {frame !== "joint" && (
            <NumberField
              label={words.direct.stepLength}
              quantity="length"
              value={length_m}
              min={0.0001}
              max={0.2}
              onChange={setLength}
            />
          )}
        </div>
      )}
      <div className="direct-keys" data-dim={!may || undefined}>
        {Array.from({ length: count }, (_, row) => {
          const name = frame === "joint" ? words.direct.joint(row + 1) : words.direct.axes[row]!;
          const key = (sign: 1 | -1) => {
            const label = sign > 0 ? words.direct.plus(name) : words.direct.minus(name);
            const icon = sign > 0 ? <Plus /> : <Minus />;
            return manner === "held" ? (
              <HoldButton
                label={label}
                onHold={() => {
                  if (may) jog(row, sign);
                }}
                onRelease={() => robot.stopJog()}
              >
                {icon}
              </HoldButton>
            ) : (
              <button className="btn icon" aria-label={label} disabled={!may} onClick={() => jog(row, sign)}>
                {icon}
              </button>
            );
          };
          return (
            <div className="direct-key" key={name}>
              {key(-1)}
              <span className="grow direct-name">
                {name}
                {frame === "joint" && <Angle id={id} joint={row + 1} />}
              </span>
              {key(1)}
            </div>
          );
        })}
      </div>
    </>
  );
}

/** Read ten times a second, outside React's state. */
function Angle({ id, joint }: { readonly id: string; readonly joint: number }) {
  const out = useRef<HTMLOutputElement>(null);
  useEffect(() => {
    const write = (): void => {
      const q_rad = stationLive(id)?.q_rad[joint - 1];
      if (out.current && q_rad !== undefined)
        out.current.textContent = `${fixed((q_rad * 180) / Math.PI, 2).replace("-", "−")}°`;
    };
    write();
    const timer = setInterval(write, 100);
    return () => clearInterval(timer);
  }, [id, joint]);
  return <output className="num" ref={out} />;
}
