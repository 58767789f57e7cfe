// Two short tones: something needs a person. Browsers are silent until the page was touched once.
let context: AudioContext | undefined;

export function beep(): void {
  context ??= new AudioContext();
  if (context.state === "suspended") void context.resume().catch(() => undefined);
  for (const [begin_s, pitch_hz] of [[0, 880], [0.22, 660]] as const) {
    const tone = context.createOscillator();
    const volume = context.createGain();
    tone.frequency.value = pitch_hz;
    volume.gain.value = 0.15;
    tone.connect(volume).connect(context.destination);
    tone.start(context.currentTime + begin_s);
    tone.stop(context.currentTime + begin_s + 0.18);
  }
}
