import { Color } from "three";

/** The colours of the scene, read from the design tokens, so that both themes come from one file. */
export interface SceneTheme {
  readonly dark: boolean;
  readonly top: Color;
  readonly bottom: Color;
  readonly floor: Color;
  readonly grid: Color;
  readonly accent: Color;
  readonly ok: Color;
  readonly near: Color;
  readonly bad: Color;
  readonly text: Color;
  readonly run: Color;
}

/** Reads the tokens as that theme defines them, whatever the page shows at this moment. */
export function readTheme(theme: "dark" | "light"): SceneTheme {
  const probe = document.createElement("div");
  probe.dataset.theme = theme;
  probe.hidden = true;
  document.body.append(probe);
  const style = getComputedStyle(probe);
  const token = (name: string): Color => new Color(style.getPropertyValue(name).trim() || "#808080");
  const colours: SceneTheme = {
    dark: theme === "dark",
    top: token("--viewport-top"),
    bottom: token("--viewport-bottom"),
    floor: token("--floor"),
    grid: token("--grid"),
    accent: token("--accent"),
    ok: token("--ok"),
    near: token("--near"),
    bad: token("--bad"),
    text: token("--text"),
    run: token("--run"),
  };
  probe.remove();
  return colours;
}
