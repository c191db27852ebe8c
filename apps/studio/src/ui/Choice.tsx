import { Check, ChevronDown } from "lucide-react";
import { Select, ToggleGroup } from "radix-ui";

interface Option<Value extends string> {
  readonly value: Value;
  readonly words: string;
  readonly disabled?: boolean /** Why it cannot be chosen. */;
  readonly hint?: string;
}
interface Props<Value extends string> {
  readonly label: string;
  readonly value: Value;
  readonly options: readonly Option<Value>[];
  readonly onChange: (value: Value) => void;
}

const pick = <Value extends string>(options: readonly Option<Value>[], raw: string): Value | undefined =>
  options.find(option => option.value === raw)?.value;

/** Few options, all in sight. */
export function Segments<Value extends string>({
  label,
  value,
  options,
  onChange,
  className = "seg fill small-seg",
}: Props<Value> & { className?: string }) {
  return (
    <ToggleGroup.Root
      type="single"
      className={className}
      aria-label={label}
      value={value}
      onValueChange={raw => {
        const next = pick(options, raw);
        if (next !== undefined) onChange(next);
      }}
    >
      {options.map(option => (
        <ToggleGroup.Item
          key={option.value}
          className="seg-item"
          value={option.value}
          disabled={option.disabled ?? false}
        >
          {option.words}
        </ToggleGroup.Item>
      ))}
    </ToggleGroup.Root>
  );
}

/** Many options. */
export function Chooser<Value extends string>({ label, value, options, onChange }: Props<Value>) {
  return (
    <Select.Root
      value={value}
      onValueChange={raw => {
        const next = pick(options, raw);
        if (next !== undefined) onChange(next);
      }}
    >
      <Select.Trigger className="btn tight choice" aria-label={label}>
        <span className="choice-value">
          <Select.Value />
        </span>
        <Select.Icon>
          <ChevronDown />
        </Select.Icon>
      </Select.Trigger>
      <Select.Portal>
        <Select.Content
          className="menu"
          position="popper"
          sideOffset={4}
          style={{ maxHeight: "50vh", overflow: "auto" }}
        >
          <Select.Viewport>
            {options.map(option => (
              <Select.Item
                key={option.value}
                className="menu-item"
                value={option.value}
                disabled={option.disabled ?? false}
              >
                <span className="choice-words">
                  <Select.ItemText>{option.words}</Select.ItemText>
                  {option.hint && <span className="dim small">{option.hint}</span>}
                </span>
                <Select.ItemIndicator style={{ marginLeft: "auto" }}>
                  <Check size={14} />
                </Select.ItemIndicator>
              </Select.Item>
            ))}
          </Select.Viewport>
        </Select.Content>
      </Select.Portal>
    </Select.Root>
  );
}
