import { useFrame } from "@react-three/fiber";
import { Container, Text } from "@react-three/uikit";
import { copyPose, identity, millimetres } from "@twincell/core";
import { useRef, useState } from "react";
import { goThere } from "../../runtime/jog/go-to-point.ts";
import { hold, release } from "../../runtime/jog/pressed-inputs.ts";
import { solveTcp } from "../../runtime/jog/solve.ts";
import { theLive } from "../../runtime/live.ts";
import { cellStore } from "../../stores/cell.ts";
import { robotOf } from "../../stores/document.ts";
import { headsetStore } from "../../stores/headset.ts";
import { chooseFrame } from "../../stores/jog.ts";
import { notify } from "../../stores/notices.ts";
import { playStore } from "../../stores/play.ts";
import { toggleRoom } from "../../stores/room.ts";
import { words } from "../../messages/index.ts";
import { whole } from "../../messages/numbers.ts";
import type { KeyAim } from "./grabber.ts";
import { HoldKey, Key, Row } from "./keys.tsx";
import { entered, KEYPAD, typed, type KeypadKey } from "./number-entry.ts";
import { RoomPanel, Words } from "./room-panel.tsx";

const SAID = words.headset;
const FIELDS = ["x", "y", "z", "speed"] as const;
type Field = (typeof FIELDS)[number];
const AXIS = { x: 0, y: 1, z: 2 } as const;
/** To the left of the person, below the eyes. */
export const KEYPAD_AT = [-0.72, 1.42, -0.72] as const;
const TURN_RAD = 0.78;
const WIDTH_PX = 470;
/** The typeface of the room has the letters of ASCII and the German ones, and no other signs. */
const KEY_WORDS: Readonly<Partial<Record<KeypadKey, string>>> & { readonly "⌫": string } = { "±": "+/-", "⌫": "<" };
/** No cell is larger [mm]; the speed of playing in percent. */
const RANGES: Readonly<Record<Field, readonly [number, number]>> = {
  x: [-20_000, 20_000],
  y: [-20_000, 20_000],
  z: [-20_000, 20_000],
  speed: [1, 100],
};

/**
 * A pendant in the room: a coordinate of the tool is jogged while a key is held, or typed, without a keyboard and
 * without speech; so is the speed of playing.
 */
export function KeypadPanel({ keys }: { readonly keys: KeyAim }) {
  const [field, setField] = useState<Field>("z");
  const [text, setText] = useState("");
  const press = (key: KeypadKey) => () => {
    setText(before => typed(before, key));
  };
  return (
    <RoomPanel
      id="keypad-panel"
      place={KEYPAD_AT}
      turn_rad={TURN_RAD}
      width={WIDTH_PX}
      keys={keys}
      title={
        <>
          <Words>{SAID.numbers[field]}</Words>
          <Now field={field} />
        </>
      }
    >
      <Row>
        {FIELDS.map(each => (
          <Key
            key={each}
            id={`number-${each}`}
            words={SAID.numbers[each].split(" ")[0]!}
            height={60}
            strong={each === field}
            onPress={() => {
              setField(each);
              setText("");
            }}
          />
        ))}
      </Row>
      {field !== "speed" && (
        <Row>
          <HoldKey id="jog-minus" words={SAID.jog.less(field.toUpperCase())} onHold={jog(field, -1)} onLetGo={letGo} />
          <HoldKey id="jog-plus" words={SAID.jog.more(field.toUpperCase())} onHold={jog(field, 1)} onLetGo={letGo} />
        </Row>
      )}
      <Container height={70} alignItems="center" justifyContent="flex-end" paddingX={16} backgroundColor="#0c0f11">
        <Text id="number-typed" fontSize={44} fontWeight="bold" color="#f2f6f8">
          {text === "" ? "_" : text}
        </Text>
      </Container>
      {[0, 3, 6, 9].map(from => (
        <Row key={from}>
          {KEYPAD.slice(from, from + 3).map(key => (
            <Key key={key} id={`digit-${key}`} words={KEY_WORDS[key] ?? key} height={68} onPress={press(key)} />
          ))}
        </Row>
      ))}
      <Row>
        <Key id="digit-back" words={KEY_WORDS["⌫"]} height={68} onPress={press("⌫")} />
        <Key
          id="number-set"
          words={SAID.set}
          height={68}
          strong
          onPress={() => {
            if (take(field, text)) setText("");
          }}
        />
        <Key
          id="keypad-close"
          words={SAID.close}
          height={68}
          onPress={() => {
            toggleRoom("keypad");
          }}
        />
      </Row>
    </RoomPanel>
  );
}

/** Lead-through: the coordinate goes one way as long as the key is held (row L-27). */
const jog = (field: Exclude<Field, "speed">, amount: 1 | -1) => (): void => {
  if (headsetStore.getState().emergency) {
    notify("bad", SAID.emergencyPressed);
    return;
  }
  chooseFrame("world");
  hold("headset", AXIS[field], amount);
};
const letGo = (): void => {
  release("headset");
};

const READ_EVERY_S = 0.1;
/** What the number is now. */
function Now({ field }: { readonly field: Field }) {
  const since_s = useRef(READ_EVERY_S);
  const [text, setText] = useState("");
  useFrame((_, dt_s) => {
    since_s.current += dt_s;
    if (since_s.current < READ_EVERY_S) return;
    since_s.current = 0;
    const next = nowOf(field);
    if (next !== text) setText(next);
  });
  return <Words color="#b9c4ca">{text}</Words>;
}

const nowOf = (field: Field): string =>
  field === "speed"
    ? SAID.speed(Math.round(playStore.getState().speed * 100))
    : whole(millimetres(theLive().worldFromTcp.position[AXIS[field]]));

/** Does what was typed; says why not where it cannot be done. */
function take(field: Field, text: string): boolean {
  const [least, most] = RANGES[field];
  const number = entered(text, least, most);
  if (number.kind === "nothing") {
    notify("info", SAID.numberNone);
    return false;
  }
  if (number.kind === "outside") {
    notify("bad", SAID.numberOutside(whole(number.least), whole(number.most)));
    return false;
  }
  if (field === "speed") {
    playStore.setState({ speed: number.value / 100 });
    return true;
  }
  if (headsetStore.getState().emergency) {
    notify("bad", SAID.emergencyPressed);
    return false;
  }
  const robot = robotOf(cellStore.getState().document);
  if (!robot) return false;
  const wanted = copyPose(theLive().worldFromTcp, identity<"world", "tcp">());
  wanted.position[AXIS[field]] = number.value / 1000;
  const solved = solveTcp(wanted, theLive().q_rad);
  if (solved.kind === "not") {
    notify("bad", solved.sentence);
    return false;
  }
  goThere(robot, solved.q_rad);
  return true;
}
