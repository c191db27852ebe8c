const STEP_PX = 16;
const GAP_PX = 12;
const TOP_PX = 54;
let front = 6;

/**
 * Lets a panel be moved within its parent by its grip: dragged, or by arrow keys. Where it goes is written to its
 * style.
 */
export function movable(panel: HTMLElement, grip: HTMLElement, place: number): () => void {
  const parent = panel.offsetParent ?? document.body;
  const beside = GAP_PX + place * (panel.offsetWidth + GAP_PX);
  const fits = beside + panel.offsetWidth <= parent.clientWidth;
  let x = fits ? beside : GAP_PX + place * 28;
  let y = TOP_PX + (fits ? 0 : place * 34);
  let from: { readonly dx: number; readonly dy: number } | null = null;
  const put = (toX: number, toY: number): void => {
    x = Math.max(0, Math.min(parent.clientWidth - panel.offsetWidth, toX));
    y = Math.max(0, Math.min(parent.clientHeight - panel.offsetHeight, toY));
    panel.style.left = `${x}px`;
    panel.style.top = `${y}px`;
  };
  const raise = (): void => {
    panel.style.zIndex = String(++front);
  };
  const down = (event: PointerEvent): void => {
    grip.setPointerCapture(event.pointerId);
    from = { dx: event.clientX - x, dy: event.clientY - y };
  };
  const move = (event: PointerEvent): void => {
    if (from) put(event.clientX - from.dx, event.clientY - from.dy);
  };
  const up = (): void => {
    from = null;
  };
  const key = (event: KeyboardEvent): void => {
    const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (!way) return;
    event.preventDefault();
    event.stopPropagation();
    put(x + STEP_PX * way[0]!, y + STEP_PX * way[1]!);
  };
  const watch = new ResizeObserver(() => {
    put(x, y);
  });
  watch.observe(parent);
  watch.observe(panel);
  panel.addEventListener("pointerdown", raise);
  grip.addEventListener("pointerdown", down);
  grip.addEventListener("pointermove", move);
  grip.addEventListener("pointerup", up);
  grip.addEventListener("pointercancel", up);
  grip.addEventListener("keydown", key);
  return () => {
    watch.disconnect();
    panel.removeEventListener("pointerdown", raise);
    grip.removeEventListener("pointerdown", down);
    grip.removeEventListener("pointermove", move);
    grip.removeEventListener("pointerup", up);
    grip.removeEventListener("pointercancel", up);
    grip.removeEventListener("keydown", key);
  };
}
