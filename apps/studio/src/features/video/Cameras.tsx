import { Camera, Copy, ExternalLink, MonitorSmartphone } from "lucide-react";
import { useEffect } from "react";
import { useStore } from "zustand";
import { listCameras } from "../../runtime/video/camera.ts";
import { panelId, showCamera } from "../../runtime/video/feeds.ts";
import { lookForCameras } from "../../runtime/video/server-feeds.ts";
import { closeDialog, dialogStore } from "../../stores/dialogs.ts";
import { notify } from "../../stores/notices.ts";
import { videoStore, type VideoSource } from "../../stores/video.ts";
import { Frame } from "../../ui/Frame.tsx";
import { words } from "../../messages/index.ts";
import { QrCode } from "./QrCode.tsx";
import "./video.css";

const CAMERA_PAGE = "camera/";

/** Which cameras there are, and how another one is added. */
export default function Cameras() {
  const open = useStore(dialogStore, state => state.open === "cameras");
  return (
    <Frame
      open={open}
      title={words.video.title}
      onClose={closeDialog}
      width={560}
      foot={<span className="grow small muted">{words.video.noSafety}</span>}
    >
      {open && <Body />}
    </Frame>
  );
}

function Body() {
  const { cameras, devices, links, server, sentence } = useStore(videoStore);
  useEffect(() => {
    lookForCameras();
    void listCameras().then(found => {
      videoStore.setState({ devices: found });
    });
  }, []);
  const here = devices.length > 0 ? devices : [{ device: "", name: words.video.here }];
  return (
    <div className="stack cameras">
      <section aria-label={words.video.other}>
        <h3 className="label">{words.video.other}</h3>
        {server !== "open" && (
          <p className="small muted" role="status">
            {words.video.server[server]} {sentence}
          </p>
        )}
        {server === "open" && cameras.length === 0 && <p className="small muted">{words.video.noneServer}</p>}
        {cameras.map(({ camera, name }) => (
          <Row key={camera} name={name} source={{ kind: "server", name }} />
        ))}
      </section>
      <section aria-label={words.video.here}>
        <h3 className="label">{words.video.here}</h3>
        {here.map(({ device, name }) => (
          <Row key={device} name={name} source={{ kind: "here", device }} />
        ))}
        <p className="small muted">{words.video.hereSays}</p>
      </section>
      <section aria-label={words.video.phone}>
        <h3 className="label">{words.video.phone}</h3>
        {links.length === 0 ? (
          <p className="small muted">{words.video.phoneAlone}</p>
        ) : (
          <p className="small">{words.video.phoneSays}</p>
        )}
        {links.map(link => (
          <Address key={link} link={link} />
        ))}
        <p className="small muted">
          {words.video.sameMachine}{" "}
          <a className="video-open" href={CAMERA_PAGE} target="_blank" rel="noreferrer">
            <ExternalLink />
            {words.video.cameraPage}
          </a>
        </p>
      </section>
    </div>
  );
}

function Row({ name, source }: { readonly name: string; readonly source: VideoSource }) {
  const shown = useStore(videoStore, state => state.panels.some(panel => panel.id === panelId(source)));
  return (
    <div className="row-flex camera-row">
      {source.kind === "here" ? <Camera /> : <MonitorSmartphone />}
      <span className="grow">{name}</span>
      <button
        className="btn"
        disabled={shown}
        aria-label={`${words.video.show}: ${name}`}
        onClick={() => {
          showCamera(source, name);
          closeDialog();
        }}
      >
        {shown ? words.video.shown : words.video.show}
      </button>
    </div>
  );
}

function Address({ link }: { readonly link: string }) {
  const copy = (): void => {
    void navigator.clipboard.writeText(link).then(
      () => notify("done", words.video.copied),
      () => notify("info", link),
    );
  };
  return (
    <div className="camera-address">
      <QrCode text={link} label={words.video.qr(link)} />
      <span className="camera-link">{link}</span>
      <button className="btn icon" aria-label={words.video.copy} onClick={copy}>
        <Copy />
      </button>
    </div>
  );
}
