// Altitude, speed and battery over time, for the plots: a sample a second, and when the bound is reached every second one
// is left out and they come half as often. Pure.
export const max_samples = 3_600;

export interface sample {
  at_ms: number; // by the clock of godwitd
  altitude_m: number;
  speed_mps: number;
  battery_percent: number | null;
}

export class flight_history {
  samples: sample[] = [];
  private step_ms = 1_000;

  add(one: sample): void {
    const last = this.samples.at(-1);
    if (last !== undefined && one.at_ms < last.at_ms) this.samples = []; // the clock was set back
    else if (last !== undefined && one.at_ms - last.at_ms < this.step_ms) return;
    this.samples.push(one);
    if (this.samples.length <= max_samples) return;
    this.samples = this.samples.filter((_, index) => index % 2 === 0);
    this.step_ms *= 2;
  }

  clear(): void {
    this.samples = [];
    this.step_ms = 1_000;
  }

  // As uPlot takes it: seconds, then a row of values for each line.
  columns(): [number[], number[], number[], (number | null)[]] {
    return [this.samples.map((each) => each.at_ms / 1000), this.samples.map((each) => each.altitude_m),
      this.samples.map((each) => each.speed_mps), this.samples.map((each) => each.battery_percent)];
  }
}
