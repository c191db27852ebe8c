/**
 * Script time of what runs beside the picture (the heartbeat, the controller's cycle) since it was last asked for [ms].
 */
let spent_ms = 0;
export function addEffort(ms: number): void {
  spent_ms += ms;
}
export function takeEffort_ms(): number {
  const taken_ms = spent_ms;
  spent_ms = 0;
  return taken_ms;
}
