import { useFrame, type ThreeEvent } from "@react-three/fiber";
import { useEffect, useRef } from "react";
import type { Mesh } from "three";
import { useStore } from "zustand";
import { theHistory } from "../../runtime/robot/cell-control.ts";
import { beginLookingBack } from "../../runtime/history/looking-back.ts";
import { historyStore } from "../../stores/history.ts";
import { toggleRoom } from "../../stores/room.ts";
import { WORDS } from "../words.ts";
import type { KeyAim } from "./grabber.ts";
import { Key, Row } from "./keys.tsx";
import { RoomPanel, Words } from "./room-panel.tsx";
import { fixed } from "../../messages/numbers.ts";
import { say } from "../../messages/index.ts";

const WIDTH_PX = 900;
const LINE_M = 0.82;
const LINE_HEIGHT_M = 0.1;
const ABOVE_BAR_M = 0.15;
const MOST_RUNS = 4;
const MOST_MARKS = 120;
const QUIET = "#b9c4ca";
const WARNS = "#ffcf70";
const clock = (t_s: number): string => `${Math.floor(t_s / 60)}:${fixed(t_s % 60, 1).padStart(4, "0")}`;
/** With the stick all the way over, so much of what is shown passes in a second; near its middle, slowly. */
const STICK_PART_PER_S = 0.25;
const STICK_DEAD = 0.15;

/** The time line of what was recorded, in the room: the robots stand where they stood then (row T-54). */
export function PastPanel({ keys }: { readonly keys: KeyAim }) {
  const there = useStore(historyStore, state => state.open !== null || state.name !== "");
  const opening = useStore(historyStore, state => state.opening);
  // Looking back begins with the panel and ends with it: then the robot is where it is.
  useEffect(() => beginLookingBack(), []);
  return (
    <RoomPanel
      id="past-panel"
      place={[-0.95, 1.25, -0.95]}
      turn_rad={0.75}
      width={WIDTH_PX}
      keys={keys}
      title={<Title />}
      above={there && !opening && <Line keys={keys} />}
    >
      {there ? (
        <>
          <Row>
            <PlayKey />
            <Key id="past-alarm" words={WORDS.lastAlarm} onPress={theHistory.lastAlarm} />
          </Row>
          <Row>
            <NowKey />
          </Row>
          <Says />
        </>
      ) : (
        <Runs />
      )}
    </RoomPanel>
  );
}

// Each of these changes by itself: a key that is made anew ten times a second could not be pressed.
function Title() {
  const { open, name, t_s, duration_s } = useStore(historyStore);
  const there = open !== null || name !== "";
  return (
    <>
      <Words>{there ? name : WORDS.history}</Words>
      <Words color={QUIET}>{there ? WORDS.past(clock(t_s), clock(duration_s)) : ""}</Words>
    </>
  );
}
function PlayKey() {
  const playing = useStore(historyStore, state => state.playing);
  return (
    <Key
      id="past-play"
      words={playing ? WORDS.pause : WORDS.play}
      color="#3fb8b3"
      ink="#04211f"
      atOnce
      onPress={playOrPause}
    />
  );
}
function playOrPause(): void {
  if (historyStore.getState().playing) theHistory.pause();
  else theHistory.play();
}
const NowKey = () => (
  <Key
    id="past-now"
    words={WORDS.backToNow}
    onPress={() => {
      toggleRoom("history");
    }}
  />
);
function Says() {
  const recorded = useStore(historyStore, state => state.moment.recorded);
  const message = useStore(historyStore, state => state.moment.message);
  return (
    <Words color={recorded && !message ? QUIET : WARNS}>{!recorded ? WORDS.gap : say(message) || WORDS.stick}</Words>
  );
}

/** Nothing is open: the last runs to choose from. */
function Runs() {
  const runs = useStore(historyStore, state => state.runs);
  return (
    <>
      <Words color={QUIET}>{runs.length === 0 ? WORDS.noRuns : WORDS.chooseRun}</Words>
      {runs.slice(0, MOST_RUNS).map((run, i) => (
        <Row key={run.id}>
          <Key
            id={`past-run-${i}`}
            words={run.name}
            onPress={() => {
              void theHistory.open(run.id);
            }}
          />
        </Row>
      ))}
      <Row>
        <NowKey />
      </Row>
    </>
  );
}

/** The line itself: the ray goes along it, the stick moves through it. */
function Line({ keys }: { readonly keys: KeyAim }) {
  const marks = useStore(historyStore, state => state.marks);
  const { from_s, to_s } = useStore(historyStore, state => state.window);
  const shown_s = Math.max(to_s - from_s, 0.001);
  const past = useRef<Mesh>(null);
  const head = useRef<Mesh>(null);
  const pressed = useRef(false);
  useEffect(
    () => () => {
      keys.delete("past-line");
    },
    [keys],
  );
  useFrame(({ gl }, dt_s) => {
    const { t_s, duration_s } = historyStore.getState();
    const part = Math.min(1, Math.max(0, (t_s - from_s) / shown_s));
    if (past.current && head.current) {
      past.current.scale.x = Math.max(1e-4, part * LINE_M);
      past.current.position.x = ((part - 1) * LINE_M) / 2;
      head.current.position.x = (part - 0.5) * LINE_M;
    }
    for (const source of gl.xr.getSession()?.inputSources ?? []) {
      const tilt = source.handedness === "right" ? (source.gamepad?.axes[2] ?? 0) : 0;
      if (Math.abs(tilt) > STICK_DEAD)
        theHistory.seek(
          Math.min(
            duration_s,
            Math.max(0, t_s + tilt * Math.abs(tilt) * STICK_PART_PER_S * shown_s * Math.min(dt_s, 0.1)),
          ),
        );
    }
  });
  const scrub = (event: ThreeEvent<PointerEvent>): void => {
    if (pressed.current && event.uv) theHistory.seek(from_s + event.uv.x * shown_s);
  };
  const shown = marks.filter(mark => mark.at_s >= from_s && mark.at_s <= to_s);
  const every = Math.ceil(shown.length / MOST_MARKS);
  return (
    <group position-y={ABOVE_BAR_M}>
      <mesh
        name="past-line"
        scale={[LINE_M, LINE_HEIGHT_M, 1]}
        onPointerEnter={() => {
          keys.add("past-line");
        }}
        onPointerLeave={() => {
          keys.delete("past-line");
          pressed.current = false;
        }}
        onPointerDown={event => {
          pressed.current = true;
          theHistory.pause();
          scrub(event);
        }}
        onPointerMove={scrub}
        onPointerUp={() => {
          pressed.current = false;
        }}
      >
        <planeGeometry />
        <meshBasicMaterial color="#232b30" toneMapped={false} />
      </mesh>
      <mesh ref={past} position-z={0.002} scale-y={LINE_HEIGHT_M} pointerEvents="none">
        <planeGeometry />
        <meshBasicMaterial color="#2a6f6c" toneMapped={false} />
      </mesh>
      {shown
        .filter((mark, i) => mark.level === "error" || i % every === 0)
        .slice(0, MOST_MARKS)
        .map((mark, i) => (
          <mesh
            key={i}
            position={[((mark.at_s - from_s) / shown_s - 0.5) * LINE_M, 0, 0.004]}
            scale={[0.005, LINE_HEIGHT_M, 1]}
            pointerEvents="none"
          >
            <planeGeometry />
            <meshBasicMaterial
              color={mark.level === "error" ? "#ff6157" : mark.level === "warning" ? "#f0b443" : "#8b98a0"}
              toneMapped={false}
            />
          </mesh>
        ))}
      <mesh ref={head} position-z={0.006} scale={[0.012, LINE_HEIGHT_M + 0.03, 1]} pointerEvents="none">
        <planeGeometry />
        <meshBasicMaterial color="#f2f6f8" toneMapped={false} />
      </mesh>
    </group>
  );
}
