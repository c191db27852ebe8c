import { KeyRound } from "lucide-react";
import { useState } from "react";
import { useStore } from "zustand";
import { acceptInvitation, signIn, signInByPasskey } from "../../runtime/session.ts";
import { sessionStore } from "../../stores/session.ts";
import { words } from "../../messages/index.ts";
import "./people.css";

/** Before everything else where the server asks who one is. */
export function SignIn() {
  const state = useStore(sessionStore, session => session.state);
  const invitation = useStore(sessionStore, session => session.invitation);
  if (state !== "signed-out") return null;
  return (
    <div className="sign-in" role="dialog" aria-modal="true" aria-label={words.people.signIn}>
      {invitation === null ? <ByPassword /> : <ByInvitation link={invitation} />}
    </div>
  );
}

function ByPassword() {
  const [name, setName] = useState("");
  const [password, setPassword] = useState("");
  const { sentence, busy, run } = useAnswer();
  return (
    <form
      className="sign-in-card stack"
      onSubmit={event => {
        event.preventDefault();
        run(() => signIn(name.trim(), password));
      }}
    >
      <h1>{words.people.signIn}</h1>
      <p className="small muted">{words.people.signInSays}</p>
      <Field label={words.people.name} value={name} onChange={setName} autoComplete="username" />
      <Field
        label={words.people.password}
        value={password}
        onChange={setPassword}
        autoComplete="current-password"
        secret
      />
      <Sentence text={sentence} />
      <button className="btn primary" disabled={busy || name.trim() === "" || password === ""}>
        {words.people.signIn}
      </button>
      <button type="button" className="btn" disabled={busy} onClick={() => run(signInByPasskey)}>
        <KeyRound />
        {words.people.passkey}
      </button>
    </form>
  );
}

function ByInvitation({ link }: { readonly link: string }) {
  const [name, setName] = useState("");
  const [password, setPassword] = useState("");
  const { sentence, busy, run } = useAnswer();
  return (
    <form
      className="sign-in-card stack"
      onSubmit={event => {
        event.preventDefault();
        run(() => acceptInvitation(link, name.trim(), password));
      }}
    >
      <h1>{words.people.welcome}</h1>
      <p className="small muted">{words.people.welcomeSays}</p>
      <Field
        label={words.people.name}
        value={name}
        onChange={setName}
        autoComplete="username"
        hint={words.people.nameHint}
      />
      <Field
        label={words.people.newPassword}
        value={password}
        onChange={setPassword}
        autoComplete="new-password"
        secret
      />
      <Sentence text={sentence} />
      <button className="btn primary" disabled={busy || password === ""}>
        {words.people.enter}
      </button>
    </form>
  );
}

/** Runs what answers with a sentence when it was refused. */
function useAnswer() {
  const [sentence, setSentence] = useState("");
  const [busy, setBusy] = useState(false);
  return {
    sentence,
    busy,
    run(ask: () => Promise<string | null>) {
      setBusy(true);
      setSentence("");
      void ask().then(said => {
        setSentence(said ?? "");
        setBusy(false);
      });
    },
  };
}
const Sentence = ({ text }: { readonly text: string }) => (
  <p className="small sign-in-sentence" role="alert">
    {text}
  </p>
);
function Field({
  label,
  value,
  onChange,
  autoComplete,
  secret = false,
  hint = "",
}: {
  readonly label: string;
  readonly value: string;
  readonly onChange: (value: string) => void;
  readonly autoComplete: string;
  readonly secret?: boolean;
  readonly hint?: string;
}) {
  return (
    <label className="stack sign-in-field">
      <span className="label">{label}</span>
      <span className="field text">
        <input
          type={secret ? "password" : "text"}
          value={value}
          placeholder={hint}
          autoComplete={autoComplete}
          onChange={event => {
            onChange(event.target.value);
          }}
        />
      </span>
    </label>
  );
}
