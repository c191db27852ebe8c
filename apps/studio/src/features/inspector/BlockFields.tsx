import {
  PALLET_ORDERS,
  PALLET_PATTERNS,
  palletCount,
  palletPitch,
  type MessageStep,
  type Pallet,
  type PalletStep,
  type PayloadStep,
  type Program,
} from "@twincell/core";
import { theLive } from "../../runtime/live.ts";
import { changeStep } from "../../stores/program.ts";
import { setPallet, takeCorner, type Corner } from "../../stores/structure.ts";
import { Segments } from "../../ui/Choice.tsx";
import { showNumber } from "../../ui/expression.ts";
import { NumberField } from "../../ui/NumberField.tsx";
import { words } from "../../messages/index.ts";
import { NameChoice, Pair, TextField, WholeField } from "./Pieces.tsx";

/** Most rows or columns that the form takes; more is a mistake. */
const MOST_ROWS = 1000;
const MOST_LAYERS = 100;
const CORNERS: readonly Corner[] = ["origin", "rowEnd", "columnEnd"];

/** Which pallet, how many places, and its three corners. */
export function PalletFields({ program, step }: { readonly program: Program; readonly step: PalletStep }) {
  const { pallet: name } = step;
  const pallet = program.pallets[name];
  const set = (next: (before: Pallet) => Pallet, done = true): boolean =>
    setPallet(name, next, done ? undefined : `pallet ${name}`);
  if (pallet === undefined) return null;
  const pitch = palletPitch(pallet);
  const length = ([x, y, z]: readonly number[]): string => showNumber(Math.hypot(x!, y!, z!), "length", 1);
  return (
    <>
      <NameChoice
        label={words.editor.pallet}
        value={name}
        names={Object.keys(program.pallets)}
        onChange={next =>
          changeStep(step.id, words.editor.undo.pallet, before =>
            before.type === "pallet" ? { ...before, pallet: next } : before,
          )
        }
      />
      <WholeField
        key={`rows ${name}`}
        label={words.editor.rows}
        value={pallet.rows}
        most={MOST_ROWS}
        onChange={rows => set(before => ({ ...before, rows }))}
      />
      <WholeField
        key={`columns ${name}`}
        label={words.editor.columns}
        value={pallet.columns}
        least={pallet.interleave === "odd-rows-shifted" ? 2 : 1}
        most={MOST_ROWS}
        onChange={columns => set(before => ({ ...before, columns }))}
      />
      <WholeField
        key={`layers ${name}`}
        label={words.editor.layers}
        value={pallet.layers}
        most={MOST_LAYERS}
        onChange={layers => set(before => ({ ...before, layers }))}
      />
      {pallet.layers > 1 && (
        <Pair label={words.editor.layerHeight}>
          <NumberField
            label={words.editor.layerHeight}
            quantity="length"
            value={pallet.layer_m}
            min={-2}
            max={2}
            onChange={(layer_m, done) => set(before => ({ ...before, layer_m }), done)}
          />
        </Pair>
      )}
      <NameChoice
        label={words.editor.order}
        value={pallet.order ?? "rows"}
        names={PALLET_ORDERS}
        shown={each => words.editor.orders[PALLET_ORDERS.find(order => order === each) ?? "rows"]}
        onChange={each => {
          const order = PALLET_ORDERS.find(known => known === each);
          if (order !== undefined) set(before => ({ ...before, order }));
        }}
      />
      <NameChoice
        label={words.editor.pattern}
        value={pallet.interleave ?? "none"}
        names={pallet.columns < 2 ? ["none"] : PALLET_PATTERNS}
        shown={each => words.editor.patterns[PALLET_PATTERNS.find(pattern => pattern === each) ?? "none"]}
        onChange={each => {
          const interleave = PALLET_PATTERNS.find(known => known === each);
          if (interleave !== undefined) set(before => ({ ...before, interleave }));
        }}
      />
      <p className="small dim">{words.editor.cornersSay}</p>
      {CORNERS.map(corner => (
        <div className="pallet-corner" key={corner}>
          <span className="label">{words.editor.corners[corner]}</span>
          <span className="num small">
            {(corner === "origin" ? pallet.origin.position : pallet[corner])
              .map(value => showNumber(value, "length", 1))
              .join("  ")}
          </span>
          <button
            className="btn tight"
            aria-label={words.editor.takeCornerOf(words.editor.corners[corner])}
            onClick={() => takeCorner(name, corner, theLive().worldFromTcp)}
          >
            {words.editor.takeCorner}
          </button>
        </div>
      ))}
      <p className="small" role="status">
        {words.editor.places(palletCount(pallet))} · {words.editor.pitch(length(pitch.row), length(pitch.column))}
      </p>
    </>
  );
}

const MARKS = ["X", "Y", "Z"] as const;
const MOMENTS = ["Ixx", "Iyy", "Izz", "Ixy", "Ixz", "Iyz"] as const;

/** Mass, where it is, and how it resists turning. */
export function PayloadFields({ step }: { readonly step: PayloadStep }) {
  const set = (next: (before: PayloadStep) => PayloadStep, done = true): boolean =>
    changeStep(
      step.id,
      words.editor.undo.load,
      before => (before.type === "payload" ? next(before) : before),
      done ? undefined : `payload ${step.id}`,
    );
  const inertia = step.inertia_kgm2;
  return (
    <>
      <Pair label={words.editor.mass}>
        <NumberField
          label={words.editor.mass}
          quantity="mass"
          value={step.mass_kg}
          min={0}
          max={5000}
          onChange={(mass_kg, done) => set(before => ({ ...before, mass_kg }), done)}
        />
      </Pair>
      <h3 className="label">{words.editor.centre}</h3>
      <div className="fields-3">
        {MARKS.map((mark, k) => (
          <NumberField
            key={mark}
            label={`${words.editor.centre} ${mark}`}
            mark={mark}
            quantity="length"
            value={step.center_m[k]!}
            min={-5}
            max={5}
            onChange={(value, done) =>
              set(before => {
                const [x, y, z] = before.center_m.with(k, value) as [number, number, number];
                return { ...before, center_m: [x, y, z] };
              }, done)
            }
          />
        ))}
      </div>
      <Pair label={words.editor.inertia}>
        <Segments
          label={words.editor.inertia}
          value={inertia === undefined ? "none" : "known"}
          options={[
            { value: "none", words: words.editor.inertiaKinds.none },
            { value: "known", words: words.editor.inertiaKinds.known },
          ]}
          onChange={value =>
            set(({ inertia_kgm2: _before, ...rest }) =>
              value === "none" ? rest : { ...rest, inertia_kgm2: [0, 0, 0, 0, 0, 0] },
            )
          }
        />
      </Pair>
      {inertia !== undefined && (
        <div className="fields-3">
          {MOMENTS.map((mark, k) => (
            <NumberField
              key={mark}
              label={words.editor.momentOf(mark)}
              mark={mark}
              quantity="plain"
              value={inertia[k]!}
              decimals={4}
              onChange={(value, done) =>
                set(before => {
                  const [xx, yy, zz, xy, xz, yz] = before.inertia_kgm2 ?? inertia;
                  const six: [number, number, number, number, number, number] = [xx, yy, zz, xy, xz, yz];
                  six[k] = value;
                  return { ...before, inertia_kgm2: six };
                }, done)
              }
            />
          ))}
        </div>
      )}
    </>
  );
}

export function MessageFields({ step }: { readonly step: MessageStep }) {
  return (
    <div className="stack">
      <span className="label">{words.step.text}</span>
      <TextField
        key={step.id}
        label={words.step.text}
        value={step.text}
        most={200}
        onTake={text =>
          changeStep(step.id, words.editor.undo.text, before =>
            before.type === "message" ? { ...before, text } : before,
          )
        }
      />
    </div>
  );
}
