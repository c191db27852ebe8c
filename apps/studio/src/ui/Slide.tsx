import { Slider } from "radix-ui";

/** One value on a line. */
export function Slide({
  label,
  value,
  min = 0,
  max = 1,
  step = 0.01,
  says,
  onChange,
  onDone,
}: {
  label: string;
  value: number;
  min?: number;
  max?: number;
  step?: number;
  says?: string;
  onChange: (value: number) => void;
  onDone?: (value: number) => void;
}) {
  return (
    <Slider.Root
      className="slider"
      value={[value]}
      min={min}
      max={max}
      step={step}
      onValueChange={([next]) => {
        if (next !== undefined) onChange(next);
      }}
      onValueCommit={([next]) => {
        if (next !== undefined) onDone?.(next);
      }}
    >
      <Slider.Track className="slider-track">
        <Slider.Range className="slider-range" />
      </Slider.Track>
      <Slider.Thumb className="slider-thumb" aria-label={label} {...(says ? { "aria-valuetext": says } : {})} />
    </Slider.Root>
  );
}
