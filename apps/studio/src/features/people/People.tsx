import type { Person } from "@twincell/protocol";
import { Copy, KeyRound, Link, LogOut, UserMinus } from "lucide-react";
import { useCallback, useEffect, useState } from "react";
import { useStore } from "zustand";
import { addPasskey, listPeople, putPerson, removePerson, signOut, type Asked } from "../../runtime/session.ts";
import { closeDialog, dialogStore } from "../../stores/dialogs.ts";
import { notify } from "../../stores/notices.ts";
import { sessionStore } from "../../stores/session.ts";
import { Frame } from "../../ui/Frame.tsx";
import { words } from "../../messages/index.ts";
import "./people.css";

type Role = Person["role"];
const ROLES = ["viewer", "programmer", "operator", "admin"] as const satisfies readonly Role[];

/** Who one is, and for admins who may do what. */
export default function People() {
  const open = useStore(dialogStore, state => state.open === "people");
  return (
    <Frame
      open={open}
      title={words.people.title}
      onClose={closeDialog}
      width={560}
      foot={<span className="grow small muted">{words.people.stopsAnyone}</span>}
    >
      {open && <Body />}
    </Frame>
  );
}

function Body() {
  const info = useStore(sessionStore, state => (state.state === "signed-in" ? state.info : null));
  if (!info?.name || !info.role) return <p className="muted">{words.people.noServer}</p>;
  const pass = (): void => {
    void addPasskey().then(sentence => {
      if (sentence === null) notify("done", words.people.passkeyAdded);
      else notify("bad", sentence);
    });
  };
  return (
    <div className="stack">
      <div className="row-flex people-row">
        <span className="grow">{words.people.you(info.name, words.people.roles[info.role])}</span>
        <button className="btn" onClick={pass}>
          <KeyRound />
          {words.people.addPasskey}
        </button>
        <button className="btn" onClick={() => void signOut()}>
          <LogOut />
          {words.people.signOut}
        </button>
      </div>
      {info.role === "admin" && <Everybody />}
    </div>
  );
}

function Everybody() {
  const [people, setPeople] = useState<readonly Person[]>([]);
  const [link, setLink] = useState<{ readonly name: string; readonly address: string } | null>(null);
  const refresh = useCallback((): void => {
    void listPeople().then(asked => {
      if (asked.kind === "answer") setPeople(asked.value.people);
      else notify("bad", asked.sentence);
    });
  }, []);
  useEffect(refresh, [refresh]);
  const act = <T,>(asked: Promise<Asked<T>>, then: (value: T) => void = () => undefined): void => {
    void asked.then(answer => {
      if (answer.kind === "answer") then(answer.value);
      else notify("bad", answer.sentence);
      refresh();
    });
  };
  const give = (name: string, role: Role, rights: Person["rights"], renew: boolean): void => {
    act(putPerson(name, { role, rights, renew }), ({ link: address }) => {
      if (address !== null) setLink({ name, address });
    });
  };
  return (
    <>
      {people.map(({ name, role, rights, invited }) => (
        <div key={name} className="row-flex people-row">
          <span className="grow">
            {name}
            {invited && <span className="small muted"> {words.people.waiting}</span>}
          </span>
          <RoleChoice
            label={words.people.role(name)}
            role={role}
            onChange={next => {
              give(name, next, rights, false);
            }}
          />
          <button
            className="btn icon"
            aria-label={words.people.renew(name)}
            onClick={() => {
              give(name, role, rights, true);
            }}
          >
            <Link />
          </button>
          <button
            className="btn icon"
            aria-label={words.people.remove(name)}
            onClick={() => {
              act(removePerson(name));
            }}
          >
            <UserMinus />
          </button>
        </div>
      ))}
      <Invite
        onInvite={(name, role) => {
          give(name, role, {}, true);
        }}
      />
      {link && <InvitationLink {...link} />}
    </>
  );
}

function RoleChoice({
  label,
  role,
  onChange,
}: {
  readonly label: string;
  readonly role: Role;
  readonly onChange: (role: Role) => void;
}) {
  return (
    <span className="field">
      <select
        aria-label={label}
        value={role}
        onChange={event => {
          onChange(ROLES.find(each => each === event.target.value) ?? role);
        }}
      >
        {ROLES.map(each => (
          <option key={each} value={each} title={words.people.rolesSay[each]}>
            {words.people.roles[each]}
          </option>
        ))}
      </select>
    </span>
  );
}

function Invite({ onInvite }: { readonly onInvite: (name: string, role: Role) => void }) {
  const [name, setName] = useState("");
  const [role, setRole] = useState<Role>("operator");
  return (
    <form
      className="row-flex people-row"
      onSubmit={event => {
        event.preventDefault();
        onInvite(name.trim(), role);
        setName("");
      }}
    >
      <span className="field text grow">
        <input
          aria-label={words.people.newName}
          placeholder={words.people.newName}
          value={name}
          onChange={event => {
            setName(event.target.value);
          }}
        />
      </span>
      <RoleChoice label={words.people.role(name || words.people.newName)} role={role} onChange={setRole} />
      <button className="btn primary" disabled={name.trim() === ""}>
        {words.people.invite}
      </button>
    </form>
  );
}

function InvitationLink({ name, address }: { readonly name: string; readonly address: string }) {
  return (
    <section className="stack">
      <p className="small">{words.people.link(name)}</p>
      <div className="row-flex people-row">
        <code className="grow people-link">{address}</code>
        <button
          className="btn icon"
          aria-label={words.people.copy}
          onClick={() => {
            void navigator.clipboard.writeText(address).then(
              () => notify("done", words.people.copied),
              () => notify("info", address),
            );
          }}
        >
          <Copy />
        </button>
      </div>
    </section>
  );
}
