import { COLLISION_BEHAVIOURS, type CollisionBehaviour } from "@twincell/core";
import { collideStore } from "./collide.ts";
import { bindingStore, type Bindings } from "./bindings.ts";
import { headsetStore, keptChanged, keptHeadset, readKeptHeadset } from "./headset.ts";
import { languageStore } from "./languages.ts";
import { readServiceTravel, serviceStore, type ServiceState } from "./service.ts";
import { viewStore, type ViewState } from "./view.ts";

/** Choices of the person, not of the cell: kept beside the document, never in it. */
interface Preferences {
  readonly theme?: ViewState["theme"];
  readonly muted?: boolean;
  readonly coachDone?: boolean;
  readonly plots?: boolean;
  readonly bindings?: Bindings;
  readonly languages?: Readonly<Record<string, string>>;
  readonly collision?: CollisionBehaviour;
  readonly service?: ServiceState["travel"];
  readonly headset?: unknown;
}
export interface TextStore {
  getItem(key: string): string | null;
  setItem(key: string, text: string): void;
}
const KEY = "twincell.preferences";

/** Reads them and keeps them up to date. A store that cannot be read or written costs the preferences, nothing else. */
export function keepPreferences(store: TextStore, prefersLight: boolean): () => void {
  const kept = read(store);
  viewStore.setState({
    theme: kept.theme ?? (prefersLight ? "light" : "dark"),
    muted: kept.muted ?? false,
    coachDone: kept.coachDone ?? false,
    plots: kept.plots ?? false,
  });
  if (kept.bindings) bindingStore.setState(kept.bindings);
  if (kept.languages) languageStore.setState({ chosen: kept.languages });
  if (kept.service) serviceStore.setState({ travel: kept.service });
  readKeptHeadset(kept.headset);
  if (kept.collision) collideStore.setState({ behaviour: kept.collision });
  const write = (): void => {
    const { theme, muted, coachDone, plots } = viewStore.getState();
    const { keyboard, buttons, axes } = bindingStore.getState();
    try {
      store.setItem(
        KEY,
        JSON.stringify({
          theme,
          muted,
          coachDone,
          plots,
          bindings: { keyboard, buttons, axes },
          languages: languageStore.getState().chosen,
          collision: collideStore.getState().behaviour,
          service: serviceStore.getState().travel,
          headset: keptHeadset(),
        }),
      );
    } catch {
      return;
    } // a full or forbidden store: the choice holds until the page closes
  };
  const stops = [
    viewStore.subscribe(write),
    bindingStore.subscribe(write),
    languageStore.subscribe(write),
    collideStore.subscribe(write),
    serviceStore.subscribe(write),
    headsetStore.subscribe((now, before) => {
      if (keptChanged(now, before)) write();
    }),
  ];
  return () => {
    for (const stop of stops) stop();
  };
}

function read(store: TextStore): Preferences {
  let raw: unknown;
  try {
    raw = JSON.parse(store.getItem(KEY) ?? "{}");
  } catch {
    return {};
  } // damaged: start with defaults
  if (typeof raw !== "object" || raw === null) return {};
  const has = (key: string): unknown => Reflect.get(raw, key);
  const theme = has("theme");
  const bindings = readBindings(has("bindings"));
  const languages = has("languages");
  const collision = COLLISION_BEHAVIOURS.find(behaviour => behaviour === has("collision"));
  return {
    ...(theme === "dark" || theme === "light" ? { theme } : {}),
    ...(collision ? { collision } : {}),
    ...(bindings ? { bindings } : {}),
    ...(typeof languages === "object" && languages !== null
      ? {
          languages: Object.fromEntries(
            Object.entries(languages).filter((entry): entry is [string, string] => typeof entry[1] === "string"),
          ),
        }
      : {}),
    service: readServiceTravel(has("service")),
    headset: has("headset"),
    muted: has("muted") === true,
    coachDone: has("coachDone") === true,
    plots: has("plots") === true,
  };
}

/** Only what has the right shape is taken; anything else falls back to the table of row N-25 on. */
function readBindings(raw: unknown): Bindings | null {
  if (typeof raw !== "object" || raw === null) return null;
  const table = (value: unknown, good: (entry: unknown) => boolean): value is Readonly<Record<string, string>> =>
    typeof value === "object" && value !== null && Object.values(value).every(good);
  const keyboard: unknown = Reflect.get(raw, "keyboard");
  const buttons: unknown = Reflect.get(raw, "buttons");
  const axes: unknown = Reflect.get(raw, "axes");
  const isText = (entry: unknown): boolean => typeof entry === "string";
  if (!table(keyboard, isText) || !table(buttons, isText) || !table(axes, isText)) return null;
  return bindingStore.getState().accept(keyboard, buttons, axes);
}
