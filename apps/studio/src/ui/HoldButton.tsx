import { useEffect, useRef, type ReactNode } from "react";

/**
 * Acts while held: by pointer, Space or Enter. Letting go, a cancelled touch, losing focus and leaving the page all end
 * it (the last two also through `releaseAll` of live/held.ts).
 */
export function HoldButton({
  label,
  className = "btn icon",
  onHold,
  onRelease,
  children,
}: {
  label: string;
  className?: string;
  onHold: () => void;
  onRelease: () => void;
  children: ReactNode;
}) {
  const held = useRef(false);
  const release = useRef(onRelease);
  useEffect(() => {
    release.current = onRelease;
  });
  useEffect(
    () => () => {
      if (held.current) release.current();
    },
    [],
  );

  const down = (): void => {
    if (!held.current) {
      held.current = true;
      onHold();
    }
  };
  const up = (): void => {
    if (held.current) {
      held.current = false;
      onRelease();
    }
  };
  return (
    <button
      type="button"
      className={className}
      aria-label={label}
      style={{ touchAction: "none" }}
      onPointerDown={event => {
        if (event.button === 0) {
          event.currentTarget.setPointerCapture(event.pointerId);
          down();
        }
      }}
      onPointerUp={up}
      onPointerCancel={up}
      onLostPointerCapture={up}
      onBlur={up}
      onContextMenu={event => event.preventDefault()}
      onKeyDown={event => {
        if (event.key === " " || event.key === "Enter") {
          event.preventDefault();
          if (!event.repeat) down();
        }
      }}
      onKeyUp={event => {
        if (event.key === " " || event.key === "Enter") {
          event.preventDefault();
          up();
        }
      }}
    >
      {children}
    </button>
  );
}
