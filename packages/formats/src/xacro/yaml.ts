import { parseDocument, type ScalarTag, type Tags } from "yaml";
import { Refusal } from "../refusal.ts";
import { utf8 } from "../utf8.ts";
import { Dict, keyOf, List, type Value } from "./expression/values.ts";

const LARGEST_BYTES = 4_000_000;
const MOST_ALIASES = 100;
const DEEPEST = 64;
const UNITS: Readonly<Record<string, number>> = {
  radians: 1,
  degrees: Math.PI / 180,
  meters: 1,
  millimeters: 0.001,
  foot: 0.3048,
  inches: 0.0254,
};

/**
 * Reads a YAML file as configuration of a robot: numbers, texts, lists, dictionaries, and the tags `!degrees`,
 * `!radians`, `!millimeters`, `!meters`, `!inches`, `!foot`, which give radians and metres.
 *
 * @param amount  works out what stands behind such a tag: a number or an expression.
 */
export function readYaml(bytes: Uint8Array, amount: (text: string) => number): Value {
  if (bytes.length > LARGEST_BYTES)
    throw new Refusal(`The YAML file has ${bytes.length} bytes; at most ${LARGEST_BYTES} are read.`);
  const units: ScalarTag[] = Object.entries(UNITS).map(([name, factor]) => ({
    tag: `!${name}`,
    resolve: text => amount(text) * factor,
  }));
  const document = parseDocument(utf8(bytes), {
    version: "1.1",
    intAsBigInt: true,
    uniqueKeys: false,
    customTags: tags => [...tags.map(withoutLetters), ...units],
    logLevel: "silent",
    prettyErrors: false,
  });
  const [problem] = document.errors;
  if (problem)
    throw new Refusal(`The YAML file is not understood: ${problem.message.split("\n")[0]!.replace(/[.:]$/, "")}.`);
  let plain: unknown;
  try {
    plain = document.toJS({ mapAsMap: true, maxAliasCount: MOST_ALIASES });
  } catch (problem) {
    if (problem instanceof ReferenceError)
      throw new Refusal("The YAML file repeats itself through aliases more than a hundred times.");
    throw problem;
  }
  return valueOf(plain, 0);
}

/** `y` and `n` alone are names of axes in robot files, not truth values. */
function withoutLetters(tag: Tags[number]): Tags[number] {
  if (typeof tag !== "object" || tag.tag !== "tag:yaml.org,2002:bool" || !("test" in tag) || !tag.test) return tag;
  return {
    ...tag,
    test: tag.test.test("yes") ? /^(?:[Yy]es|YES|[Tt]rue|TRUE|[Oo]n|ON)$/ : /^(?:[Nn]o|NO|[Ff]alse|FALSE|[Oo]ff|OFF)$/,
  };
}

function valueOf(plain: unknown, depth: number): Value {
  if (depth > DEEPEST) throw new Refusal(`The YAML file is nested more than ${DEEPEST} deep.`);
  if (plain === undefined || plain === null) return null;
  if (typeof plain === "string" || typeof plain === "number" || typeof plain === "boolean" || typeof plain === "bigint")
    return plain;
  if (Array.isArray(plain)) return new List(plain.map(item => valueOf(item, depth + 1)));
  if (plain instanceof Map)
    return new Dict(
      new Map([...plain].map(([key, item]) => [keyOf(valueOf(key, depth + 1)), valueOf(item, depth + 1)])),
    );
  throw new Refusal("The YAML file holds a value that is neither a number, a text, a list nor a dictionary.");
}
