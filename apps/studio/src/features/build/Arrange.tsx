import { aligned, circularPattern, groupOf, linearPattern, mirrored, type Axis } from "@twincell/project";
import type { Vector3 } from "@twincell/core";
import { useState } from "react";
import { useStore } from "zustand";
import { cellStore } from "../../stores/cell.ts";
import { commit } from "../../stores/document.ts";
import { addCopies, groupObjects, ungroupObjects } from "../../stores/objects.ts";
import { selectedObjects, selectionStore } from "../../stores/selection.ts";
import { Segments } from "../../ui/Choice.tsx";
import { NumberField } from "../../ui/NumberField.tsx";
import { words } from "../../messages/index.ts";
import "./build.css";

const AXES: readonly Axis[] = [0, 1, 2];
const LETTERS = ["X", "Y", "Z"] as const;
const SIDES = ["lower", "middle", "upper"] as const;

/** What is done with several objects at once, and patterns of one. */
export function Arrange() {
  const selected = useStore(selectionStore, state => state.selected);
  const more = useStore(selectionStore, state => state.more);
  const cell = useStore(cellStore, state => state.document);
  const ids = selectedObjects({ selected, more, hovered: null });
  const [first] = ids;
  if (!cell || first === undefined) return null;
  const grouped = groupOf(cell, first).length > 1;
  return (
    <>
      {ids.length > 1 && (
        <section aria-label={words.build.several(ids.length)}>
          <h2 className="heading">
            <span className="grow">{words.build.several(ids.length)}</span>
          </h2>
          <div className="section stack">
            <span className="label">{words.build.align}</span>
            <div className="arrange">
              {AXES.flatMap(axis =>
                SIDES.map(side => (
                  <button
                    key={`${axis} ${side}`}
                    className="btn tight"
                    aria-label={words.build.alignTip(LETTERS[axis], words.build.sides[side])}
                    title={words.build.alignTip(LETTERS[axis], words.build.sides[side])}
                    onClick={() => align(ids, axis, side)}
                  >
                    {LETTERS[axis]} {SIGNS[side]}
                  </button>
                )),
              )}
            </div>
            <span className="label">{words.build.mirror}</span>
            <div className="arrange">
              {AXES.slice(0, 2).map(axis => (
                <button
                  key={axis}
                  className="btn tight"
                  aria-label={words.build.mirrorTip(LETTERS[axis])}
                  onClick={() => mirror(ids, axis)}
                >
                  {LETTERS[axis]}
                </button>
              ))}
            </div>
            <button className="btn" onClick={() => (grouped ? ungroupObjects(ids) : groupObjects(ids))}>
              {grouped ? words.build.ungroup : words.build.group}
            </button>
          </div>
        </section>
      )}
      {ids.length === 1 && <Pattern key={first} id={first} />}
    </>
  );
}
const SIGNS = { lower: "⇤", middle: "↔", upper: "⇥" } as const;

function align(ids: readonly string[], axis: Axis, side: (typeof SIDES)[number]): void {
  commit(words.undo.align, before => {
    const chosen = ids.flatMap(id => before.objects.filter(object => object.id === id));
    const after = new Map(aligned(chosen, axis, side).map(object => [object.id, object]));
    // What is locked stays.
    return {
      ...before,
      objects: before.objects.map(object => (object.locked ? object : (after.get(object.id) ?? object))),
    };
  });
}

/** Mirrors the others about the first, which stays. */
function mirror(ids: readonly string[], axis: Axis): void {
  commit(words.undo.mirror, before => {
    const at_m = before.objects.find(object => object.id === ids[0])?.worldFromObject.position[axis];
    if (at_m === undefined) return before;
    return {
      ...before,
      objects: before.objects.map(object =>
        ids.slice(1).includes(object.id) && !object.locked
          ? { ...object, worldFromObject: mirrored(object.worldFromObject, axis, at_m) }
          : object,
      ),
    };
  });
}

/** Copies of one object in a row or round a circle. */
function Pattern({ id }: { id: string }) {
  const [kind, setKind] = useState<"row" | "circle">("row");
  const [count, setCount] = useState(3);
  const [step_m, setStep] = useState<Vector3>([0.5, 0, 0]);
  const [radius_m, setRadius] = useState(0.5);
  const make = (): void => {
    addCopies(id, words.undo.pattern, ({ worldFromObject }) => {
      const [x, y] = worldFromObject.position;
      const poses =
        kind === "row"
          ? linearPattern(worldFromObject, count, step_m)
          : circularPattern(worldFromObject, count, [x - radius_m, y], (2 * Math.PI) / count);
      return poses.slice(1);
    });
  };
  return (
    <section aria-label={words.build.pattern}>
      <details>
        <summary className="heading">{words.build.pattern}</summary>
        <div className="section stack">
          <Segments
            label={words.build.pattern}
            value={kind}
            onChange={setKind}
            options={[
              { value: "row", words: words.build.rowOf },
              { value: "circle", words: words.build.circle },
            ]}
          />
          <NumberField
            label={words.build.count}
            mark="n"
            quantity="plain"
            decimals={0}
            min={2}
            max={200}
            value={count}
            onChange={value => setCount(Math.round(value))}
          />
          {kind === "row" ? (
            <div className="fields-3">
              {AXES.map(axis => (
                <NumberField
                  key={axis}
                  label={`${words.build.step} ${LETTERS[axis]}`}
                  mark={LETTERS[axis]}
                  quantity="length"
                  unitAbove
                  decimals={0}
                  value={step_m[axis]}
                  onChange={value => setStep(step_m.map((old, k) => (k === axis ? value : old)) as Vector3)}
                />
              ))}
            </div>
          ) : (
            <NumberField
              label={words.build.radius}
              mark="r"
              quantity="length"
              min={0.01}
              max={20}
              value={radius_m}
              onChange={setRadius}
            />
          )}
          <button className="btn" onClick={make}>
            {words.build.makePattern}
          </button>
        </div>
      </details>
    </section>
  );
}
