import { CircleCheck, Info, OctagonAlert, TriangleAlert, X } from "lucide-react";
import { useEffect } from "react";
import { useStore } from "zustand";
import { dismiss, noticeStore, type Notice } from "../../stores/notices.ts";
import { words } from "../../words/index.ts";
import "./notices.css";

const GLYPH = { info: <Info />, warn: <TriangleAlert />, bad: <OctagonAlert />, done: <CircleCheck /> } as const;
/** What needs no hand goes by itself; a problem stays until it was seen. */
const STAYS_MS = { info: 5000, done: 5000, warn: 9000, bad: null } as const;

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
  useEffect(() => {
    const stays = STAYS_MS[tone];
    if (stays === null) return undefined;
    const timer = setTimeout(() => dismiss(id), stays);
    return () => clearTimeout(timer);
  }, [id, tone]);
  return (
    <div className="notice" data-tone={tone} role={tone === "bad" ? "alert" : "status"}>
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
