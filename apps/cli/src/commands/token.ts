import { addToken, readTokens, removeToken, ROLES, type Role } from "@twincell/server";
import { given } from "../io/arguments.ts";
import { UseFault, type Command } from "../io/usage.ts";

export const tokenCommand: Command = {
  name: "token",
  summary: "named tokens with a role, for programs that ask a server",
  usage: `twincell token add NAME --role viewer|programmer|operator|admin --data DIR [--days N]
twincell token list --data DIR
twincell token remove NAME --data DIR

The server of that data folder knows them at once. A token is sent as the header "authorization: Bearer TOKEN"; what it does is written down
under its name (twincell audit). It is printed once and never kept: only its hash is.

  --role R     viewer looks; programmer also changes programs and cells; operator also commands robots; admin does all. Anyone may stop
  --days N     the token ends after so many days (default: it does not end)
  --data DIR   the data folder of the server`,
  run(args) {
    const options = given(args, {
      role: { type: "string" },
      data: { type: "string" },
      days: { type: "string" },
      json: { type: "boolean" },
    });
    const [verb, name, ...more] = options.positionals;
    const data = options.text("data");
    if (data === undefined) throw new UseFault("--data is missing.", "Give the data folder of the server.");
    if (more.length > 0) throw new UseFault(`token takes no argument "${more[0]}".`);
    try {
      return Promise.resolve(carryOut(verb, name, data, options.text("role"), options.number("days")));
    } catch (problem) {
      if (problem instanceof UseFault) throw problem;
      throw new UseFault((problem as Error).message);
    }
  },
};

function carryOut(
  verb: string | undefined,
  name: string | undefined,
  data: string,
  role: string | undefined,
  days: number | undefined,
): number {
  if (verb === "list") {
    for (const { name: who, role: may, until } of readTokens(data))
      process.stdout.write(`${JSON.stringify({ name: who, role: may, until })}\n`);
    return 0;
  }
  if (verb !== "add" && verb !== "remove") throw new UseFault(`token knows add, list and remove, not "${verb ?? ""}".`);
  if (name === undefined || !/^[\p{L}\p{N}][\p{L}\p{N} ._@-]{0,59}$/u.test(name))
    throw new UseFault("NAME is missing or no name.", "Letters, digits, spaces and . _ @ -, at most 60.");
  if (verb === "remove") {
    if (removeToken(data, name)) return 0;
    process.stderr.write(`twincell: there is no token of ${name}.\n`);
    return 1;
  }
  if (!ROLES.includes(role as Role)) throw new UseFault(`--role wants ${ROLES.join(", ")}, not "${role ?? ""}".`);
  if (days !== undefined && !(days > 0 && days <= 3650))
    throw new UseFault(`--days wants more than 0 and up to 3650, not ${days}.`);
  const token = addToken(
    data,
    name,
    role as Role,
    days === undefined ? null : new Date(Date.now() + days * 86_400_000),
  );
  if (token === null) {
    process.stderr.write(`twincell: there is a token of ${name} already; remove it first.\n`);
    return 1;
  }
  process.stdout.write(`${token}\n`);
  process.stderr.write("Keep it now: it is not shown again.\n");
  return 0;
}
