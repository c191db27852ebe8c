import { CircleCheck, CircleHelp, TriangleAlert } from "lucide-react";
import { useEffect, useState } from "react";
import { useStore } from "zustand";
import {
  type DeviceFinding,
  type DeviceReport,
  type Latency,
  lookAtDevice,
  lookForCamera,
  measureLatency,
} from "../../runtime/device.ts";
import { closeDialog, dialogStore } from "../../stores/dialogs.ts";
import { Frame } from "../../ui/Frame.tsx";
import { fixed } from "../../messages/numbers.ts";
import { say, words } from "../../messages/index.ts";
import "./device.css";

const SAID = words.device;
const CHECKS = ["secure", "certificate", "headset", "camera", "graphics", "socket"] as const;
const STAGES = ["input", "render", "link", "controller"] as const;

/** What this device can do, what is missing and what to do about it; and how late things are, stage by stage. */
export default function DeviceCheck() {
  const open = useStore(dialogStore, state => state.open === "device");
  return (
    <Frame open={open} title={SAID.title} onClose={closeDialog} width={620}>
      {open && <Body />}
    </Frame>
  );
}

function Body() {
  const [report, setReport] = useState<DeviceReport>(lookAtDevice);
  const [latency, setLatency] = useState<Latency | null>(null);
  useEffect(() => {
    void lookForCamera();
    return measureLatency(measured => {
      setLatency(measured);
      setReport(lookAtDevice());
    });
  }, []);
  return (
    <div className="stack device">
      <ul className="device-checks" aria-label={SAID.checks}>
        {CHECKS.map(check => (
          <li key={check} data-finding={report[check]} data-check={check}>
            <Mark finding={report[check]} />
            <span>
              <b>{SAID.names[check]}</b>
              {report[check] === "missing" && (
                <span className="small">
                  {check === "headset" && report.headsetWhy !== "" ? say(report.headsetWhy) : SAID.missing[check]}
                </span>
              )}
            </span>
            <span className="small muted">{SAID.findings[report[check]]}</span>
          </li>
        ))}
      </ul>
      <section aria-label={SAID.latency}>
        <h3 className="label">{SAID.latency}</h3>
        <dl className="device-latency">
          {STAGES.map(stage => {
            const value = latency?.[`${stage}_ms`] ?? NaN;
            return (
              <div key={stage} data-stage={stage}>
                <dt>{SAID.stages[stage]}</dt>
                <dd>{Number.isNaN(value) ? SAID.notYet[stage] : SAID.ms(fixed(value, 1))}</dd>
              </div>
            );
          })}
        </dl>
      </section>
    </div>
  );
}

function Mark({ finding }: { readonly finding: DeviceFinding }) {
  return finding === "ok" ? (
    <CircleCheck aria-hidden />
  ) : finding === "missing" ? (
    <TriangleAlert aria-hidden />
  ) : (
    <CircleHelp aria-hidden />
  );
}
