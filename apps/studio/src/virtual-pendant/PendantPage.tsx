import { Moon, Sun } from "lucide-react";
import { Tooltip } from "radix-ui";
import { useEffect, useState } from "react";
import { words } from "../messages/index.ts";
import { Desk } from "./Desk.tsx";
import type { VirtualPendantLink } from "./link.ts";

type Theme = "dark" | "light";

/** @param sentence  why there is no pendant here; "" when nobody said which, null while nothing is known. */
export function PendantPage({
  link,
  sentence,
}: {
  readonly link: VirtualPendantLink | null;
  readonly sentence: string | null;
}) {
  const [theme, setTheme] = useState<Theme>(() =>
    matchMedia("(prefers-color-scheme: light)").matches ? "light" : "dark",
  );
  useEffect(() => {
    document.documentElement.dataset.theme = theme;
  }, [theme]);
  return (
    <Tooltip.Provider delayDuration={500}>
      <main className="desk-page" aria-label={words.cabinet.title}>
        <button
          className="btn quiet icon desk-theme"
          aria-label={words.top.theme}
          onClick={() => {
            setTheme(theme === "dark" ? "light" : "dark");
          }}
        >
          {theme === "dark" ? <Sun /> : <Moon />}
        </button>
        {sentence !== null && (
          <p className="desk-lost" role="alert">
            {sentence === "" ? words.cabinet.none : sentence}
          </p>
        )}
        {link ? (
          <Desk link={link} alone />
        ) : (
          sentence === null && (
            <p className="desk-wait muted" role="status">
              {words.cabinet.connecting}
            </p>
          )
        )}
      </main>
    </Tooltip.Provider>
  );
}
