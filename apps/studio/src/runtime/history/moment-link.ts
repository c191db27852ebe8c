/** A moment as it stands in an address: which recording, and when. */
export interface MomentLink {
  readonly recording: string;
  readonly t_s: number;
}

/** `#moment=RECORDING&t=SECONDS`: behind the #, so that it never leaves the browser. */
export const momentHash = ({ recording, t_s }: MomentLink): string =>
  `#moment=${encodeURIComponent(recording)}&t=${Number(t_s.toFixed(3))}`;

/** What such an address says; null when it says nothing of the kind. */
export function momentFrom(hash: string): MomentLink | null {
  const said = new URLSearchParams(hash.replace(/^#/, ""));
  const recording = said.get("moment");
  const t_s = Number(said.get("t") ?? "0");
  return recording !== null && recording !== "" && Number.isFinite(t_s) && t_s >= 0 ? { recording, t_s } : null;
}
