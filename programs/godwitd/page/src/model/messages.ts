// What godwitd says, as far as the page shows it (docs/operator_port.md, docs/operator_api.md). Degrees (WGS 84),
// metres, milliseconds since 1970 (UTC) by the clock of godwitd.

export interface place {
  latitude: number;
  longitude: number;
}

export interface position_update {
  latitude_deg: number;
  longitude_deg: number;
  altitude_m: number; // above home
  altitude_msl_m: number;
  ground_speed_mps: number;
  climb_mps: number;
  heading_deg: number | null;
}

export interface attitude_update {
  roll_deg: number;
  pitch_deg: number;
  yaw_deg: number;
}

export interface battery_update {
  remaining_percent: number | null;
  voltage_v: number | null;
  current_a: number | null;
}

export interface gps_update {
  fix: number; // GPS_FIX_TYPE
  satellites: number | null;
  hdop: number | null;
  accuracy_m: number | null;
}

export interface home_update {
  latitude_deg: number;
  longitude_deg: number;
  altitude_msl_m: number;
}

export interface flight_update {
  phase: string;
  cause: string;
  sentence: string;
  in_flight: boolean;
  is_armed: boolean;
  mode: string;
  preflight_report: number; // 0: none waits
  state: string;
}

export interface progress_update {
  mission_id: string;
  revision: number;
  generation: number;
  items: number;
  items_done: number;
  reports: number;
}

export interface part_health {
  part: string;
  health: string; // green, yellow, red
  reason: string;
  since_ms: number;
}

export interface health_update {
  worst: string;
  since_ms: number;
  parts: part_health[];
}

export interface log_update {
  is_warning: boolean;
  part: string;
  sentence: string;
}

export interface point_of_interest {
  number: number; // by which a person decides
  class_group: string;
  latitude_deg: number;
  longitude_deg: number;
  confidence: number; // 0..1
  has_moved: boolean;
  has_picture: boolean; // the camera has shown it
  decide_until_ms: number; // of one that is shown
  by: string; // of one that is confirmed: who did
}

export interface points_update {
  is_looking: boolean;
  mission_id: string;
  shown: point_of_interest[]; // people decide about these
  confirmed: point_of_interest[];
  waiting: number; // for their turn
}

export interface known_mission {
  mission_id: string; // empty: it has none
  revision: number | null; // null: not known
  origin: string; // service, file, upload, station, unknown
  place: string; // prepared, in_flight, waiting, ended, left, refused
  outcome: string; // of one that has ended: complete, aborted
  last_report_at: string; // UTC, RFC 3339; empty: nothing was reported of it
  items: number | null; // null: they are not kept
  items_done: number | null;
  reason: string; // why it waits, was refused or does not go on
}

// What the way home would take of the battery now, as far as it can be known.
export interface way_home_update {
  needs_percent: number | null;
  left_percent: number | null;
  reserve_percent: number; // at which the failsafe returns
  spare_percent: number | null; // left above both
  why_not_known: string;
}

export interface heard_aircraft {
  icao: number;
  name: string; // its callsign, or its address
  latitude_deg: number; // now, by its course
  longitude_deg: number;
  age_s: number; // of its newest report
  course_deg: number | null;
  height_m: number | null; // above the vehicle
  is_close: boolean; // or comes close soon
  sentence: string;
}

export interface traffic_update {
  aircraft: heard_aircraft[]; // the nearest first
  warnings: string[]; // of the autopilot
}

export interface topics {
  clock: { beat: number };
  link: { phase: string; reason: string };
  position: position_update;
  attitude: attitude_update;
  battery: battery_update;
  gps: gps_update;
  home: home_update;
  flight: flight_update;
  authority: { holder: string };
  progress: progress_update;
  map: Record<string, unknown>;
  points: points_update;
  health: health_update;
  log: log_update;
  missions: { list: known_mission[] };
  way_home: way_home_update;
  traffic: traffic_update;
}

export type topic = keyof topics;

export const topic_names: readonly topic[] = ["clock", "link", "position", "attitude", "battery", "gps", "home", "flight",
  "authority", "progress", "map", "points", "health", "log", "missions", "way_home", "traffic"];

export interface text<T extends topic = topic> {
  topic: T;
  number: number;
  at_ms: number;
  data: topics[T];
}

export interface stream_text {
  topic: "stream";
  data: { session?: string; dropped?: Record<string, number> };
}

// -- answers of the API -----------------------------------------------------------------------------

export interface mission_item {
  id: string;
  kind: string;
  at?: place & { altitude_m: number };
  polygon?: place[];
  altitude_m?: number;
  [more: string]: unknown;
}

export interface geofence {
  kind: "INCLUSION" | "EXCLUSION";
  vertices: place[];
  floor_m: number | null;
  ceiling_m: number | null;
}

export interface mission_document {
  mission_id: string;
  revision: number;
  items: mission_item[];
  geofences: geofence[];
  return_point: (place & { altitude_m: number }) | null; // null: nothing leads there
}

export interface plan_view {
  mission: mission_document | null;
  generation: number;
  way: (place & { altitude_m: number })[];
  home: (place & { above_sea_m: number }) | null;
  kept: (place & { above_sea_m: number }) | null;
}

export interface object_on_map {
  class_group: string;
  latitude_deg: number;
  longitude_deg: number;
  confidence: number; // 0..1
  last_seen_ms: number;
  is_seen_here: boolean; // found or moved by this vehicle since the map was pulled
}

export interface objects_view {
  objects: object_on_map[]; // the newest first
  counted: number; // that lie there, those among them
  is_all: boolean; // false: there are more, which nobody has looked at
}

export interface tile_view {
  attribution: string;
  name: string;
  min_zoom: number;
  max_zoom: number;
}

export interface preflight_view {
  phase: string;
  reason: string;
  report: number;
  acknowledged_by: string;
  looked_ms: number;
  findings: { check: string; verdict: string; sentence: string }[];
}

export interface who {
  name: string;
  role: "viewer" | "operator" | "engineer";
  session: string;
  now: string;
  ends?: string;
}

export interface control_view {
  holder: string;
  is_yours: boolean;
  since?: string;
}

export interface actor_report {
  name: string;
  phase: string;
  incarnation: number;
  restarts: number;
  last_crash: string;
  wanted: boolean;
  essential: boolean;
  health: string;
  health_reason: string;
}

export interface mail_figures {
  actor: string;
  waiting: number;
  handled: number;
  crashes: number;
  dead_lettered: number;
  dropped: number;
}

export interface status_report {
  at_ms: number;
  failsafe: { reacts: { why: string; what: string; stage: string } | null;
              overridden: { scope: string; reason: string; until_ns: number }[] } | null;
  vehicle: Record<string, unknown> | null;
  service: Record<string, unknown> | null;
  ground: Record<string, unknown> | null;
  actors: actor_report[];
  mail: mail_figures[];
  process: { version: string; cpu_s: number; resident_bytes: number; began_ms: number };
}

export interface audit_row {
  number: number;
  at: string;
  who: { name: string; role: string; session: string };
  what: string;
  id: string;
  outcome: string;
  reason: string;
  count: number;
}

export interface problem {
  status: number;
  detail: string;
  verdict?: string;
  state?: string;
  place?: string;
  holder?: string;
}
