// The words in which the page says what godwitd says by name. Pure. What has no word here is said as it came.

export type tone = "calm" | "good" | "warn" | "bad" | "none";

interface said {
  words: string;
  tone: tone;
}

const authorities: Record<string, said> = {
  godwit: { words: "godwit", tone: "good" },
  person: { words: "a person", tone: "warn" },
  failsafe: { words: "godwit's failsafe", tone: "bad" },
  autopilot_end: { words: "the autopilot, behind its plan", tone: "warn" },
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
  disconnected: "warn", connected: "calm", preflight: "calm", ready: "good", flying: "good", paused: "warn",
  returning: "warn", done: "good", aborted: "bad",
};

export function phase_tone(phase: string | undefined): tone {
  return phase_tones[phase ?? ""] ?? "calm";
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
