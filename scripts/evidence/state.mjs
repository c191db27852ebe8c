// How old a kept result is, beside the code that it judges.
import { spawnSync } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";

/**
 * One state for each entry: `missing` (no result or no date in it), `older` (the code it judges changed on a later
 * day) or `current`. Days, not seconds: a result is kept by a commit made after it.
 */
export function evidenceStates(evidence, root) {
  return evidence.map(each => {
    const made = existsSync(root + each.result) ? dateOf(readFileSync(root + each.result, "utf8")) : undefined;
    const changed = lastChange(each.judges, root);
    const level = made === undefined ? "missing" : changed !== undefined && changed > made ? "older" : "current";
    return { name: each.name, level, made, changed, judges: each.judges };
  });
}

/** The day of a result, YYYY-MM-DD: its own `date`, else the newest of its parts. */
export function dateOf(text) {
  const dates = [...text.matchAll(/"date":\s*"(\d{4}-\d{2}-\d{2})/g)].map(match => match[1]).sort();
  return dates.at(-1);
}

/** The day of the last commit that changed code of these folders, tests apart; undefined outside a git checkout. */
function lastChange(judges, root) {
  const log = spawnSync("git", ["log", "-1", "--format=%cs", "--", ...judges, ":!*.test.ts", ":!**/testing/**"], {
    cwd: root,
    encoding: "utf8",
  });
  const day = log.status === 0 ? log.stdout.trim() : "";
  return day === "" ? undefined : day;
}

/** What a person is told of one state. */
export function stateSentence({ name, level, made, changed, judges }) {
  if (level === "missing") return `${name}: no dated result; npm run evidence -- ${name} makes it.`;
  if (level === "older")
    return `${name}: made ${made}, ${judges.join(" and ")} changed ${changed}; npm run evidence -- ${name} makes it anew.`;
  return `${name}: made ${made}, the code it judges is no newer.`;
}
