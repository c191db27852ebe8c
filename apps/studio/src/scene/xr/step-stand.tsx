import { everyStep, type Step, type StepVerdict } from "@twincell/core";
import { Container, Text } from "@react-three/uikit";
import { useMemo, useState } from "react";
import { CylinderGeometry, MeshStandardMaterial } from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { useStore } from "zustand";
import { whyCards } from "../../runtime/planning/why-cards.ts";
import { cellStore } from "../../stores/cell.ts";
import { controlStore } from "../../stores/control.ts";
import { programOf } from "../../stores/document.ts";
import { headsetStore } from "../../stores/headset.ts";
import { playStore, verdictOf } from "../../stores/play.ts";
import { stepWords } from "../../stores/program.ts";
import { repairStore } from "../../stores/repairs.ts";
import { select, selectionStore } from "../../stores/selection.ts";
import { say, words } from "../../messages/index.ts";
import type { KeyAim } from "./grabber.ts";
import { Key, Row, WORDS_PX } from "./keys.tsx";
import { RoomPanel, Words } from "./room-panel.tsx";

const SAID = words.headset;
/** 560 × 720 mm with capitals of 23 mm. */
const WIDTH_PX = 560;
const ROWS = 7;
const ROW_PX = 66;
const QUIET = "#b9c4ca";
const DOTS: Readonly<Record<StepVerdict, string>> = {
  ok: "#6aa5ff",
  warn: "#ffcf70",
  bad: "#ff6157",
  unknown: "#8b969c",
};
/** Beside the robot, turned to the person, its upper edge at the height of the eyes [m]. */
export const STANDS_AT = [0.95, 1.5, -0.97] as const;
const TURNED_RAD = -0.76;
const POST_M = 1.5;

/** The steps of the program on a stand in the room; in Check what cannot be, and what would help. */
export function StepStand({ keys }: { readonly keys: KeyAim }) {
  const checks = useStore(headsetStore, state => state.tab === "check");
  return (
    <>
      <RoomPanel
        id="step-stand"
        place={STANDS_AT}
        turn_rad={TURNED_RAD}
        width={WIDTH_PX}
        keys={keys}
        upright
        title={<Title />}
        above={<Post />}
      >
        {checks ? <Findings /> : <Steps />}
      </RoomPanel>
    </>
  );
}

function Post() {
  const [geometry, material] = useMemo(() => {
    const post = new CylinderGeometry(0.02, 0.02, POST_M, 16).translate(0, -POST_M / 2, -0.06);
    const foot = new CylinderGeometry(0.19, 0.21, 0.03, 40).translate(0, -POST_M, -0.06);
    return [
      mergeGeometries([post, foot]),
      new MeshStandardMaterial({ color: "#7d868b", roughness: 0.5, metalness: 0.3 }),
    ] as const;
  }, []);
  return <mesh geometry={geometry} material={material} />;
}

function Title() {
  const program = useStore(cellStore, state => programOf(state.document));
  const duration_s = useStore(playStore, state => state.plan?.duration_s ?? null);
  return (
    <>
      <Words>{SAID.steps}</Words>
      <Words color={QUIET}>
        {duration_s === null
          ? String(program?.steps.length ?? 0)
          : SAID.stepsCount(program?.steps.length ?? 0, duration_s)}
      </Words>
    </>
  );
}

function Steps() {
  const program = useStore(cellStore, state => programOf(state.document));
  const steps = useMemo(() => (program ? [...everyStep(program)] : []), [program]);
  const selected = useStore(selectionStore, state => (state.selected?.kind === "step" ? state.selected.id : null));
  const running = useStore(controlStore, state => (state.running ? state.step : ""));
  const verdict = useStore(playStore, state => state.verdict);
  const [scrolled, setScrolled] = useState<{ readonly of: string | null; readonly from: number }>({
    of: null,
    from: 0,
  });
  const current = running || selected;
  const at = steps.findIndex(step => step.id === current);
  const most = Math.max(0, steps.length - ROWS);
  // What is selected is in sight until somebody scrolls away from it.
  const from = Math.min(most, scrolled.of === current ? scrolled.from : Math.max(0, at - ROWS + 2));
  if (!program || steps.length === 0) return <Words color={QUIET}>{SAID.noSteps}</Words>;
  const scroll = (by: number) => () => {
    setScrolled({ of: current, from: Math.min(most, Math.max(0, from + by)) });
  };
  return (
    <>
      {steps.slice(from, from + ROWS).map((step, i) => (
        <StepRow
          key={step.id}
          id={`step-${from + i}`}
          says={stepWords(step, from + i)}
          kind={kindOf(step)}
          color={DOTS[verdictOf(verdict, step.id)]}
          chosen={step.id === current}
          onPress={() => {
            select({ kind: "step", id: step.id });
          }}
        />
      ))}
      {most > 0 && (
        <Row>
          <Key id="steps-up" words={SAID.up} height={64} onPress={scroll(-ROWS + 1)} />
          <Key id="steps-down" words={SAID.down} height={64} onPress={scroll(ROWS - 1)} />
        </Row>
      )}
    </>
  );
}
const kindOf = (step: Step): string => (step.type === "move" ? step.path.toUpperCase() : "");

function StepRow({
  id,
  says,
  kind,
  color,
  chosen,
  onPress,
}: {
  readonly id: string;
  readonly says: string;
  readonly kind: string;
  readonly color: string;
  readonly chosen: boolean;
  readonly onPress: () => void;
}) {
  return (
    <Container
      id={id}
      flexDirection="row"
      alignItems="center"
      gap={16}
      height={ROW_PX}
      paddingX={16}
      borderRadius={12}
      borderWidth={3}
      backgroundColor={chosen ? "#12413f" : "#161a1d"}
      borderColor={chosen ? "#3fb8b3" : "#161a1d"}
      hover={{ borderColor: "#f2f6f8" }}
      onClick={onPress}
    >
      <Container width={18} height={18} borderRadius={5} flexShrink={0} backgroundColor={color} />
      <Container flexGrow={1} flexBasis={0} overflow="hidden">
        <Text fontSize={WORDS_PX} color="#f2f6f8" fontWeight={chosen ? "bold" : "normal"}>
          {says.length > 17 ? `${says.slice(0, 15)}..` : says}
        </Text>
      </Container>
      <Text fontSize={WORDS_PX} color={QUIET}>
        {kind}
      </Text>
    </Container>
  );
}

/** The problem that is looked at: what, the number, why, and the repairs that keys 1 to 3 of the plate apply. */
function Findings() {
  const program = useStore(cellStore, state => programOf(state.document));
  const { verdict, checking, stale, trouble } = useStore(playStore);
  const selected = useStore(selectionStore, state => (state.selected?.kind === "step" ? state.selected.id : null));
  const { current, explanations, searching } = useStore(repairStore);
  if (trouble) return <Words color="#ff8a82">{say(trouble)}</Words>;
  if (checking !== null) return <Words color={QUIET}>{SAID.checking(Math.round(checking * 100))}</Words>;
  if (!verdict || !program || stale) return <Words color={QUIET}>{SAID.notChecked}</Words>;
  const cards = whyCards(verdict, program);
  if (cards.length === 0) return <Words color="#6aa5ff">{verdict.ok ? SAID.fine : SAID.notChecked}</Words>;
  const index = Math.max(
    0,
    cards.findIndex(card => selected !== null && card.steps.includes(selected)),
  );
  const card = cards[index]!;
  const explanation = current === null ? undefined : explanations.get(current);
  return (
    <>
      <Words color={card.verdict === "bad" ? "#ff8a82" : "#ffcf70"}>{SAID.problem(index + 1, cards.length)}</Words>
      <Words>{say(card.finding.sentence)}</Words>
      {searching !== null && <Words color={QUIET}>{SAID.searching}</Words>}
      {explanation?.repairs.length === 0 && <Words color={QUIET}>{SAID.noRepair}</Words>}
      {explanation?.repairs.slice(0, 3).map((repair, i) => (
        <Words key={repair.sentence} color="#8fe0dc">
          {SAID.offer(i + 1, say(repair.sentence))}
        </Words>
      ))}
    </>
  );
}
