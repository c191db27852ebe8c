import { Names } from "../../emitter/index.ts";
import { SPEEDS, WORDS, ZONES } from "./words.ts";
import { speedText, zoneText } from "./data.ts";

/** Names of RAPID end here. */
const LONGEST_NAME = 32;

/** Data of the module, in the order in which the program first needs them; each is declared once. */
export class Declarations {
  readonly names = new Names({ most: LONGEST_NAME, reserved: WORDS, first: "n_", foldsCase: true });
  private readonly lines = new Map<string, { readonly line: string; readonly step: string }>();

  add(key: string, line: string, step = ""): void {
    if (!this.lines.has(key)) this.lines.set(key, { line, step });
  }
  get all(): readonly { readonly line: string; readonly step: string }[] {
    return [...this.lines.values()];
  }

  /** A predefined speed, or one of its own: v12_5 for 12.5 mm/s. */
  speed(v_mmps: string): string {
    const known = SPEEDS.find(speed => `${speed}` === v_mmps);
    if (known !== undefined) return `v${known}`;
    const name = this.names.of("speed", `v${v_mmps}`);
    this.add(`speed ${v_mmps}`, `CONST speeddata ${name}:=${speedText(v_mmps)};`);
    return name;
  }

  zone(zone_mm: string): string {
    if (zone_mm === "0") return "fine";
    const known = ZONES.find(zone => `${zone}` === zone_mm);
    if (known !== undefined) return `z${known}`;
    const name = this.names.of("zone", `z${zone_mm}`);
    this.add(`zone ${zone_mm}`, `CONST zonedata ${name}:=${zoneText(zone_mm)};`);
    return name;
  }
}
