// How the things of the map look: colours come from the style sheet, so that sunlight and night have their own.
import * as L from "leaflet";

export function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--map-${name}`).trim();
}

export function style_of<Options extends L.PathOptions>(name: string, more: Options): Options {
  return { color: colour(name), interactive: false, ...more };
}

export function fence_style(kind: "INCLUSION" | "EXCLUSION"): L.PolylineOptions {
  const keeps_in = kind === "INCLUSION";
  const name = keeps_in ? "inside" : "outside";
  return { color: colour(name), weight: 2, fill: !keeps_in, fillColor: colour(name), fillOpacity: 0.18,
    dashArray: keeps_in ? "10 4" : "", interactive: false };
}

export function item_style(how: "open" | "next" | "done"): L.CircleMarkerOptions {
  return { radius: how === "next" ? 7 : 5, weight: 2, color: colour(how === "next" ? "next" : "way"),
    fillColor: how === "done" ? colour("way") : colour("paper"), fillOpacity: 1 };
}

export function object_style(is_seen_here: boolean): L.CircleMarkerOptions {
  return { radius: 4, weight: 1, color: colour("paper"), fillColor: colour(is_seen_here ? "object-here" : "object"), fillOpacity: 0.9 };
}

export const arrow = `<svg viewBox="-16 -16 32 32" width="32" height="32" aria-hidden="true">
  <path d="M0 -13 L9 11 L0 6 L-9 11 Z"/></svg>`;

export function mark_icon(name: string, text: string): L.DivIcon {
  const size = name === "vehicle" ? 32 : 20;
  return L.divIcon({ className: `mark mark-${name}`, html: name === "vehicle" ? arrow : text, iconSize: [size, size],
    iconAnchor: [size / 2, size / 2] });
}
