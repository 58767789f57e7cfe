// The plots of the flight, three below each other with one time: altitude, speed, battery. They are made when their tab is
// opened, and drawn at most once a second.
import uPlot from "uplot";
import { colour } from "../map/styles.ts";
import type { flight_history } from "../model/history.ts";

const lines = [
  { label: "Altitude above home (m)", column: 1, colour: "way" },
  { label: "Speed (m/s)", column: 2, colour: "track" },
  { label: "Battery (%)", column: 3, colour: "inside" },
] as const;
const draw_ms = 1_000;
const height_px = 92;

export class plots {
  private made: uPlot[] = [];
  private where: HTMLElement | undefined;
  private theme = "";
  private drawn_at = 0;

  // WHERE: none while the tab is closed.
  show(where: HTMLElement | null, of: flight_history, theme: string, now: number): void {
    if (where === null) return this.forget();
    const width = where.clientWidth;
    if (where !== this.where || theme !== this.theme || this.made[0]?.width !== width) this.make(where, theme, width);
    else if (now - this.drawn_at < draw_ms) return;
    this.drawn_at = now;
    const columns = of.columns();
    lines.forEach((line, index) => this.made[index]?.setData([columns[0], columns[line.column]]));
  }

  private make(where: HTMLElement, theme: string, width: number): void {
    this.forget();
    this.where = where;
    this.theme = theme;
    const style = getComputedStyle(document.documentElement);
    const ink = style.getPropertyValue("--ink").trim();
    const rule = style.getPropertyValue("--rule").trim();
    const axis = { stroke: ink, grid: { stroke: rule, width: 1 }, ticks: { stroke: rule }, font: "11px system-ui, sans-serif" };
    this.made = lines.map((line) => new uPlot({ width, height: height_px, legend: { show: false }, title: line.label,
      cursor: { sync: { key: "flight" }, drag: { x: true, y: false } }, tzDate: (at) => uPlot.tzDate(new Date(at * 1000), "Etc/UTC"),
      axes: [{ ...axis, size: 24 }, { ...axis, size: 44 }],
      series: [{}, { label: line.label, stroke: colour(line.colour), width: 2, spanGaps: true }] }, [[], []], where));
  }

  private forget(): void {
    for (const each of this.made) each.destroy();
    this.made = [];
    this.where = undefined;
  }
}
