import { soundStore, type Sound, type SoundState } from "../../stores/sound.ts";
import { viewStore } from "../../stores/view.ts";

/** One short tone: frequency glides from → to [Hz] while it fades. */
interface Tone {
  readonly shape: OscillatorType;
  readonly from_Hz: number;
  readonly to_Hz: number;
  readonly start_s: number;
  readonly duration_s: number;
  readonly gain: number;
}
const TONES: Readonly<Record<Sound, readonly Tone[]>> = {
  crash: [
    { shape: "sawtooth", from_Hz: 150, to_Hz: 45, start_s: 0, duration_s: 0.22, gain: 0.16 },
    { shape: "square", from_Hz: 90, to_Hz: 40, start_s: 0, duration_s: 0.12, gain: 0.1 },
  ],
  limit: [
    { shape: "triangle", from_Hz: 440, to_Hz: 415, start_s: 0, duration_s: 0.09, gain: 0.14 },
    { shape: "triangle", from_Hz: 440, to_Hz: 415, start_s: 0.14, duration_s: 0.09, gain: 0.14 },
  ],
  grip: [{ shape: "sine", from_Hz: 320, to_Hz: 180, start_s: 0, duration_s: 0.06, gain: 0.16 }],
  "link-lost": [{ shape: "triangle", from_Hz: 520, to_Hz: 260, start_s: 0, duration_s: 0.35, gain: 0.14 }],
  done: [
    { shape: "sine", from_Hz: 587, to_Hz: 587, start_s: 0, duration_s: 0.12, gain: 0.1 },
    { shape: "sine", from_Hz: 880, to_Hz: 880, start_s: 0.1, duration_s: 0.2, gain: 0.1 },
  ],
};

/** Plays what the sound store asks for. A browser that gives no audio stays silent; nothing else changes. */
export function startSounds(): () => void {
  let audio: AudioContext | null = null;
  return soundStore.subscribe((now, before) => {
    if (now.count === before.count || now.last === null || viewStore.getState().muted) return;
    audio ??= typeof AudioContext === "undefined" ? null : new AudioContext();
    if (!audio) return;
    const context = audio;
    // Before the first gesture a browser keeps audio suspended: a late warning helps nobody, so it is not queued.
    if (context.state === "suspended") void context.resume();
    const out = outletFor(context, now.from);
    for (const tone of TONES[now.last]) playTone(context, tone, out);
  });
}

/** Sounds are as loud as they are told up to here, and get quieter beyond [m]. */
const LOUD_WITHIN_M = 1;

/** Where the tone goes: to both ears alike, or as from that place before a listener who looks along −z. */
function outletFor(context: AudioContext, from: SoundState["from"]): AudioNode {
  if (from === null) return context.destination;
  const panner = new PannerNode(context, {
    panningModel: "HRTF",
    distanceModel: "inverse",
    refDistance: LOUD_WITHIN_M,
    positionX: from[0],
    positionY: from[1],
    positionZ: from[2],
  });
  panner.connect(context.destination);
  return panner;
}

function playTone(context: AudioContext, tone: Tone, out: AudioNode): void {
  const oscillator = context.createOscillator();
  const volume = context.createGain();
  const start = context.currentTime + tone.start_s;
  const end = start + tone.duration_s;
  oscillator.type = tone.shape;
  oscillator.frequency.setValueAtTime(tone.from_Hz, start);
  oscillator.frequency.exponentialRampToValueAtTime(tone.to_Hz, end);
  volume.gain.setValueAtTime(0.0001, start);
  volume.gain.exponentialRampToValueAtTime(tone.gain, start + 0.008);
  volume.gain.exponentialRampToValueAtTime(0.0001, end);
  oscillator.connect(volume).connect(out);
  oscillator.start(start);
  oscillator.stop(end + 0.02);
}
