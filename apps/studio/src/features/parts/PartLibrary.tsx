import { PARTS, partNumbers, type PartKind } from "@twincell/project";
import { Search, Upload } from "lucide-react";
import { useMemo, useState } from "react";
import { placePart } from "../../runtime/parts.ts";
import { buildStore } from "../../stores/build.ts";
import { runCommand } from "../../stores/commands.ts";
import { showNumber } from "../../ui/expression.ts";
import { words } from "../../messages/index.ts";
import { partName } from "../../messages/phrases.ts";
import { partPicture } from "./picture.ts";
import "./parts.css";

type Category = PartKind["category"] | "all";
const CATEGORIES: readonly Category[] = ["all", "tables", "conveyors", "safety", "load", "stands", "tools"];

/** The drawer of Cell mode: parts to drag into the cell, or to place with a click. */
export function PartLibrary() {
  const [category, setCategory] = useState<Category>("all");
  const [typed, setTyped] = useState("");
  const query = typed.trim().toLowerCase();
  const found = PARTS.filter(
    part => (category === "all" || part.category === category) && partName(part.id).toLowerCase().includes(query),
  );
  return (
    <section className="parts" aria-label={words.parts.title}>
      <h2 className="heading parts-head">
        <span>{words.parts.title}</span>
        <label className="field text parts-search">
          <Search aria-hidden />
          <input
            type="search"
            aria-label={words.parts.search(PARTS.length)}
            placeholder={words.parts.search(PARTS.length)}
            value={typed}
            onChange={event => setTyped(event.currentTarget.value)}
          />
        </label>
        <span className="grow" />
        <span className="dim parts-hint">{words.parts.hint}</span>
        <button className="btn" onClick={() => runCommand("file.load")}>
          <Upload />
          {words.parts.own}
        </button>
      </h2>
      <div className="parts-body">
        <ul className="parts-kinds">
          {CATEGORIES.map(each => (
            <li key={each}>
              <button
                className="row"
                data-on={category === each}
                aria-pressed={category === each}
                onClick={() => setCategory(each)}
              >
                <span className="name">{words.parts.categories[each]}</span>
                <span className="dim">
                  {each === "all" ? PARTS.length : PARTS.filter(part => part.category === each).length}
                </span>
              </button>
            </li>
          ))}
        </ul>
        {found.length === 0 ? (
          <p className="muted small">{words.parts.none(typed)}</p>
        ) : (
          <ul className="parts-cards">
            {found.map(part => (
              <li key={part.id}>
                <PartCard part={part} />
              </li>
            ))}
          </ul>
        )}
      </div>
    </section>
  );
}

function PartCard({ part }: { part: PartKind }) {
  const name = partName(part.id);
  const numbers = partNumbers(part, {});
  const picture = useMemo(
    () => partPicture({ kind: "part", part: part.id, parameters: partNumbers(part, {}) }),
    [part],
  );
  const sizes = part.parameters
    .filter(({ id }) => id === "length" || id === "width" || id === "height")
    .slice(0, 2)
    .map(({ id }) => showNumber(numbers[id]!, "length", 0));
  return (
    <button
      className="part-card"
      draggable
      onClick={() => placePart(part.id)}
      onDragStart={event => {
        event.dataTransfer.setData("text/plain", name);
        event.dataTransfer.effectAllowed = "copy";
        buildStore.setState({ carrying: part.id });
      }}
      onDragEnd={() => buildStore.setState({ carrying: null })}
    >
      <svg viewBox={picture.viewBox} aria-hidden>
        {picture.faces.map((face, i) => (
          <polygon key={i} points={face.points} fill={face.fill} />
        ))}
      </svg>
      <b>{name}</b>
      <span className="dim">{sizes.join(" × ")}</span>
    </button>
  );
}
