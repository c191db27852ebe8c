import { Popover } from "radix-ui";
import { useStore } from "zustand";
import { playStore } from "../../stores/play.ts";
import { Slide } from "../../ui/Slide.tsx";
import { words } from "../../messages/index.ts";

const PRESETS = [0, 0.1, 0.25, 0.5, 1] as const;

/** Speed override, 0 … 100 %. */
export function Override() {
  const speed = useStore(playStore, state => state.speed);
  const percent = Math.round(speed * 100);
  const choose = (next: number): void => playStore.setState({ speed: next });
  return (
    <Popover.Root>
      <Popover.Trigger asChild>
        <button className="chip">
          <span className="dim">{words.top.speed}</span>
          <b className="override-number">{percent} %</b>
        </button>
      </Popover.Trigger>
      <Popover.Portal>
        <Popover.Content className="pop" sideOffset={8} collisionPadding={8} style={{ width: 260 }}>
          <Slide label={words.top.speed} value={speed} says={`${percent} %`} onChange={choose} />
          <div className="override-presets">
            {PRESETS.map(preset => (
              <button key={preset} className="btn tight" aria-pressed={preset === speed} onClick={() => choose(preset)}>
                {preset * 100} %
              </button>
            ))}
          </div>
          <p className="small dim">{words.top.speedTip}</p>
        </Popover.Content>
      </Popover.Portal>
    </Popover.Root>
  );
}
