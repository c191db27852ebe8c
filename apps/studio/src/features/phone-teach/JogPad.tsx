import { ChevronDown, ChevronLeft, ChevronRight, ChevronUp } from "lucide-react";
import { useRef, type PointerEvent } from "react";
import { hold, release } from "../../runtime/jog/pressed-inputs.ts";
import { connectionStore } from "../../stores/connection.ts";
import { jogStore } from "../../stores/jog.ts";
import { notify } from "../../stores/notices.ts";
import { words } from "../../messages/index.ts";
import { deflection } from "./deflection.ts";

/** Follows one finger over an element, −1 … 1 to the right and up; any way of its end lets go. */
function useFinger(onMove: (x: number, y: number) => void, onEnd: () => void) {
  const finger = useRef<number | null>(null);
  const move = (event: PointerEvent<HTMLElement>): void => {
    const box = event.currentTarget.getBoundingClientRect();
    onMove(
      (event.clientX - box.left - box.width / 2) / (box.width / 2),
      (box.top + box.height / 2 - event.clientY) / (box.height / 2),
    );
  };
  const end = (event: PointerEvent<HTMLElement>): void => {
    if (finger.current !== event.pointerId) return;
    finger.current = null;
    onEnd();
  };
  return {
    onPointerDown(event: PointerEvent<HTMLElement>) {
      if (finger.current !== null || event.button !== 0) return;
      if (!connectionStore.getState().enabled) {
        notify("info", words.phone.holdFirst);
        return;
      }
      finger.current = event.pointerId;
      event.currentTarget.setPointerCapture(event.pointerId);
      jogStore.setState({ manner: "hold" });
      move(event);
    },
    onPointerMove(event: PointerEvent<HTMLElement>) {
      if (finger.current === event.pointerId) move(event);
    },
    onPointerUp: end,
    onPointerCancel: end,
    onLostPointerCapture: end,
    onContextMenu: (event: React.MouseEvent) => event.preventDefault(),
  };
}

/** A round pad: up is the first coordinate, left the second; how far from the middle is how fast. */
export function JogPad({ first }: { readonly first: 0 | 3 | number }) {
  const knob = useRef<HTMLElement>(null);
  const show = (x: number, y: number): void => {
    if (knob.current) knob.current.style.transform = `translate(${(x * 56).toFixed(1)}px, ${(-y * 56).toFixed(1)}px)`;
  };
  const finger = useFinger(
    (x, y) => {
      const [right, up] = deflection(x, y);
      // The switch may have been let go meanwhile.
      const enabled = connectionStore.getState().enabled;
      hold("phone", first, enabled ? up : 0);
      hold("phone", first + 1, enabled ? -right : 0);
      show(right, up);
    },
    () => {
      release("phone", first);
      release("phone", first + 1);
      show(0, 0);
    },
  );
  const [a, b] = [words.jog.axes[first]!, words.jog.axes[first + 1]!];
  return (
    <div className="phone-pad" role="group" aria-label={words.phone.padOf(a, b)} {...finger}>
      <span className="up" data-axis={first % 3}>
        <ChevronUp />
        {a}+
      </span>
      <span className="left" data-axis={(first + 1) % 3}>
        <ChevronLeft />
        {b}+
      </span>
      <span className="right" data-axis={(first + 1) % 3}>
        {b}−
        <ChevronRight />
      </span>
      <span className="down" data-axis={first % 3}>
        {a}−
        <ChevronDown />
      </span>
      <i ref={knob} aria-hidden />
    </div>
  );
}

/** Up and down for one coordinate. */
export function Rocker({ axis }: { readonly axis: number }) {
  const finger = useFinger(
    (_x, y) => hold("phone", axis, connectionStore.getState().enabled ? deflection(0, y)[1] : 0),
    () => release("phone", axis),
  );
  const name = words.jog.axes[axis]!;
  return (
    <div className="phone-rocker" role="group" aria-label={words.phone.rockerOf(name)} {...finger}>
      <ChevronUp />
      <span>{name}+</span>
      <span>{name}−</span>
      <ChevronDown />
    </div>
  );
}
