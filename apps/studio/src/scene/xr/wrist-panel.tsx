import { Container, Text } from "@react-three/uikit";
import { useEffect } from "react";
import { useStore } from "zustand";
import { cellStore } from "../../stores/cell.ts";
import { connectionStore } from "../../stores/connection.ts";
import { robotOf } from "../../stores/document.ts";
import { headsetStore, openTab, type HeadsetTab } from "../../stores/headset.ts";
import { jogStore } from "../../stores/jog.ts";
import { noticeStore } from "../../stores/notices.ts";
import { playStore } from "../../stores/play.ts";
import { stationStore } from "../../stores/stations.ts";
import { showMode } from "../../stores/view.ts";
import { watchStore } from "../../stores/watch.ts";
import { say, words } from "../../messages/index.ts";
import { WORDS } from "../words.ts";
import { aimAt, type KeyAim } from "./grabber.ts";
import { Key } from "./keys.tsx";
import { PAGES } from "./plate-keys.tsx";
import { beginProgramming } from "./programming.ts";

/** 276 × 200 mm. */
export const PLATE_METRES_PER_PIXEL = 0.0005;
/** From the eyes to the hand that wears it [m]. */
export const PLATE_READ_FROM_M = 0.55;
const WIDTH_PX = 552;
export const SMALL_PX = 24;
const TABS: readonly HeadsetTab[] = ["teach", "check", "run", "cell", "history"];
const SAID = words.headset;

/** The menu that rides on a wrist. `wearer`: the hand it rides on, whose own ray passes through it. */
export function WristPanel({
  keys,
  wearer,
  shown,
}: {
  readonly keys: KeyAim;
  readonly wearer: XRHandedness;
  readonly shown: boolean;
}) {
  useEffect(
    () => () => {
      aimAt(keys, "wrist", false);
    },
    [keys],
  );
  useEffect(() => {
    if (!shown) aimAt(keys, "wrist", false);
  }, [keys, shown]);
  return (
    <Container
      id="wrist-panel"
      anchorY="bottom"
      flexDirection="column"
      gap={12}
      padding={14}
      width={WIDTH_PX}
      pixelSize={PLATE_METRES_PER_PIXEL}
      backgroundColor="#161a1d"
      borderRadius={22}
      borderWidth={2}
      borderColor="#3a444a"
      pointerEvents={shown ? "auto" : "none"}
      pointerEventsType={(_id: number, _type: string, state: unknown) => handOf(state) !== wearer}
      onHoverChange={(aimed: boolean) => {
        aimAt(keys, "wrist", aimed && shown);
      }}
    >
      <Said />
      <Tabs />
      <Page />
      <Foot />
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

function Tabs() {
  const tab = useStore(headsetStore, state => state.tab);
  return (
    <Container flexDirection="row" gap={6}>
      {TABS.map(each => (
        <Key
          key={each}
          id={`tab-${each}`}
          words={SAID.tabs[each]}
          strong={each === tab}
          color={each === tab ? "#3fb8b3" : "#161a1d"}
          height={64}
          size={SMALL_PX}
          onPress={() => {
            openTab(each);
            // Looking back is begun by its own panel; the others are the modes of the page.
            if (each !== "history") showMode(each);
            if (each === "teach") beginProgramming();
          }}
        />
      ))}
    </Container>
  );
}

function Page() {
  const { tab, page } = useStore(headsetStore);
  const pages = PAGES[tab];
  const Shown = pages[page % pages.length]!;
  return <Shown />;
}

/** Controller and speed, and the way to what else the tab holds. */
function Foot() {
  const { tab, page } = useStore(headsetStore);
  const speed = useStore(playStore, state => state.speed);
  const { station, view } = useStore(connectionStore);
  const connected = useStore(stationStore, state => state.stations.find(each => each.id === station));
  const robot = useStore(cellStore, state => robotOf(state.document)?.name ?? "");
  const open = connected?.link.state === "open";
  const pages = PAGES[tab].length;
  return (
    <Container flexDirection="row" alignItems="center" justifyContent="space-between" height={52} paddingX={4}>
      <Container flexDirection="row" alignItems="center" gap={10}>
        <Container
          width={16}
          height={16}
          borderRadius={8}
          backgroundColor={station === null ? "#8b969c" : open ? "#57d783" : "#ffcf70"}
        />
        <Text id="controller" fontSize={SMALL_PX} color="#dfe6e9">
          {station === null ? SAID.simulated(robot) : SAID.connected(connected?.name ?? robot, SAID.state[view])}
        </Text>
      </Container>
      <Text id="speed" fontSize={SMALL_PX} fontWeight="bold" color="#f2f6f8">
        {SAID.speed(Math.round(speed * 100))}
      </Text>
      {pages > 1 && (
        <Key
          id="more"
          words={SAID.more((page % pages) + 1, pages)}
          height={52}
          size={SMALL_PX}
          narrow={140}
          onPress={() => {
            headsetStore.setState({ page: (page + 1) % pages });
          }}
        />
      )}
    </Container>
  );
}

/**
 * The last thing that was said, and what is wrong now: in the room nobody sees the notices of the page, nor the cards
 * of other controllers.
 */
function Said() {
  const emergency = useStore(headsetStore, state => state.emergency);
  const blocked = useStore(jogStore, state => state.blocked !== null);
  const touching = useStore(watchStore, state => state.contacts.length > 0);
  const notice = useStore(noticeStore, ({ notices }) => notices.at(-1));
  const other = useStore(stationStore, ({ stations }) => {
    const said = stations.find(station => station.notice !== "");
    return said ? `${said.name}: ${say(said.notice)}` : "";
  });
  const bad = emergency || blocked || touching || notice?.tone === "bad";
  const sentence = emergency
    ? SAID.emergencyPressed
    : notice?.tone === "bad" || notice?.tone === "warn"
      ? notice.sentence
      : blocked
        ? WORDS.blocked
        : touching
          ? WORDS.inContact
          : other || notice?.sentence || "";
  return sentence === "" ? null : (
    <Text id="said" fontSize={SMALL_PX} color={bad ? "#ff8a82" : "#ffcf70"} paddingX={4}>
      {sentence}
    </Text>
  );
}
