import { degrees, millimetres } from "@twincell/core";
import { useFrame } from "@react-three/fiber";
import { Container, Text } from "@react-three/uikit";
import { useRef, useState } from "react";
import { useStore } from "zustand";
import { theLive } from "../../live/live.ts";
import { cellStore } from "../../stores/cell.ts";
import { runCommand } from "../../stores/commands.ts";
import { leaveHeadset } from "../../stores/headset.ts";
import { jogStore } from "../../stores/jog.ts";
import { playStore } from "../../stores/play.ts";
import { deleteSteps } from "../../stores/program.ts";
import { sound } from "../../stores/sound.ts";
import { stopEverything } from "../../stores/stop.ts";
import { WORDS } from "../words.ts";

const READ_EVERY_S = 0.2;

/** The menu on the left wrist. Half a millimetre per pixel: letters of 26 px stand 13 mm high at arm's length. */
export function WristPanel() {
  const program = useStore(cellStore, ({ document }) => document?.programs.find(each => each.name === document.program));
  const playing = useStore(playStore, state => state.playing), blocked = useStore(jogStore, state => state.blocked);
  const points = program?.steps.filter(step => step.type === "move").length ?? 0;
  const deleteLast = (): void => { const last = program?.steps.at(-1); if (last) deleteSteps([last.id]); };
  return (
    <Container flexDirection="column" gap={12} padding={18} width={440} pixelSize={0.0005} backgroundColor="#161a1d" borderRadius={22} borderWidth={2} borderColor="#2b3338">
      <ReadOut />
      <Text fontSize={26} color={blocked ? "#ff8a82" : "#a3afb6"}>{blocked ? blocked.sentence : WORDS.points(points)}</Text>
      <Row>
        <Key words={WORDS.record} color="#3fb8b3" ink="#04211f" onPress={() => { if (runCommand("program.record-ptp")) sound("done"); }} />
        <Key words={WORDS.deletePoint} onPress={deleteLast} />
      </Row>
      <Row>
        <Key words={playing ? WORDS.pause : WORDS.play} onPress={() => { runCommand("play.toggle"); }} />
        <Key words={WORDS.stop} color="#ff6157" ink="#2a0705" onPress={() => { if (!runCommand("stop")) stopEverything(); }} />
      </Row>
      <Key words={WORDS.leave} onPress={leaveHeadset} />
    </Container>
  );
}

function Row({ children }: { readonly children: React.ReactNode }) {
  return <Container flexDirection="row" gap={12}>{children}</Container>;
}

function Key({ words, onPress, color = "#262d32", ink = "#e8edf0" }: { readonly words: string; readonly onPress: () => void; readonly color?: string; readonly ink?: string }) {
  return (
    <Container flexGrow={1} flexBasis={0} height={78} borderRadius={14} alignItems="center" justifyContent="center" backgroundColor={color} hover={{ borderWidth: 4, borderColor: "#e8edf0" }} active={{ transformTranslateZ: -6 }} onClick={onPress}>
      <Text fontSize={28} fontWeight="medium" color={ink}>{words}</Text>
    </Container>
  );
}

/** Place of the tool tip, read five times a second. */
function ReadOut() {
  const [text, setText] = useState(""), since = useRef(READ_EVERY_S);
  useFrame((_, dt_s) => {
    since.current += dt_s;
    if (since.current < READ_EVERY_S) return;
    since.current = 0;
    const { position, quaternion } = theLive().worldFromTcp, tilt = Math.acos(Math.max(-1, Math.min(1, 2 * (quaternion[0] ** 2 + quaternion[1] ** 2) - 1)));
    setText(`X ${millimetres(position[0]).toFixed(1)}  Y ${millimetres(position[1]).toFixed(1)}  Z ${millimetres(position[2]).toFixed(1)} mm, ${WORDS.tilt} ${degrees(tilt).toFixed(1)}°`);
  });
  return <Text fontSize={25} color="#e8edf0">{text}</Text>;
}
