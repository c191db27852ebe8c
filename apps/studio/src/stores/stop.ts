/**
 * STOP: everybody who can move something registers how it is brought to rest.
 * A stopper that throws does not keep the others from being called.
 */
const stoppers = new Set<() => void>();
const listeners = new Set<() => void>();

export function onStop(bringToRest: () => void): () => void {
  stoppers.add(bringToRest);
  return () => stoppers.delete(bringToRest);
}
/** Told after everything was asked to stop. */
export function afterStop(listen: () => void): () => void {
  listeners.add(listen);
  return () => listeners.delete(listen);
}

/** Returns the sentences of stoppers that could not do it. */
export function stopEverything(): readonly string[] {
  const problems: string[] = [];
  for (const bringToRest of stoppers) {
    try {
      bringToRest();
    } catch (problem) {
      problems.push(problem instanceof Error ? problem.message : String(problem));
    }
  }
  for (const listen of listeners) listen();
  return problems;
}
