import { CircleCheck, Info, OctagonAlert, TriangleAlert, X } from "lucide-react";
import { useEffect, useState } from "react";
import { useStore } from "zustand";
import { dismiss, noticeStore, type Notice } from "../../stores/notices.ts";
import { words } from "../../messages/index.ts";
import "./notices.css";

const GLYPH = { info: <Info />, warn: <TriangleAlert />, bad: <OctagonAlert />, done: <CircleCheck /> } as const;
/** Long enough to be read twice; while the pointer or the focus is on it a notice stays. */
const STAYS_MS = { info: 5000, done: 5000, warn: 9000, bad: 20_000 } as const;

export function Notices() {
  const notices = useStore(noticeStore, state => state.notices);
  return (
    <div className="notices" aria-live="polite">
      {notices.map(notice => (
        <Toast key={notice.id} notice={notice} />
      ))}
    </div>
  );
}

function Toast({ notice }: { notice: Notice }) {
  const { id, tone } = notice;
  const [held, setHeld] = useState(false);
  useEffect(() => {
    if (held) return undefined;
    const timer = setTimeout(() => dismiss(id), STAYS_MS[tone]);
    return () => clearTimeout(timer);
  }, [id, tone, held]);
  return (
    <div
      className="notice"
      data-tone={tone}
      role={tone === "bad" ? "alert" : "status"}
      onPointerEnter={() => setHeld(true)}
      onPointerLeave={() => setHeld(false)}
      onFocus={() => setHeld(true)}
      onBlur={() => setHeld(false)}
    >
      <span aria-hidden>{GLYPH[tone]}</span>
      <div className="grow">
        <p>{notice.sentence}</p>
        {notice.hint && <p className="muted">{notice.hint}</p>}
      </div>
      <button className="btn quiet icon tight" aria-label={words.common.close} onClick={() => dismiss(id)}>
        <X />
      </button>
    </div>
  );
}
