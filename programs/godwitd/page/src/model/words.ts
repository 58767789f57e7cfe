// The words in which the page says what godwitd says by name. Pure. What has no word here is said as it came.

import type { heard_aircraft, known_mission, object_on_map, objects_view, traffic_update, way_home_update } from "./messages.ts";

export type tone = "calm" | "good" | "warn" | "bad" | "none";

interface said {
  words: string;
  tone: tone;
}

const authorities: Record<string, said> = {
  godwit: { words: "godwit", tone: "good" },
  person: { words: "a person", tone: "warn" },
  failsafe: { words: "godwit's failsafe", tone: "bad" },
  autopilot_end: { words: "the autopilot, after its plan", tone: "warn" },
  autopilot_failsafe: { words: "the autopilot's failsafe", tone: "bad" },
  unclear: { words: "not known", tone: "bad" },
  nobody: { words: "nobody: no flight", tone: "none" },
};

// Who has the vehicle.
export function authority_words(holder: string | undefined): said {
  if (holder === undefined) return { words: "not heard yet", tone: "none" };
  return authorities[holder] ?? { words: holder, tone: "warn" };
}

const phase_tones: Record<string, tone> = {
  disconnected: "warn", connected: "calm", preflight: "calm", ready: "good", flying: "good", pausing: "warn", paused: "warn",
  returning: "warn", done: "good", aborted: "bad",
};

export function phase_tone(phase: string | undefined): tone {
  return phase_tones[phase ?? ""] ?? "calm";
}

// Where a mission stands; of one that has ended how.
export function mission_words(mission: known_mission): said {
  switch (mission.place) {
    case "prepared": return { words: "prepared", tone: mission.reason === "" ? "good" : "warn" };
    case "in_flight": return { words: "flown now", tone: "calm" };
    case "waiting": return { words: "waits", tone: "warn" };
    case "ended": return { words: mission.outcome || "over", tone: mission.outcome === "complete" ? "good" : "warn" };
    case "left": return { words: "left before its end", tone: "none" };
    case "refused": return { words: "refused", tone: "bad" };
    default: return { words: plain(mission.place), tone: "none" };
  }
}

const origins: Record<string, string> = { service: "missions service", file: "file at the start", upload: "upload",
  station: "ground station", unknown: "–" };

export function origin_words(origin: string): string {
  return origins[origin] ?? plain(origin);
}

// What the way home needs of the battery, beside what is left of it.
export function way_home_words(view: way_home_update | undefined): { value: string; unit: string; more: string; is_short: boolean } {
  if (view === undefined) return { value: "–", unit: "", more: "", is_short: false };
  if (view.needs_percent === null) return { value: "not known", unit: "", more: view.why_not_known, is_short: false };
  const { spare_percent } = view;
  const is_short = spare_percent !== null && spare_percent <= 0;
  const more = is_short ? `the battery lasts just for it, above ${view.reserve_percent} %`
    : spare_percent === null ? "" : `${Math.floor(spare_percent)} % to spare above ${view.reserve_percent} %`;
  return { value: `needs ${Math.ceil(view.needs_percent)}`, unit: "%", more, is_short };
}

// An aircraft on the map: "SWR123 +60 m, 2 s".
export function aircraft_words(each: heard_aircraft): string {
  const height = each.height_m === null ? "height not known" : `${each.height_m < 0 ? "−" : "+"}${distance_words(Math.abs(each.height_m))}`;
  return `${each.name} ${height}, ${Math.round(each.age_s)} s`;
}

// The nearest aircraft that is close, or else the nearest, after what the autopilot warns of.
export function traffic_words(view: traffic_update | undefined): { value: string; more: string; is_close: boolean } {
  const nearest = view?.aircraft.find((each) => each.is_close) ?? view?.aircraft[0];
  const more = [...(view?.warnings ?? []), ...(nearest === undefined ? [] : [nearest.sentence])].join("; ");
  const is_close = view !== undefined && (view.warnings.length > 0 || view.aircraft.some((each) => each.is_close));
  return { value: nearest === undefined ? "none heard" : is_close ? "close" : `${view?.aircraft.length} heard`, more, is_close };
}

// An object of the map, for who points at it.
export function object_words(each: object_on_map): string {
  const seen = new Date(each.last_seen_ms).toISOString();
  return `${plain(each.class_group)}, ${Math.round(100 * each.confidence)} %, seen ${seen.slice(0, 10)} ${seen.slice(11, 19)} UTC${each.is_seen_here ? "" : ", of the map that was pulled"}`;
}

// What is not drawn of what lies there; empty: all of it is.
export function left_out_words(view: objects_view | undefined): string {
  if (view === undefined || (view.is_all && view.objects.length >= view.counted)) return "";
  const count = view.counted.toLocaleString("en");
  return `${view.objects.length} of ${view.is_all ? count : `more than ${count}`} objects are drawn, the newest; zoom in for the rest`;
}

export function plain(name: string): string {
  return name.replaceAll("_", " ");
}

const fixes = ["no receiver", "no fix", "2D", "3D", "DGPS", "RTK float", "RTK fixed", "static", "PPP"];

export function fix_words(fix: number): string {
  return fixes[fix] ?? `fix ${fix}`;
}

export function age_words(age_ms: number): string {
  if (!Number.isFinite(age_ms)) return "never heard";
  const seconds = Math.floor(age_ms / 1000);
  if (seconds < 60) return `${seconds} s old`;
  if (seconds < 3600) return `${Math.floor(seconds / 60)} min ${seconds % 60} s old`;
  return `${Math.floor(seconds / 3600)} h ${Math.floor(seconds / 60) % 60} min old`;
}

export function duration_words(ms: number): string {
  const seconds = Math.max(0, Math.floor(ms / 1000));
  if (seconds < 60) return `${seconds} s`;
  if (seconds < 3600) return `${Math.floor(seconds / 60)} min`;
  return `${Math.floor(seconds / 3600)} h ${Math.floor(seconds / 60) % 60} min`;
}

export function time_words(at_ms: number): string {
  return new Date(at_ms).toISOString().slice(11, 19);
}

export function number_words(value: number | null | undefined, digits: number): string {
  return value === null || value === undefined || !Number.isFinite(value) ? "–" : value.toFixed(digits);
}

export function distance_words(metres: number): string {
  return metres < 1000 ? `${Math.round(metres)} m` : `${(metres / 1000).toFixed(2)} km`;
}
