// The sound of touch in WebAudio: a tone and a band of noise, whose levels sound_levels.ts decides. Silent until asked
// for.

import type { Levels } from "./sound_levels";

/** Levels glide in this time constant, so that they do not click. */
const kGlide_s = 0.02;
const kNoise_s = 2;
const kSilence: Levels = { tone: 0, noise: 0, pitch_Hz: 110, band_Hz: 300 };

interface Nodes {
  readonly context: AudioContext;
  readonly tone: OscillatorNode;
  readonly toneGain: GainNode;
  readonly band: BiquadFilterNode;
  readonly noiseGain: GainNode;
}

export class Sound {
  private nodes_: Nodes | undefined;
  private on_ = false;

  get on(): boolean {
    return this.on_;
  }

  /** Browsers let a page sound only after a press of the user: this is to be called from one. */
  setOn(on: boolean): void {
    this.on_ = on;
    if (on) {
      this.nodes_ ??= makeNodes();
      void this.nodes_.context.resume();
    } else {
      this.show(kSilence);
      void this.nodes_?.context.suspend();
    }
  }

  show(levels: Levels): void {
    if (this.nodes_ === undefined) {
      return;
    }
    const { context, tone, toneGain, band, noiseGain } = this.nodes_;
    const glide = (parameter: AudioParam, value: number) => {
      parameter.setTargetAtTime(value, context.currentTime, kGlide_s);
    };
    glide(toneGain.gain, levels.tone);
    glide(tone.frequency, levels.pitch_Hz);
    glide(noiseGain.gain, levels.noise);
    glide(band.frequency, levels.band_Hz);
  }
}

function makeNodes(): Nodes {
  const context = new AudioContext();
  const tone = new OscillatorNode(context, { type: "triangle" });
  const toneGain = new GainNode(context, { gain: 0 });
  const buffer = new AudioBuffer({ length: kNoise_s * context.sampleRate, sampleRate: context.sampleRate });
  const samples = buffer.getChannelData(0);
  samples.forEach((_, i) => (samples[i] = 2 * Math.random() - 1));
  const noise = new AudioBufferSourceNode(context, { buffer, loop: true });
  const band = new BiquadFilterNode(context, { type: "bandpass", Q: 0.8 });
  const noiseGain = new GainNode(context, { gain: 0 });
  tone.connect(toneGain).connect(context.destination);
  noise.connect(band).connect(noiseGain).connect(context.destination);
  tone.start();
  noise.start();
  return { context, tone, toneGain, band, noiseGain };
}
