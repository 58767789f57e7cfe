// Plans around the place where the simulated vehicles begin, and how they are compared.

const home = { latitude: 47.397742, longitude: 8.545594, altitude: 488 };
export const home_text = `${home.latitude},${home.longitude},${home.altitude}`;
export const nav_waypoint = 16;
export const nav_return = 20;
export const nav_land = 21;
export const nav_takeoff = 22;
const relative_int = 6; // MAV_FRAME_GLOBAL_RELATIVE_ALT_INT
const relative = 3; // the same, under the number that ArduPilot gives back
const mission_frame = 2;

export function check(is_right, sentence) {
  if (!is_right) throw new Error(sentence);
}

export function item(command, north_m, east_m, altitude_m) {
  const metres_per_degree = 111_319.5;
  const latitude = home.latitude + north_m / metres_per_degree;
  const longitude = home.longitude + east_m / (metres_per_degree * Math.cos(home.latitude * Math.PI / 180));
  return { frame: relative_int, command, current: 0, autocontinue: 1, param1: 0, param2: 0, param3: 0, param4: 0,
    x: Math.round(latitude * 1e7), y: Math.round(longitude * 1e7), z: altitude_m };
}

export const change_speed = (mps) =>
  ({ frame: mission_frame, command: 178, current: 0, autocontinue: 1, param1: 1, param2: mps, param3: 0, param4: 0,
    x: 0, y: 0, z: 0 });

export const square = (altitude_m, side_m = 30) =>
  [[side_m, 0], [side_m, side_m], [0, side_m]].map((corner) => item(nav_waypoint, ...corner, altitude_m));

// By meaning: autopilots number a frame differently, and leave out what means nothing.
export function compare(sent, held, first) {
  check(held.length === sent.length, `${held.length} items are held, ${sent.length} were sent`);
  const same_frame = (a, b) => a === b || (a === relative_int && b === relative);
  for (let n = first; n < sent.length; ++n) {
    check(held[n].seq === n && held[n].command === sent[n].command && same_frame(sent[n].frame, held[n].frame),
      `item ${n} is another command or frame: ${JSON.stringify(held[n])}`);
    for (const field of ["x", "y", "z"])
      check(Math.abs(held[n][field] - sent[n][field]) < 1e-6, `item ${n}: ${field} is ${held[n][field]}`);
  }
}
