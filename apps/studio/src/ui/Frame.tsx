import { X } from "lucide-react";
import { Dialog } from "radix-ui";
import type { ReactNode } from "react";
import { words } from "../messages/index.ts";

/**
 * A dialog that leaves the top bar alone: not modal in the DOM's sense, so STOP and the controller chip stay
 * reachable by pointer, key and screen reader while it is open. `reading`: nothing in it takes the focus, so the body
 * itself does, to be scrolled by keys.
 */
export function Frame({
  open,
  title,
  onClose,
  children,
  foot,
  width,
  reading = false,
}: {
  open: boolean;
  title: string;
  onClose: () => void;
  children: ReactNode;
  foot?: ReactNode;
  width?: number;
  reading?: boolean;
}) {
  return (
    <Dialog.Root
      open={open}
      onOpenChange={next => {
        if (!next) onClose();
      }}
      modal={false}
    >
      <Dialog.Portal>
        <div className="veil" onPointerDown={onClose} />
        <Dialog.Content
          className="dialog"
          aria-describedby={undefined}
          style={width ? { width: `min(${width}px, calc(100vw - 24px))` } : undefined}
          onInteractOutside={event => event.preventDefault()}
        >
          <div className="dialog-head">
            <Dialog.Title asChild>
              <h2>{title}</h2>
            </Dialog.Title>
            <Dialog.Close asChild>
              <button className="btn quiet icon" aria-label={words.common.close}>
                <X />
              </button>
            </Dialog.Close>
          </div>
          <div className="dialog-body" {...(reading ? { tabIndex: 0, role: "region", "aria-label": title } : {})}>
            {children}
          </div>
          {foot && <div className="dialog-foot">{foot}</div>}
        </Dialog.Content>
      </Dialog.Portal>
    </Dialog.Root>
  );
}
