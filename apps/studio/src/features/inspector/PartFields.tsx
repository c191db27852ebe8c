import { changedPart, partById, partNumbers, type ObjectRecord } from "@twincell/project";
import { NumberField } from "../../ui/NumberField.tsx";
import { words } from "../../messages/index.ts";

/** The numbers of a part of the library. */
export function PartFields({
  object,
  onChange,
}: {
  object: ObjectRecord;
  onChange: (change: (object: ObjectRecord) => ObjectRecord, done: boolean) => void;
}) {
  const kind = object.shape.kind === "part" ? partById(object.shape.part) : undefined;
  if (object.shape.kind !== "part" || kind === undefined) return null;
  const numbers = partNumbers(kind, object.shape.parameters);
  return kind.parameters.map(({ id, quantity, min, max }) => (
    <div className="pair" key={id}>
      <span className="label">{words.parts.parameters[id]}</span>
      <NumberField
        label={words.parts.parameters[id]}
        quantity={quantity}
        min={min}
        max={max}
        decimals={quantity === "speed" ? 0 : 1}
        value={numbers[id]!}
        onChange={(value, done) => onChange(before => changedPart(before, { [id]: value }), done)}
      />
    </div>
  ));
}
