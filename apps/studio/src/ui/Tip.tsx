import { Tooltip } from "radix-ui";
import type { ReactNode } from "react";
import { showKeys } from "./keys.ts";

/** A word on what a control does, and its key. The child must be one element that takes a ref. */
export function Tip({
  words,
  keys,
  side = "bottom",
  children,
}: {
  words: string;
  keys?: string;
  side?: "top" | "bottom" | "left" | "right";
  children: ReactNode;
}) {
  return (
    <Tooltip.Root>
      <Tooltip.Trigger asChild>{children}</Tooltip.Trigger>
      <Tooltip.Portal>
        <Tooltip.Content className="tip" side={side} sideOffset={6}>
          {words}
          {keys && <span className="kbd">{showKeys(keys)}</span>}
        </Tooltip.Content>
      </Tooltip.Portal>
    </Tooltip.Root>
  );
}
