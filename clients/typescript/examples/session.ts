/**
 * Opens a virtual robot, checks and plans a program, moves, streams its states and fetches its recording: node
 * session.ts http://127.0.0.1:7341 program.json
 */
import { readFileSync } from "node:fs";
import { Refused, Stopped, Twincell, type StreamEventOf } from "twincell-client";

const [url = "http://127.0.0.1:7341", file = "program.json"] = process.argv.slice(2);
const program = JSON.parse(readFileSync(file, "utf8")) as { readonly steps: readonly object[] };
const server = new Twincell(url);
// @ts-expect-error: what the server does not know is found by the compiler.
await server.check({ programme: program }).catch(() => undefined);
const verdict = await server.check({ program });
const plan = await server.plan({ program, period_s: 0.05 });
const arm = await server.open({ id: "arm", driver: "yaskawa", model: "yaskawa_gp8" });
const lease = await arm.lease({ who: "example" });
await lease.connect();
// A link that was slow while it was opened wants a person's word before anything moves.
for await (const event of arm.events()) {
  if (event.type !== "guard") continue;
  if (event.link === "up") break;
  if (event.link === "unconfirmed") await lease.confirm();
}

const seen: StreamEventOf<"sample">[] = [];
const enough = new AbortController();
const watching = (async () => {
  for await (const sample of arm.samples({ signal: enough.signal })) seen.push(sample);
})();
const target = [0.2, 0, 0, 0, 0, 0];
await lease.move(target);
const { sample } = await arm.state();

let refused = "";
await lease.move([9, 0, 0, 0, 0, 0]).catch((problem: unknown) => {
  if (!(problem instanceof Refused)) throw problem;
  refused = `${problem.message} ${problem.hint}`;
});
await lease.speed(5);
const ending = new AbortController();
const moving = lease.move([1.5, 0, 0, 0, 0, 0], { signal: ending.signal });
for await (const { moving: moves } of arm.samples()) if (moves) break;
await arm.stop();
const stopped = await moving.then(
  () => "",
  (problem: unknown) => (problem instanceof Stopped ? problem.code : String(problem)),
);
// A program is judged before anything moves: this one asks for an angle that the arm has not.
const bad = { ...program, steps: program.steps.map(step => ({ ...step, target: { q: [9, 0, 0, 0, 0, 0] } })) };
const judged = await lease.run(bad).then(
  () => "",
  (problem: unknown) => (problem instanceof Refused ? problem.code : String(problem)),
);
enough.abort();
await watching;
await lease.release();
await arm.close();

const [recording] = await server.recordings();
const bytes = recording ? await server.recording(recording.robot, recording.file) : new Uint8Array();
console.log(
  JSON.stringify({
    ok: verdict.ok,
    planned: plan.q_rad.length,
    off_rad: Math.max(...target.map((q, i) => Math.abs(q - (sample?.q_rad[i] ?? NaN)))),
    samples: seen.length,
    ordered: seen.every((each, i) => i === 0 || each.sequence > seen[i - 1]!.sequence),
    refused,
    stopped,
    judged,
    recorded: new TextDecoder().decode(bytes.subarray(1, 5)),
  }),
);
