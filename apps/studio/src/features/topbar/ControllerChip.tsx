import { Popover } from "radix-ui";
import { useStore } from "zustand";
import { runCommand } from "../../stores/commands.ts";
import { controlStore } from "../../stores/control.ts";
import { playStore } from "../../stores/play.ts";
import { say, words } from "../../messages/index.ts";
import { fixed } from "../../messages/numbers.ts";

/** Who commands, in which mode, how late, and the safety state in words. */
export function ControllerChip({ brief }: { brief: boolean }) {
  const control = useStore(controlStore);
  const override = useStore(playStore, state => state.speed);
  const latency =
    control.latency_ms === null ? null : words.control.ms(fixed(control.latency_ms, control.latency_ms < 10 ? 1 : 0));
  const says =
    control.safety === "normal"
      ? [
          words.control.modes[control.mode],
          latency,
          control.commander === "you" ? words.control.youCommand : words.control.commands(control.commander),
        ]
          .filter(Boolean)
          .join(" · ")
      : words.control.safetyStates[control.safety];
  return (
    <Popover.Root>
      <Popover.Trigger asChild>
        <button className="chip" data-safety={control.safety} data-running={control.running}>
          <i aria-hidden />
          <span>{control.controller}</span>
          {brief ? <span className="visually-hidden">{says}</span> : <span className="chip-more">{says}</span>}
        </button>
      </Popover.Trigger>
      <Popover.Portal>
        <Popover.Content className="pop" sideOffset={8} align="end" collisionPadding={8}>
          <dl className="facts">
            <div>
              <dt>{words.control.state}</dt>
              <dd>{control.running ? words.control.running : words.control.idle}</dd>
            </div>
            <div>
              <dt>{words.control.commander}</dt>
              <dd>{control.commander === "you" ? words.control.you : control.commander}</dd>
            </div>
            <div>
              <dt>{words.control.mode}</dt>
              <dd>{words.control.modes[control.mode]}</dd>
            </div>
            <div>
              <dt>{words.control.latency}</dt>
              <dd>{latency ?? words.control.unknown}</dd>
            </div>
            <div>
              <dt>{words.control.speed}</dt>
              <dd>{Math.round(override * 100)} %</dd>
            </div>
            <div>
              <dt>{words.control.safety}</dt>
              <dd>{words.control.safetyStates[control.safety]}</dd>
            </div>
          </dl>
          {control.message && <p className="chip-message">{say(control.message)}</p>}
          {control.safety !== "normal" && (
            <button className="btn" onClick={() => runCommand("run.reset")}>
              {words.control.reset}
            </button>
          )}
          <p className="small dim">{words.control.virtualNote}</p>
          <p className="small muted">
            <b>{words.app.notSafety}</b> {words.app.notSafetyHint}
          </p>
        </Popover.Content>
      </Popover.Portal>
    </Popover.Root>
  );
}
