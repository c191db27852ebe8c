/** What somebody may do in a shared cell: change it, write comments on steps, or look. */
export type EditingRight = "write" | "comment" | "look";

/** Where somebody is in a shared cell. */
export interface Presence {
  /** Name of the program they work on. */
  readonly program: string;
  /** What they selected: a step, an object, a frame by its id or name. */
  readonly selected: { readonly kind: string; readonly id: string } | null;
  /** Where they point [m, in the world]; null while they point nowhere. */
  readonly pointer_m: readonly [number, number, number] | null;
}
/** Somebody who is in, as the room numbers and names them. */
export interface Editor {
  readonly connection: number;
  readonly who: string;
  readonly presence: Presence | null;
}

/** What an editor says to the room of a cell. */
export type EditorMessage =
  /** First, and again to begin anew. `epoch` null or `vector` of nothing asks for everything. */
  | { readonly type: "join"; readonly epoch: string | null; readonly vector: Uint8Array }
  | { readonly type: "update"; readonly number: number; readonly update: Uint8Array }
  | { readonly type: "presence"; readonly presence: Presence };

export interface EditingRefusal {
  readonly code: string;
  readonly sentence: string;
  readonly hint: string;
}
/** What the room of a cell says to an editor. */
export type RoomMessage =
  | {
      readonly type: "joined";
      /** Another one than before: the document was made anew, and updates to the earlier one mean nothing. */
      readonly epoch: string;
      readonly connection: number;
      readonly who: string;
      readonly right: EditingRight;
      readonly update: Uint8Array;
      readonly vector: Uint8Array;
      readonly editors: readonly Editor[];
    }
  | { readonly type: "update"; readonly update: Uint8Array }
  | { readonly type: "accepted"; readonly number: number }
  /** Neither this update nor what was sent since is taken: the editor joins anew. */
  | { readonly type: "refused"; readonly number: number; readonly why: EditingRefusal }
  | { readonly type: "editor"; readonly editor: Editor }
  | { readonly type: "left"; readonly connection: number };
