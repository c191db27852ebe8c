import { compose, identity, robotById, type Pose } from "@twincell/core";
import { useEffect, useState } from "react";
import { useStore } from "zustand";
import { lookForServer } from "../../runtime/robot/station-hosts.ts";
import { addStation } from "../../runtime/robot/stations.ts";
import { cellStore } from "../../stores/cell.ts";
import { connectionStore } from "../../stores/connection.ts";
import { closeDialog, dialogStore } from "../../stores/dialogs.ts";
import { notify } from "../../stores/notices.ts";
import { sessionStore } from "../../stores/session.ts";
import { stationStore, type ServerAddress } from "../../stores/stations.ts";
import { Chooser, Segments } from "../../ui/Choice.tsx";
import { Frame } from "../../ui/Frame.tsx";
import { NumberField } from "../../ui/NumberField.tsx";
import { DRIVER_LIST } from "../../runtime/robot/driver-list.ts";
import { words } from "../../messages/index.ts";
import "./stations.css";

export default function AddStation() {
  const open = useStore(dialogStore, state => state.open === "station");
  return open ? <Open /> : null;
}

const numbersOf = (text: string): number[] =>
  text
    .split(/[\s,;]+/)
    .filter(part => part !== "")
    .map(Number);

/** Beside the robot of the cell, and beside those that are there already. */
const APART_M = 1.6;

function Open() {
  const document = useStore(cellStore, state => state.document);
  const count = useStore(stationStore, state => state.stations.length);
  const server = useStore(stationStore, state => state.server);
  const training = useStore(sessionStore, state => state.info?.training === true);
  const connected = useStore(connectionStore, state => state.station !== null);
  // First of all the robot that stands in the cell is connected.
  const [brand, setBrand] = useState(
    () =>
      (connected
        ? undefined
        : DRIVER_LIST.find(({ robots: of }) => of.some(({ id }) => id === document?.robot.id))?.id) ??
      DRIVER_LIST[0]?.id ??
      "",
  );
  const [beside, setBeside] = useState(false);
  const [robot, setRobot] = useState(document?.robot.id ?? "");
  const [wanted, setPlace] = useState<ServerAddress>(dialogStore.getState().real ? "server" : "page");
  const [host, setHost] = useState("");
  const [x_m, setX] = useState(0);
  const [y_m, setY] = useState((count + 1) * APART_M);
  const [turned_rad, setTurned] = useState(0);
  const [busy, setBusy] = useState(false);
  const [port, setPort] = useState("");
  const [purpose, setPurpose] = useState<"command" | "watch">("command");
  const [typed, setTyped] = useState<Readonly<Record<string, string>>>({});
  useEffect(() => {
    lookForServer();
  }, []);
  const chosen = DRIVER_LIST.find(({ id }) => id === brand);
  const robots = chosen?.robots ?? [];
  const robotId = robots.find(({ id }) => id === robot)?.id ?? robots[0]?.id ?? "";
  // A driver that is a process of its own has nothing to show in a page: it is reached through the server.
  const isPlugIn = chosen?.port !== null && chosen !== undefined;
  const place: ServerAddress = isPlugIn ? "server" : training ? "page" : wanted;
  const number = Number(port === "" ? chosen?.port : port);
  const portFits = !isPlugIn || (Number.isInteger(number) && number > 0 && number < 65_536);
  const asked = place === "server" ? (chosen?.data ?? []) : [];
  const data = Object.fromEntries(asked.map(({ id, usual }) => [id, numbersOf(typed[id] ?? usual?.join(" ") ?? "")]));
  const whole = asked.every(
    ({ id, count }) =>
      data[id]!.length === (count ?? robotById(robotId)?.arm.joints.length ?? 0) &&
      data[id]!.every(value => Number.isFinite(value) && value !== 0),
  );
  if (!document) return null;
  const mayBeCell = !connected && robotId === document.robot.id;
  const ofCell = mayBeCell && !beside;
  const add = async (): Promise<void> => {
    setBusy(true);
    const besideCell: Pose<"base", "base"> = {
      ...identity(),
      position: [x_m, y_m, 0],
      quaternion: [0, 0, Math.sin(turned_rad / 2), Math.cos(turned_rad / 2)],
    };
    const outcome = await addStation({
      brand,
      robot: robotId,
      place,
      ofCell,
      stand: ofCell ? document.robot.worldFromBase : compose(document.robot.worldFromBase, besideCell),
      watch: purpose === "watch",
      ...(place === "server"
        ? {
            address: {
              host: host.trim(),
              ...(asked.length > 0 ? { data } : {}),
              ...(isPlugIn ? { ports: { [brand]: number } } : {}),
            },
          }
        : {}),
    });
    setBusy(false);
    if (outcome.kind === "done") closeDialog();
    else notify("bad", outcome.why.sentence, outcome.why.hint);
  };
  return (
    <Frame
      open
      title={words.stations.addTitle}
      onClose={closeDialog}
      width={520}
      foot={
        <>
          <span className="grow small muted">{words.app.notSafety}</span>
          <button
            type="submit"
            form="add-station"
            className="btn primary"
            disabled={
              busy ||
              robotId === "" ||
              (place === "server" && (server !== true || training || host.trim() === "" || !whole || !portFits))
            }
          >
            {busy ? words.stations.connecting : words.stations.addAndConnect}
          </button>
        </>
      }
    >
      <form
        id="add-station"
        className="add-station stack"
        onSubmit={event => {
          event.preventDefault();
          void add();
        }}
      >
        <div className="pair">
          <span className="label">{words.stations.brand}</span>
          <Chooser
            label={words.stations.brand}
            value={brand}
            onChange={setBrand}
            options={DRIVER_LIST.map(({ id, name }) => ({ value: id, words: name }))}
          />
        </div>
        <div className="pair">
          <span className="label">{words.stations.robot}</span>
          <Chooser
            label={words.stations.robot}
            value={robotId}
            onChange={setRobot}
            options={robots.map(({ id, name }) => ({ value: id, words: name }))}
          />
        </div>
        {mayBeCell && (
          <div className="pair">
            <span className="label">{words.connection.as}</span>
            <Segments
              label={words.connection.as}
              value={beside ? "beside" : "cell"}
              onChange={value => setBeside(value === "beside")}
              options={[
                { value: "cell", words: words.connection.ofCell },
                { value: "beside", words: words.connection.beside },
              ]}
            />
          </div>
        )}
        <div className="pair">
          <span className="label">{words.stations.where}</span>
          <Segments
            label={words.stations.where}
            value={place}
            onChange={setPlace}
            options={[
              { value: "page", words: words.stations.here, disabled: isPlugIn },
              { value: "server", words: words.stations.there, disabled: server !== true || training },
            ]}
          />
        </div>
        {training && (
          <p className="small training-lock" role="note">
            {words.stations.training} {words.stations.trainingHint}
          </p>
        )}
        {server === false && (
          <p className="small muted">
            {words.stations.noServer} {words.stations.noServerHint}
          </p>
        )}
        {place === "server" && (
          <div className="pair">
            <label className="label" htmlFor="station-address">
              {words.stations.address}
            </label>
            <span className="field text">
              <input
                id="station-address"
                value={host}
                placeholder={words.stations.addressHint}
                spellCheck={false}
                autoComplete="off"
                onChange={event => setHost(event.currentTarget.value)}
              />
            </span>
          </div>
        )}
        {isPlugIn && (
          <div className="pair">
            <label className="label" htmlFor="station-port">
              {words.stations.portLabel}
            </label>
            <span className="field text" data-fault={!portFits}>
              <input
                id="station-port"
                inputMode="numeric"
                value={port}
                placeholder={String(chosen.port)}
                autoComplete="off"
                aria-invalid={!portFits}
                onChange={event => setPort(event.currentTarget.value.trim())}
              />
            </span>
          </div>
        )}
        {isPlugIn && <p className="small muted">{portFits ? words.stations.plugInHint : words.stations.portWrong}</p>}
        <div className="pair">
          <span className="label">{words.stations.purpose}</span>
          <Segments
            label={words.stations.purpose}
            value={purpose}
            onChange={setPurpose}
            options={(["command", "watch"] as const).map(value => ({ value, words: words.stations.purposes[value] }))}
          />
        </div>
        {purpose === "watch" && <p className="small muted">{words.stations.purposeHint}</p>}
        {asked.map(({ id, name, where, count, usual }) => (
          <div className="pair" key={id}>
            <label className="label" htmlFor={`station-${id}`}>
              {name}
              <span className="small dim block">{where}</span>
            </label>
            <span className="field text">
              <input
                id={`station-${id}`}
                value={typed[id] ?? usual?.join(" ") ?? ""}
                placeholder={count === 1 ? "" : words.stations.numbers}
                spellCheck={false}
                autoComplete="off"
                onChange={event => setTyped({ ...typed, [id]: event.currentTarget.value })}
              />
            </span>
          </div>
        ))}
        {!ofCell && (
          <div className="pair">
            <span className="label">{words.stations.stand}</span>
            <span className="fields-3">
              <NumberField
                label={words.stations.x}
                mark="X"
                quantity="length"
                value={x_m}
                decimals={0}
                onChange={setX}
              />
              <NumberField
                label={words.stations.y}
                mark="Y"
                quantity="length"
                value={y_m}
                decimals={0}
                onChange={setY}
              />
              <NumberField
                label={words.stations.turned}
                mark="Rz"
                quantity="angle"
                value={turned_rad}
                decimals={0}
                onChange={setTurned}
              />
            </span>
          </div>
        )}
      </form>
    </Frame>
  );
}
