import { DENSITY_KGM3, FRICTION, meshBounds, meshVolume, type Pose, type Vector3 } from "@twincell/core";
import {
  freeToolName,
  rescaledObjects,
  shapeMesh,
  toolOfObject,
  withNewTool,
  withObjects,
  type ObjectRecord,
} from "@twincell/project";
import { useMemo } from "react";
import { cellStore } from "../../stores/cell.ts";
import { commit, withObject } from "../../stores/document.ts";
import { notify } from "../../stores/notices.ts";
import { select } from "../../stores/selection.ts";
import { Chooser } from "../../ui/Choice.tsx";
import { shownUnit } from "../../ui/expression.ts";
import { NumberField } from "../../ui/NumberField.tsx";
import { words } from "../../messages/index.ts";
import { PartFields } from "./PartFields.tsx";
import { PoseFields } from "./PoseFields.tsx";
import { WorkPiecePath } from "./WorkPiecePath.tsx";

const SIDES = [words.inspector.width, words.inspector.depth, words.inspector.height] as const;
const MARKS = ["X", "Y", "Z"] as const;

export function ObjectInspector({ object }: { object: ObjectRecord }) {
  const change = (label: string, next: (object: ObjectRecord) => ObjectRecord, done: boolean): boolean =>
    commit(label, document => withObject(document, object.id, next), done ? undefined : `${label} ${object.id}`);
  const move = (pose: Pose, done: boolean): boolean =>
    change(
      words.undo.moveObject,
      before => ({ ...before, worldFromObject: { position: pose.position, quaternion: pose.quaternion } }),
      done,
    );
  const { shape } = object;
  return (
    <section aria-label={object.name}>
      <h2 className="heading">
        <span className="grow">{object.name}</span>
        <span className="tag">{words.tree.roles[object.role]}</span>
      </h2>
      <div className="section stack">
        <PoseFields pose={object.worldFromObject} onChange={move} />
        {shape.kind === "box" && (
          <>
            <h3 className="label">
              {words.inspector.size} <span className="dim">{shownUnit("length")}</span>
            </h3>
            <div className="fields-3">
              {MARKS.map((mark, i) => (
                <NumberField
                  key={mark}
                  label={`${words.inspector.size} ${SIDES[i]}`}
                  mark={mark}
                  quantity="length"
                  unitAbove
                  min={0.001}
                  max={20}
                  value={shape.size_m[i]!}
                  onChange={(value, done) =>
                    change(
                      words.undo.size,
                      before => {
                        if (before.shape.kind !== "box") return before;
                        const size_m: Vector3 = [
                          before.shape.size_m[0],
                          before.shape.size_m[1],
                          before.shape.size_m[2],
                        ];
                        size_m[i] = value;
                        return { ...before, shape: { kind: "box", size_m } };
                      },
                      done,
                    )
                  }
                />
              ))}
            </div>
          </>
        )}
        <PartFields object={object} onChange={(next, done) => change(words.undo.part, next, done)} />
        <div className="pair">
          <span className="label">{words.inspector.role}</span>
          <Chooser
            label={words.inspector.role}
            value={object.role}
            onChange={role => change(words.undo.part, before => ({ ...before, role }), true)}
            options={ROLES.map(role => ({ value: role, words: words.tree.roles[role] }))}
          />
        </div>
        <Physical object={object} onChange={(next, done) => change(words.undo.part, next, done)} />
        <WorkPiecePath object={object} />
        {shape.kind === "mesh" && <MeshSize object={object} />}
        {object.role !== "workpiece" && shape.kind !== "part" && (
          <button className="btn small" title={words.tools.makeToolSays} onClick={() => makeTool(object)}>
            {words.tools.makeTool(object.name)}
          </button>
        )}
        {shape.kind === "mesh" && (
          <div className="pair">
            <span className="label">{words.inspector.shape}</span>
            <span className="num">{shape.file}</span>
          </div>
        )}
        {(shape.kind === "cylinder" || shape.kind === "revolved") && (
          <div className="pair">
            <span className="label">{words.inspector.shape}</span>
            <span className="num">{words.inspector.shapes[shape.kind]}</span>
          </div>
        )}
      </div>
    </section>
  );
}

const ROLES: readonly ObjectRecord["role"][] = ["workpiece", "fixture", "furniture", "wall"];

/** Mass and friction; what nobody has typed is shown as the simulation takes it: by volume, and of dry contact. */
function Physical({
  object,
  onChange,
}: {
  object: ObjectRecord;
  onChange: (change: (object: ObjectRecord) => ObjectRecord, done: boolean) => void;
}) {
  const { shape } = object;
  const byVolume_kg = useMemo(() => Math.max(0.001, Math.abs(meshVolume(shapeMesh(shape))) * DENSITY_KGM3), [shape]);
  return (
    <>
      {(object.mass_kg !== undefined || object.role === "workpiece") && (
        <div className="pair">
          <span className="label">{words.parts.mass}</span>
          <NumberField
            label={words.parts.mass}
            mark="kg"
            quantity="plain"
            decimals={2}
            min={0.001}
            max={100_000}
            value={object.mass_kg ?? byVolume_kg}
            onChange={(mass_kg, done) => onChange(before => ({ ...before, mass_kg }), done)}
          />
        </div>
      )}
      <div className="pair">
        <span className="label">{words.parts.friction}</span>
        <NumberField
          label={words.parts.friction}
          mark="µ"
          quantity="plain"
          decimals={2}
          min={0}
          max={10}
          value={object.friction ?? FRICTION}
          onChange={(friction, done) => onChange(before => ({ ...before, friction }), done)}
        />
      </div>
    </>
  );
}

const LEAST_M = 0.0001;
const MOST_M = 1000;

/** The sides of an imported part, and the factor that makes all of it larger or smaller (row M-08). */
function MeshSize({ object }: { object: ObjectRecord }) {
  const { shape } = object;
  const size_m = useMemo(() => {
    const { lower, upper } = meshBounds(shapeMesh(shape));
    return [0, 1, 2].map(k => upper[k]! - lower[k]!);
  }, [shape]);
  const scale = (factor: number): void => {
    if (!(factor > 0) || factor === 1) return;
    commit(words.undo.size, document => withObjects(document, rescaledObjects([object], factor)));
  };
  return (
    <>
      <h3 className="label">
        {words.inspector.size} <span className="dim">{shownUnit("length")}</span>
      </h3>
      <div className="fields-3">
        {MARKS.map((mark, i) => (
          <NumberField
            key={mark}
            label={`${words.inspector.size} ${SIDES[i]}`}
            mark={mark}
            quantity="length"
            unitAbove
            min={LEAST_M}
            max={MOST_M}
            value={size_m[i]!}
            disabled={!(size_m[i]! > 0)}
            onChange={(value, done) => {
              if (done) scale(value / size_m[i]!);
            }}
          />
        ))}
      </div>
      <div className="pair">
        <span className="label">{words.inspector.scale}</span>
        <NumberField
          label={words.inspector.scale}
          mark="×"
          quantity="plain"
          decimals={4}
          min={0.0001}
          max={10_000}
          value={1}
          onChange={(value, done) => {
            if (done) scale(value);
          }}
        />
      </div>
    </>
  );
}

/** The object leaves the cell and comes to the flange as the tool in use. */
function makeTool(object: ObjectRecord): void {
  const { document } = cellStore.getState();
  if (!document) return;
  const name = freeToolName(document, object.name);
  const end_m = meshBounds(shapeMesh(object.shape)).upper[2];
  const made = commit(words.tools.makeTool(object.name), before =>
    withNewTool(
      { ...before, objects: before.objects.filter(({ id }) => id !== object.id) },
      toolOfObject(object, name, end_m),
    ),
  );
  if (!made) return;
  select({ kind: "tool" });
  notify("done", words.tools.mounted(name));
}
