import { degrees, millimetres } from "@twincell/core";
import { useFrame } from "@react-three/fiber";
import { Container, Text } from "@react-three/uikit";
import { useEffect, useRef, useState } from "react";
import { useStore } from "zustand";
import { theLive } from "../../runtime/live.ts";
import { cellStore } from "../../stores/cell.ts";
import { programOf } from "../../stores/document.ts";
import { runCommand } from "../../stores/commands.ts";
import { leaveHeadset } from "../../stores/headset.ts";
import { jogStore } from "../../stores/jog.ts";
import { noticeStore } from "../../stores/notices.ts";
import { playStore } from "../../stores/play.ts";
import { deleteSteps } from "../../stores/program.ts";
import { toggleRoom } from "../../stores/room.ts";
import { sound } from "../../stores/sound.ts";
import { stationStore } from "../../stores/stations.ts";
import { stopEverything } from "../../stores/stop.ts";
import { watchStore } from "../../stores/watch.ts";
import { WORDS } from "../words.ts";
import { aimAt, type KeyAim } from "./grabber.ts";
import { Key, Row, WORDS_PX } from "./keys.tsx";
import { fixed } from "../../messages/numbers.ts";
import { say } from "../../messages/index.ts";

const READ_EVERY_S = 0.3;
/** Capitals of 32 px are 12 mm high: at half an arm's length as large as 29 mm at 1.2 m. */
const METRES_PER_PIXEL = 0.0005;

/** The menu that rides on a wrist. `wearer`: the hand it rides on, whose own ray passes through it. */
export function WristPanel({ keys, wearer }: { readonly keys: KeyAim; readonly wearer: XRHandedness }) {
  useEffect(
    () => () => {
      aimAt(keys, "wrist", false);
    },
    [keys],
  );
  return (
    <Container
      id="wrist-panel"
      flexDirection="column"
      gap={12}
      padding={18}
      width={480}
      pixelSize={METRES_PER_PIXEL}
      backgroundColor="#161a1d"
      borderRadius={22}
      borderWidth={2}
      borderColor="#3a444a"
      pointerEventsType={(_id: number, _type: string, state: unknown) => handOf(state) !== wearer}
      onHoverChange={(aimed: boolean) => {
        aimAt(keys, "wrist", aimed);
      }}
    >
      <ReadOut />
      <State />
      <Said />
      <Row>
        <Key
          id="record"
          words={WORDS.record}
          color="#3fb8b3"
          ink="#04211f"
          onPress={() => {
            if (runCommand("program.record-ptp")) sound("done");
          }}
        />
        <Key id="delete-last" words={WORDS.deletePoint} onPress={deleteLast} />
      </Row>
      <Row>
        <PlayKey />
        <Key
          id="stop"
          words={WORDS.stop}
          color="#ff6157"
          ink="#2a0705"
          atOnce
          onPress={() => {
            if (!runCommand("stop")) stopEverything();
          }}
        />
      </Row>
      <Row>
        <Key
          id="camera"
          words={WORDS.camera}
          onPress={() => {
            toggleRoom("cameras");
          }}
        />
        <Key
          id="history"
          words={WORDS.history}
          onPress={() => {
            toggleRoom("history");
          }}
        />
      </Row>
      <Key id="leave" words={WORDS.leave} onPress={leaveHeadset} />
    </Container>
  );
}

function handOf(state: unknown): unknown {
  if (typeof state !== "object" || state === null || !("inputSource" in state)) return undefined;
  const { inputSource } = state;
  return typeof inputSource === "object" && inputSource !== null && "handedness" in inputSource
    ? inputSource.handedness
    : undefined;
}

function deleteLast(): void {
  const { document } = cellStore.getState();
  const last = programOf(document)?.steps.at(-1);
  if (last) deleteSteps([last.id]);
}

function PlayKey() {
  const playing = useStore(playStore, state => state.playing);
  return (
    <Key
      id="play"
      words={playing ? WORDS.pause : WORDS.play}
      onPress={() => {
        runCommand("play.toggle");
      }}
    />
  );
}

/** How many points there are, or what is wrong now. */
function State() {
  const points = useStore(
    cellStore,
    ({ document }) => programOf(document)?.steps.filter(step => step.type === "move").length ?? 0,
  );
  const blocked = useStore(jogStore, state => state.blocked !== null);
  const touching = useStore(watchStore, state => state.contacts.length > 0);
  const words = blocked ? WORDS.blocked : touching ? WORDS.inContact : WORDS.points(points);
  return (
    <Text id="state" fontSize={WORDS_PX} color={blocked || touching ? "#ff8a82" : "#b9c4ca"}>
      {words}
    </Text>
  );
}

/**
 * The last thing that went wrong: in the room nobody sees the notices of the page, nor the cards of other controllers.
 */
function Said() {
  const notice = useStore(
    noticeStore,
    ({ notices }) => notices.findLast(({ tone }) => tone === "bad" || tone === "warn")?.sentence ?? "",
  );
  const other = useStore(stationStore, ({ stations }) => {
    const said = stations.find(station => station.notice !== "");
    return said ? `${said.name}: ${say(said.notice)}` : "";
  });
  return notice || other ? (
    <Text id="said" fontSize={WORDS_PX} color="#ffcf70">
      {notice || other}
    </Text>
  ) : null;
}

/** Place of the tool tip, read three times a second. */
function ReadOut() {
  const [text, setText] = useState<readonly [string, string]>(["", ""]);
  const since = useRef(READ_EVERY_S);
  const seen = useRef(-1);
  useFrame((_, dt_s) => {
    since.current += dt_s;
    const {
      worldFromTcp: { position, quaternion },
      revision,
    } = theLive();
    if (since.current < READ_EVERY_S || revision === seen.current) return;
    since.current = 0;
    seen.current = revision;
    const tilt = Math.acos(Math.max(-1, Math.min(1, 2 * (quaternion[0] ** 2 + quaternion[1] ** 2) - 1)));
    const [x, y, z] = position.map(metres => fixed(millimetres(metres), 1).replace(/^-(0.0)$/, "$1"));
    setText([`X ${x}  Y ${y}`, `Z ${z} mm, ${WORDS.tilt} ${fixed(degrees(tilt), 1)}°`]);
  });
  return (
    <Container flexDirection="column">
      {text.map((line, i) => (
        <Text key={i} fontSize={WORDS_PX} color="#f2f6f8">
          {line}
        </Text>
      ))}
    </Container>
  );
}
