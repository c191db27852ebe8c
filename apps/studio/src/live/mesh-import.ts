import { cellStore } from "../stores/cell.ts";
import { commit } from "../stores/document.ts";
import { notify } from "../stores/notices.ts";
import { select } from "../stores/selection.ts";
import { words } from "../words/index.ts";
import type { FromReader, ToReader } from "../workers/mesh-messages.ts";

/** Reads a mesh away from the page and stands it on the floor in front of the robot. */
export async function importMesh(name: string, kind: ToReader["kind"], bytes: Uint8Array<ArrayBuffer>): Promise<void> {
  const worker = new Worker(new URL("../workers/mesh.worker.ts", import.meta.url), { type: "module" });
  const answer = await new Promise<FromReader>(resolve => {
    worker.addEventListener("message", ({ data }: MessageEvent<FromReader>) => resolve(data));
    worker.addEventListener("error", event =>
      resolve({ kind: "not-understood", sentence: event.message || words.file.unreadable(name) }),
    );
    const message: ToReader = { kind, bytes };
    worker.postMessage(message, [bytes.buffer]);
  });
  worker.terminate();
  if (answer.kind === "not-understood") {
    notify("bad", words.file.notCell(name, answer.sentence), words.file.notCellHint);
    return;
  }
  const taken = new Set(cellStore.getState().document?.objects.map(object => object.id));
  const stem = name.replace(/\.[^.]*$/, "") || name;
  let id = stem;
  for (let n = 2; taken.has(id); n++) id = `${stem}-${n}`;
  commit(words.undo.addObject, document => ({
    ...document,
    objects: [
      ...document.objects,
      {
        id,
        name: id,
        role: "workpiece",
        worldFromObject: { position: [0.6, 0, -answer.lowest[2]], quaternion: [0, 0, 0, 1] },
        shape: { kind: "mesh", file: name, ...answer.encoded },
        color: "#9aa7b0",
      },
    ],
  }));
  select({ kind: "object", id });
  notify(
    answer.report.warnings.length > 0 ? "warn" : "done",
    words.file.mesh(name, answer.report.triangles),
    answer.report.warnings[0],
  );
}
