import { Refusal } from "../refusal.ts";

/** The JSON of a glTF, asked entry by entry; what is not as it should be is said with its place. */
export class GltfEntry {
  readonly place: string;
  private readonly value: Readonly<Record<string, unknown>>;
  constructor(value: unknown, place: string) {
    if (typeof value !== "object" || value === null || Array.isArray(value))
      throw new Refusal(`${place} of the glTF is not there or not an object.`);
    this.value = value as Readonly<Record<string, unknown>>;
    this.place = place;
  }
  has(name: string): boolean {
    return Object.hasOwn(this.value, name);
  }
  child(name: string): GltfEntry {
    return new GltfEntry(this.value[name], `${this.place}.${name}`);
  }
  text(name: string): string | undefined {
    const value = this.value[name];
    return typeof value === "string" ? value : undefined;
  }
  isTrue(name: string): boolean {
    return this.value[name] === true;
  }
  /** A whole number from 0; `otherwise` where it is left out. */
  whole(name: string, otherwise?: number): number {
    const value = this.value[name] ?? otherwise;
    if (typeof value !== "number" || !Number.isInteger(value) || value < 0 || value > 2 ** 32)
      throw new Refusal(`${this.place}.${name} of the glTF is not a whole number.`);
    return value;
  }
  /** Finite numbers, exactly so many. */
  numbers(name: string, length: number): number[] | undefined {
    const value = this.value[name];
    if (value === undefined) return undefined;
    if (
      !Array.isArray(value) ||
      value.length !== length ||
      !value.every(item => typeof item === "number" && Number.isFinite(item))
    )
      throw new Refusal(`${this.place}.${name} of the glTF wants ${length} finite numbers.`);
    return value as number[];
  }
  list(name: string): readonly unknown[] {
    const value = this.value[name] ?? [];
    if (!Array.isArray(value)) throw new Refusal(`${this.place}.${name} of the glTF is not a list.`);
    return value;
  }
  entry(name: string, index: number): GltfEntry {
    return new GltfEntry(this.list(name)[index], `${name}[${index}]`);
  }
}
