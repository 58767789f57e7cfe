// The map: vehicle, its track, the plan with its progress, fences, home, the place of a go-to. Leaflet on one canvas;
// nothing of it is made anew while the vehicle moves, and no request goes to another host.
import * as L from "leaflet";
import { extent_of, is_place, items_of, way_of } from "../model/geometry.ts";
import type { shown_part } from "../model/geometry.ts";
import type { heard_aircraft, mission_document, object_on_map, place, plan_view, points_update, tile_view } from "../model/messages.ts";
import type { track } from "../model/track.ts";
import { aircraft_words, object_words } from "../model/words.ts";
import { metre_grid } from "./grid.ts";
import { arrow, fence_style, item_style, mark_icon, object_style, style_of } from "./styles.ts";

// Names come from missions: they stay text, whatever they look like.
function plain_text(words: string): HTMLElement {
  const result = document.createElement("span");
  result.textContent = words;
  return result;
}

const latlng = (at: place): L.LatLngTuple => [at.latitude, at.longitude];

export class chart {
  readonly map: L.Map;
  private readonly grid = new metre_grid();
  // What moves has a canvas of its own, and so has the track: neither it nor the plan, which may be a thousand places, is
  // drawn again with the vehicle.
  private readonly moving = L.canvas({ padding: 0.3, pane: "moving" });
  private readonly behind = L.canvas({ padding: 0.3, pane: "moving" });
  private readonly plan = L.layerGroup();
  private readonly going = L.layerGroup();
  private readonly points = L.layerGroup();
  private readonly objects = L.layerGroup();
  private readonly preview = L.layerGroup();
  private readonly aircraft = L.layerGroup();
  private readonly way: L.Polyline;
  private readonly way_open: L.Polyline;
  private readonly vehicle: L.Marker;
  private items: { index: number; mark: L.CircleMarker }[] = [];
  private track_seen = -1;
  private home: L.Marker | undefined;
  private is_placed = false;
  private has_seen_plan = false;
  private shown_done = -1;
  follows = true;

  constructor(where: HTMLElement, private readonly on_click: (at: place) => void, private readonly on_point: () => void,
    on_moved: () => void) {
    this.map = L.map(where, { renderer: L.canvas({ padding: 0.3 }), preferCanvas: true, zoomControl: false, maxZoom: 22,
      minZoom: 3, zoomSnap: 0.5, attributionControl: false, zoomAnimation: false, fadeAnimation: false,
      markerZoomAnimation: false, keyboard: true }).setView([0, 0], 3);
    const pane = this.map.createPane("grid");
    pane.style.zIndex = "250";
    this.map.createPane("moving").style.zIndex = "450";
    this.grid.addTo(this.map);
    L.control.zoom({ position: "topleft" }).addTo(this.map);
    L.control.scale({ imperial: false, maxWidth: 140, position: "bottomright" }).addTo(this.map);
    this.objects.addTo(this.map);
    this.plan.addTo(this.map);
    this.way = L.polyline([], style_of("track", { weight: 2, renderer: this.behind })).addTo(this.map);
    this.way_open = L.polyline([], style_of("track", { weight: 2, renderer: this.moving })).addTo(this.map);
    this.points.addTo(this.map);
    this.going.addTo(this.map);
    this.preview.addTo(this.map);
    this.aircraft.addTo(this.map);
    this.vehicle = L.marker([0, 0], { icon: mark_icon("vehicle", "vehicle"), interactive: false, keyboard: false,
      zIndexOffset: 1000 });
    this.map.on("click", (event) => on_click({ latitude: event.latlng.lat, longitude: event.latlng.lng }));
    this.map.on("moveend", on_moved);
    this.map.on("dragstart", () => { this.follows = false; });
    new ResizeObserver(() => this.map.invalidateSize({ animate: false })).observe(where);
  }

  show_vehicle(at: place, heading_deg: number | null, is_old: boolean): void {
    if (!this.map.hasLayer(this.vehicle)) this.vehicle.addTo(this.map);
    this.vehicle.setLatLng(latlng(at));
    const element = this.vehicle.getElement();
    element?.classList.toggle("old", is_old);
    const arrow = element?.querySelector<SVGElement>("svg");
    if (arrow !== null && arrow !== undefined) arrow.style.transform = `rotate(${heading_deg ?? 0}deg)`;
    if (!this.is_placed) this.fit([at]);
    if (this.follows && !this.map.getBounds().pad(-0.15).contains(latlng(at))) this.map.panTo(latlng(at), { animate: false });
  }

  show_track(of: track): void {
    if (this.track_seen !== of.changed) {
      this.track_seen = of.changed;
      this.way.setLatLngs(of.kept.map(latlng));
    }
    const from = of.kept.at(-1);
    if (from !== undefined && of.last !== undefined) this.way_open.setLatLngs([latlng(from), latlng(of.last)]);
  }

  // All that of the plan is drawn, anew: at each other plan, not with the vehicle.
  show_plan(view: plan_view): void {
    this.plan.clearLayers();
    this.items = [];
    this.shown_done = -1;
    const mission = view.mission;
    for (const fence of mission?.geofences ?? [])
      L.polygon(fence.vertices.map(latlng), fence_style(fence.kind)).addTo(this.plan);
    const way = way_of(view);
    if (way.length > 1) L.polyline(way.map(latlng), style_of("way", { weight: 2, dashArray: "6 5" })).addTo(this.plan);
    for (const item of mission === null ? [] : items_of(mission)) {
      const mark = L.circleMarker(latlng(item.at), item_style("open")).bindTooltip(
        plain_text(`${item.index + 1} ${item.id} (${item.kind})`), { direction: "top" });
      this.items.push({ index: item.index, mark });
      mark.addTo(this.plan);
    }
    const kept = is_place(view.kept) ? view.kept : mission?.return_point;
    if (is_place(kept)) L.marker(latlng(kept), { icon: mark_icon("return", "R"), interactive: false, keyboard: false }).addTo(this.plan);
    if (!this.has_seen_plan && way.length > 0) this.fit(extent_of(view, undefined));
    this.has_seen_plan ||= way.length > 0;
  }

  show_progress(items_done: number): void {
    if (items_done === this.shown_done) return;
    this.shown_done = items_done;
    const next = this.items.find((each) => each.index >= items_done)?.index;
    for (const { index, mark } of this.items)
      mark.setStyle(item_style(index < items_done ? "done" : index === next ? "next" : "open"));
  }

  show_home(at: place): void {
    this.grid.set_origin(at);
    if (this.home === undefined)
      this.home = L.marker(latlng(at), { icon: mark_icon("home", "H"), interactive: false, keyboard: false }).addTo(this.map);
    this.home.setLatLng(latlng(at));
  }

  // The grid counts from somewhere while no home is known.
  show_origin(at: place): void {
    if (this.home === undefined) this.grid.set_origin(at);
  }

  // Where a go-to or an insert would lead, through its TARGET; none: none is asked for.
  show_way(way: place[], target: place | undefined): void {
    this.going.clearLayers();
    if (target === undefined) return;
    if (way.length > 1)
      L.polyline(way.map(latlng), style_of("going", { weight: 3, dashArray: "2 6", renderer: this.moving })).addTo(this.going);
    L.circleMarker(latlng(target), style_of("going", { radius: 8, weight: 3, fill: false, renderer: this.moving })).addTo(this.going);
  }

  // Points of interest, with their numbers: at each change of them, and not with the vehicle. None: nothing is known of them.
  show_points(of: points_update | undefined): void {
    this.points.clearLayers();
    if (of === undefined) return;
    for (const how of ["confirmed", "shown"] as const)
      for (const each of of[how]) {
        const at = { latitude: each.latitude_deg, longitude: each.longitude_deg };
        L.marker(latlng(at), { icon: mark_icon(`point ${how}`, `<b>${Number(each.number)}</b>`), keyboard: false,
          zIndexOffset: how === "shown" ? 500 : 0 })
          .bindTooltip(plain_text(`point ${each.number}: ${each.class_group}`), { direction: "top" })
          .on("click", () => (this.map.getContainer().classList.contains("pointing") ? this.on_click(at) : this.on_point()))
          .addTo(this.points);
      }
  }

  // Other aircraft, once a second. Without a known course one has no arrow.
  show_aircraft(all: heard_aircraft[]): void {
    this.aircraft.clearLayers();
    for (const each of all) {
      const mark = L.marker([each.latitude_deg, each.longitude_deg], { interactive: false, keyboard: false,
        icon: mark_icon(`aircraft${each.is_close ? " close" : ""}`, each.course_deg === null ? "<b></b>" : arrow) })
        .bindTooltip(plain_text(aircraft_words(each)), { permanent: true, direction: "right", offset: [10, 0] }).addTo(this.aircraft);
      const shape = mark.getElement()?.querySelector<SVGElement>("svg");
      if (shape !== null && shape !== undefined) shape.style.transform = `rotate(${each.course_deg}deg)`;
    }
  }

  // Nothing before it was placed.
  shown_part(): shown_part | undefined {
    if (!this.is_placed) return undefined;
    const all = this.map.getBounds();
    return { west: all.getWest(), south: all.getSouth(), east: all.getEast(), north: all.getNorth() };
  }

  // What lies on the map, below all else: at each change of it, and not with the vehicle.
  show_objects(all: object_on_map[]): void {
    this.objects.clearLayers();
    for (const each of all)
      L.circleMarker([each.latitude_deg, each.longitude_deg], object_style(each.is_seen_here))
        .bindTooltip(() => plain_text(object_words(each)), { direction: "top" }).addTo(this.objects).bringToBack();
  }

  // A mission that was not handed over yet, in another colour; none: it is left.
  show_preview(mission: mission_document | undefined): void {
    this.preview.clearLayers();
    if (mission === undefined) return;
    for (const fence of mission.geofences) L.polygon(fence.vertices.map(latlng), fence_style(fence.kind)).addTo(this.preview);
    const way = items_of(mission).map((each) => each.at);
    L.polyline(way.map(latlng), style_of("going", { weight: 3, dashArray: "2 6" })).addTo(this.preview);
    for (const each of way) L.circleMarker(latlng(each), style_of("going", { radius: 5, weight: 2 })).addTo(this.preview);
    this.fit(way);
  }

  // Pictures of the map, out of a file on godwit's computer.
  show_tiles(of: tile_view): void {
    // Not below what the file has: a whole world of its smallest tiles would be millions.
    L.tileLayer("/tiles/{z}/{x}/{y}", { minZoom: of.min_zoom, maxNativeZoom: of.max_zoom, maxZoom: 22, zIndex: 1 }).addTo(this.map);
    if (of.attribution !== "")
      L.control.attribution({ prefix: false, position: "bottomright" }).addTo(this.map).addAttribution(plain_text(of.attribution).innerHTML);
  }

  // The next click is meant as a place.
  set_pointing(is_pointing: boolean): void {
    this.map.getContainer().classList.toggle("pointing", is_pointing);
  }

  fit(places: place[]): void {
    if (places.length === 0) return;
    this.is_placed = true;
    this.map.invalidateSize({ animate: false }); // the window may have another size than it was told
    this.map.fitBounds(L.latLngBounds(places.map(latlng)).pad(0.12), { maxZoom: 18.5, animate: false });
  }

  set_theme(): void {
    this.way.setStyle(style_of("track", { weight: 2 }));
    this.way_open.setStyle(style_of("track", { weight: 2 }));
    this.grid.draw();
  }
}
