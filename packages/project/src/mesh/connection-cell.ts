import { type CellGeometry, type Pose, type Refusal, type Robot } from "@twincell/core";
import { readDocument } from "../open.ts";
import { cellGeometry } from "./shape.ts";

export type ConnectionCellRead =
  | { readonly kind: "cell"; readonly cell: Omit<CellGeometry, "links"> }
  | { readonly kind: "refused"; readonly why: Refusal };

/**
 * What a connected robot is kept clear of, from the document of its cell: the objects, and the tool in use. What the
 * document says of links of another robot is left out.
 *
 * @param worldFromBase  where the robot stands in that cell; where the robot of the document stands when left out.
 */
export function readConnectionCell(
  document: unknown,
  robot: Robot,
  worldFromBase?: Pose<"world", "base">,
): ConnectionCellRead {
  const opened = readDocument(document);
  if (opened.kind !== "opened")
    return {
      kind: "refused",
      why: {
        code: "station.cell",
        sentence:
          opened.kind === "too-new"
            ? `The cell is of version ${opened.version}, and version ${opened.newest} is the newest that is known here.`
            : `The cell cannot be read: ${opened.why[0] ?? "it is empty."}`,
        hint: "The robot is not moved with a cell that nobody can read: save the cell anew with this release, and give it again.",
      },
    };
  const { document: cell } = opened;
  const isSame = cell.robot.id === robot.id;
  const ofRobot = (name: string): boolean => /^link \d+$/.test(name);
  const { links, ...geometry } = cellGeometry(
    {
      ...cell,
      robot: { ...cell.robot, id: robot.id, worldFromBase: worldFromBase ?? cell.robot.worldFromBase },
      allowedPairs: isSame ? cell.allowedPairs : cell.allowedPairs.filter(([a, b]) => !ofRobot(a) && !ofRobot(b)),
    },
    [],
  );
  return { kind: "cell", cell: geometry };
}
