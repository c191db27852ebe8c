import { ownRobotFile, robotFromArm, type Robot } from "@twincell/core";
import { readDhTable } from "@twincell/formats";
import { useMemo, useState } from "react";
import { useStore } from "zustand";
import { takeRobotFile } from "../../runtime/own-robot.ts";
import { closeDialog, dialogStore } from "../../stores/dialogs.ts";
import { Segments } from "../../ui/Choice.tsx";
import { showNumber } from "../../ui/expression.ts";
import { Frame } from "../../ui/Frame.tsx";
import { say, words } from "../../messages/index.ts";
import "./robots.css";

const COLUMNS = ["a", "alpha", "d", "theta", "lower", "upper", "speed"] as const;
type Column = (typeof COLUMNS)[number];
type Row = Readonly<Record<Column, string>>;
type Convention = "standard" | "modified";
const NEW_ROW: Row = { a: "0", alpha: "0", d: "0", theta: "0", lower: "-180", upper: "180", speed: "180" };
/** A six-axis arm to start from: nobody types a whole table to see what it is for. */
const START: readonly Row[] = [
  { ...NEW_ROW, alpha: "-90", a: "25", d: "400" },
  { ...NEW_ROW, a: "455", lower: "-190", upper: "45" },
  { ...NEW_ROW, alpha: "-90", a: "35", theta: "-90", lower: "-120", upper: "156" },
  { ...NEW_ROW, alpha: "90", d: "420" },
  { ...NEW_ROW, alpha: "-90", lower: "-120", upper: "120" },
  { ...NEW_ROW, d: "80", lower: "-350", upper: "350" },
];
const FEWEST = 1;
const MOST = 12;

/** A robot of a typed Denavit–Hartenberg table (row T-16): it is judged as it is typed. */
export default function DhTable() {
  const open = useStore(dialogStore, state => state.open === "dh-table");
  return open ? <Open /> : null;
}

type Answer = { readonly robot: Robot } | { readonly sentence: string };

function robotOfRows(name: string, convention: Convention, rows: readonly Row[]): Answer {
  const numbers = rows.map(row => Object.fromEntries(COLUMNS.map(column => [column, numberOf(row[column])])));
  const read = readDhTable(
    JSON.stringify({ name, convention, units: { length: "mm", angle: "deg" }, rows: numbers }),
    name,
  );
  if (read.kind !== "read") return { sentence: read.sentence };
  const known = { id: name, name, assumptions: read.assumptions, sources: { arm: words.own.table.source } };
  return { robot: robotFromArm(read.arm, known) };
}
/** Both decimal signs are taken; what is no number is left for the reader of tables to name. */
const numberOf = (typed: string): number | string => {
  const plain = typed.trim().replace(",", ".").replace("−", "-");
  return plain !== "" && Number.isFinite(Number(plain)) ? Number(plain) : typed;
};

function Open() {
  const [name, setName] = useState<string>(words.own.table.mine);
  const [convention, setConvention] = useState<Convention>("standard");
  const [rows, setRows] = useState(START);
  const answer = useMemo(() => robotOfRows(name.trim() || "robot", convention, rows), [name, convention, rows]);
  const change = (at: number, column: Column, typed: string): void =>
    setRows(before => before.map((row, i) => (i === at ? { ...row, [column]: typed } : row)));
  const use = (): void => {
    if (!("robot" in answer)) return;
    closeDialog();
    void takeRobotFile(ownRobotFile(answer.robot));
  };
  return (
    <Frame
      open
      title={words.own.table.title}
      onClose={closeDialog}
      width={720}
      foot={
        <>
          <span className="small muted grow" role="status">
            {"robot" in answer ? factsOf(answer.robot) : say(answer.sentence)}
          </span>
          <button className="btn primary" disabled={!("robot" in answer)} onClick={use}>
            {words.own.table.use}
          </button>
        </>
      }
    >
      <div className="stack">
        <label className="stack">
          <span className="label">{words.own.table.name}</span>
          <input
            className="dh-name"
            value={name}
            maxLength={60}
            onChange={event => setName(event.currentTarget.value)}
          />
        </label>
        <Segments
          label={words.own.table.convention}
          value={convention}
          options={[
            { value: "standard", words: words.own.table.standard },
            { value: "modified", words: words.own.table.modified },
          ]}
          onChange={setConvention}
        />
        <p className="small muted">
          {convention === "standard" ? words.own.table.standardSays : words.own.table.modifiedSays}
        </p>
        <div className="dh-scroll">
          <table className="dh-table num">
            <thead>
              <tr>
                <td />
                {COLUMNS.map(column => (
                  <th key={column} scope="col">
                    {words.own.table[column]}
                  </th>
                ))}
              </tr>
            </thead>
            <tbody>
              {rows.map((row, i) => (
                // biome-ignore lint/suspicious/noArrayIndexKey: a row is its place in the chain
                <tr key={i}>
                  <th scope="row">{words.own.table.joint(i + 1)}</th>
                  {COLUMNS.map(column => (
                    <td key={column}>
                      <input
                        className="input"
                        inputMode="decimal"
                        aria-label={words.own.table.cell(words.own.table[column], i + 1)}
                        value={row[column]}
                        onChange={event => change(i, column, event.currentTarget.value)}
                      />
                    </td>
                  ))}
                </tr>
              ))}
            </tbody>
          </table>
        </div>
        <div className="row">
          <button
            className="btn small"
            disabled={rows.length >= MOST}
            onClick={() => setRows(before => [...before, NEW_ROW])}
          >
            {words.own.table.addRow}
          </button>
          <button
            className="btn small"
            disabled={rows.length <= FEWEST}
            onClick={() => setRows(before => before.slice(0, -1))}
          >
            {words.own.table.removeRow}
          </button>
        </div>
      </div>
    </Frame>
  );
}

const factsOf = (robot: Robot): string =>
  [
    words.own.axes(robot.arm.joints.length),
    robot.family.kind === "general" ? words.own.numerical : words.own.closedForm,
    `${words.inspector.reach} ${showNumber(robot.reach_m, "length", 0)} mm`,
  ].join(" · ");
