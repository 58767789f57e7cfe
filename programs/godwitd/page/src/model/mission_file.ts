// Which format a file of a mission has, by the ending of its name: as godwitd knows them. Pure.
export type mission_format = "json" | "plan" | "waypoints" | "geojson" | "kml";

export const max_file_bytes = 1024 * 1024; // godwitd takes no more

const endings: readonly [string, mission_format][] = [[".plan", "plan"], [".waypoints", "waypoints"], [".txt", "waypoints"],
  [".geojson", "geojson"], [".kml", "kml"], [".json", "json"]];

export function format_of_name(name: string): mission_format | undefined {
  return endings.find(([ending]) => name.toLowerCase().endsWith(ending))?.[1];
}

// Why it is not even looked at; empty: it is.
export function why_not_looked_at(name: string, bytes: number): string {
  if (format_of_name(name) === undefined)
    return `${name}: this ending means no format; known are .plan (QGroundControl), .waypoints and .txt (QGC WPL 110), .geojson, .kml and .json (godwit)`;
  return bytes > max_file_bytes ? `${name} has more than 1 MiB` : "";
}
