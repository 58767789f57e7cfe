// A grid of metres under the map, counted from an origin: east and north lines each 1, 2 or 5 times a power of ten, with
// their distances at the edge. It is there with and without tiles, and needs no network.
import * as L from "leaflet";
import { moved, offset_of, round_step_m } from "../model/geometry.ts";
import type { place } from "../model/messages.ts";

const wanted_px = 90; // between two lines

export class metre_grid extends L.Layer {
  private canvas: HTMLCanvasElement | undefined;
  private origin: place | undefined;

  set_origin(at: place): void {
    if (this.origin?.latitude === at.latitude && this.origin.longitude === at.longitude) return;
    this.origin = at;
    this.draw();
  }

  override onAdd(map: L.Map): this {
    this.canvas = L.DomUtil.create("canvas", "grid", map.getPane("grid"));
    this.canvas.setAttribute("aria-hidden", "true");
    map.on("move zoom viewreset resize zoomend moveend", this.draw, this);
    this.draw();
    return this;
  }

  override onRemove(map: L.Map): this {
    map.off("move zoom viewreset resize zoomend moveend", this.draw, this);
    this.canvas?.remove();
    return this;
  }

  draw(): void {
    const map = this._map as L.Map | undefined;
    const pen = this.canvas?.getContext("2d");
    if (map === undefined || this.canvas === undefined || pen === null || pen === undefined) return;
    const size = map.getSize();
    const scale = window.devicePixelRatio || 1;
    L.DomUtil.setPosition(this.canvas, map.containerPointToLayerPoint([0, 0]));
    this.canvas.width = size.x * scale;
    this.canvas.height = size.y * scale;
    this.canvas.style.width = `${size.x}px`;
    this.canvas.style.height = `${size.y}px`;
    if (this.origin === undefined) return;
    pen.scale(scale, scale);
    this.draw_lines(map, pen, size, this.origin);
  }

  private draw_lines(map: L.Map, pen: CanvasRenderingContext2D, size: L.Point, origin: place): void {
    const corner = (x: number, y: number) => {
      const at = map.containerPointToLatLng([x, y]);
      return offset_of(origin, { latitude: at.lat, longitude: at.lng });
    };
    const from = corner(0, size.y);
    const to = corner(size.x, 0);
    const step = round_step_m(((to.east_m - from.east_m) / size.x) * wanted_px);
    const style = getComputedStyle(map.getContainer());
    const line = style.getPropertyValue("--grid").trim();
    const strong = style.getPropertyValue("--grid-strong").trim();
    pen.font = "11px system-ui, sans-serif";
    pen.lineWidth = 1;
    const point = (east_m: number, north_m: number) => {
      const at = moved(origin, { east_m, north_m });
      return map.latLngToContainerPoint([at.latitude, at.longitude]);
    };
    const words = (metres: number) => (Math.abs(step) >= 1000 ? `${metres / 1000} km` : `${metres} m`);
    for (let east = Math.ceil(from.east_m / step) * step; east <= to.east_m; east += step) {
      const x = Math.round(point(east, from.north_m).x) + 0.5;
      stroke(pen, Math.abs(east) < step / 2 ? strong : line, x, 0, x, size.y);
      pen.fillStyle = style.getPropertyValue("--grid-text").trim();
      pen.fillText(words(Math.round(east)), x + 3, size.y - 4);
    }
    for (let north = Math.ceil(from.north_m / step) * step; north <= to.north_m; north += step) {
      const y = Math.round(point(from.east_m, north).y) + 0.5;
      stroke(pen, Math.abs(north) < step / 2 ? strong : line, 0, y, size.x, y);
      pen.fillStyle = style.getPropertyValue("--grid-text").trim();
      pen.fillText(words(Math.round(north)), 4, y - 3);
    }
  }
}

function stroke(pen: CanvasRenderingContext2D, colour: string, x1: number, y1: number, x2: number, y2: number): void {
  pen.strokeStyle = colour;
  pen.beginPath();
  pen.moveTo(x1, y1);
  pen.lineTo(x2, y2);
  pen.stroke();
}
