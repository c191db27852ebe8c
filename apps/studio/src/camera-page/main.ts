import { openCamera } from "../runtime/video/camera.ts";
import { startSender, type Sender } from "../runtime/video/sender.ts";
import { say, words as all } from "../messages/index.ts";
import "../tokens.css";
import "./camera-page.css";

const { camera: words, noSafety } = all.video;
document.title = `${words.which} · ${all.app.name}`;
const root = document.getElementById("root")!;

/** One element with its words. */
function make<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag,
  text = "",
  attributes: Readonly<Record<string, string>> = {},
): HTMLElementTagNameMap[Tag] {
  const element = document.createElement(tag);
  element.textContent = text;
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  return element;
}

/** The same for as long as this page lives, so that a new line takes the old one's place. */
const key = Array.from(crypto.getRandomValues(new Uint8Array(12)), byte => byte.toString(16).padStart(2, "0")).join("");
const asked = new URLSearchParams(location.search).get("name") ?? "";
const kept = localStorage.getItem("twincell.camera-name") ?? "";

const name = make("input", "", { id: "name", maxlength: "60", autocomplete: "off" });
name.value = (asked || kept || words.named).slice(0, 60);
const which = make("select", "", { id: "which" });
for (const [value, text] of [
  ["back", words.back],
  ["front", words.front],
] as const)
  which.append(make("option", text, { value }));
const button = make("button", words.start, { type: "button", class: "primary" });
const state = make("p", words.says, { role: "status", class: "state" });
const trouble = make("p", "", { role: "alert", class: "trouble" });
const stage = make("div", "", { class: "stage" });
const fields = make("div", "", { class: "fields" });
fields.append(make("label", words.name, { for: "name" }), name, make("label", words.which, { for: "which" }), which);
const foot = make("p", `${noSafety} ${words.awake}`, { class: "foot" });
root.append(make("h1", words.title), stage, state, trouble, fields, button, foot);

let sender: Sender | null = null;
let timer = 0;
let watchers = 0;
let line = "";
function showState(): void {
  const video = sender?.video;
  const count = sender?.takeCount() ?? 0;
  state.textContent = !sender
    ? words.says
    : line || `${words.watched(watchers)} ${video ? words.rate(count, video.videoWidth, video.videoHeight) : ""}`;
}
function stop(): void {
  clearInterval(timer);
  sender?.stop();
  sender = null;
  stage.replaceChildren();
  button.textContent = words.start;
  fields.hidden = false;
  showState();
}

async function start(): Promise<void> {
  trouble.textContent = "";
  button.disabled = true;
  const opened = await openCamera(which.value);
  button.disabled = false;
  if (opened.kind === "refused") {
    trouble.textContent = say(opened.sentence);
    return;
  }
  const shownAs = name.value.trim() || words.named;
  localStorage.setItem("twincell.camera-name", shownAs);
  line = words.connecting;
  sender = startSender(opened.stream, shownAs, key, {
    state(link, sentence) {
      line = link === "open" ? "" : (sentence && say(sentence)) || words.connecting;
      showState();
    },
    watchers(count) {
      watchers = count;
    },
    trouble(sentence) {
      trouble.textContent = say(sentence);
    },
  });
  stage.replaceChildren(sender.video);
  button.textContent = words.stop;
  fields.hidden = true;
  timer = window.setInterval(showState, 1000);
  showState();
  stayAwake();
}

/** A phone that sleeps takes no pictures. Not every browser can be asked. */
function stayAwake(): void {
  if ("wakeLock" in navigator)
    navigator.wakeLock.request("screen").catch(() => {
      trouble.textContent = words.awake;
    });
}
document.addEventListener("visibilitychange", () => {
  if (sender && document.visibilityState === "visible") stayAwake();
});
button.addEventListener("click", () => {
  if (sender) stop();
  else void start();
});
