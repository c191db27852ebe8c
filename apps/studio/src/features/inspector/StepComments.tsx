import { Check, RotateCcw, Trash2 } from "lucide-react";
import { useState } from "react";
import { useStore } from "zustand";
import { cellStore } from "../../stores/cell.ts";
import { addComment, commentsOn, removeComment, setCommentDone } from "../../stores/comments.ts";
import { togetherStore } from "../../stores/together.ts";
import { moment } from "../../messages/numbers.ts";
import { words } from "../../messages/index.ts";

/** What people say about a step, and a field to say something. */
export function StepComments({ step }: { readonly step: string }) {
  const document = useStore(cellStore, state => state.document);
  const looks = useStore(togetherStore, state => state.right === "look" && state.state !== "off");
  const [text, setText] = useState("");
  const comments = commentsOn(document, document?.program ?? "", step);
  return (
    <section className="section stack comments" aria-label={words.together.comments}>
      {comments.map(({ id, who, at, text: said, done }) => (
        <article key={id} data-done={done === true} aria-label={words.together.commented(who)}>
          <header className="small muted">
            <span className="grow">
              {who} · {moment(Date.parse(at))}
            </span>
            {!looks && (
              <>
                <button
                  className="btn quiet icon tight"
                  aria-label={done ? words.together.again : words.together.done}
                  onClick={() => setCommentDone(id, done !== true)}
                >
                  {done ? <RotateCcw /> : <Check />}
                </button>
                <button
                  className="btn quiet icon tight"
                  aria-label={words.together.removeComment(who)}
                  onClick={() => removeComment(id)}
                >
                  <Trash2 />
                </button>
              </>
            )}
          </header>
          <p>{said}</p>
        </article>
      ))}
      {!looks && (
        <form
          className="row-flex"
          onSubmit={event => {
            event.preventDefault();
            if (addComment(step, text)) setText("");
          }}
        >
          <span className="field text grow">
            <input
              aria-label={words.together.comment}
              placeholder={words.together.comment}
              value={text}
              maxLength={2000}
              onChange={event => setText(event.currentTarget.value)}
            />
          </span>
          <button className="btn" disabled={text.trim() === ""}>
            {words.together.add}
          </button>
        </form>
      )}
    </section>
  );
}
