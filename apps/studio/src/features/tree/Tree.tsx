import { CellTree } from "./CellTree.tsx";
import { ProgramList } from "./ProgramList.tsx";
import "./tree.css";

/** Left: what stands in the cell, and what the robot does. */
export function Tree() {
  return (
    <>
      <CellTree />
      <ProgramList />
    </>
  );
}
