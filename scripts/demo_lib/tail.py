"""Another tail for a mission that is being flown: a detour first, then what was to be flown anyway, under other names.

The detour keeps to the fences of the mission, or the vehicle would be right to refuse it. Places are metres east and
north of the return point here: good enough for a demo's few hundred metres."""

import math

EARTH_M_PER_DEG = 111_195
SIDEWAYS_M = (25, -25, 12, -12, 6, -6)
MARGIN_M = 10  # corners are not flown to the decimetre
MAX_ID = 64  # characters, as in the schema of items


class Plane:
    def __init__(self, origin):
        self.origin = origin
        self.east_m_per_deg = EARTH_M_PER_DEG * math.cos(math.radians(origin["latitude"]))

    def point(self, place):
        return (
            (place["longitude"] - self.origin["longitude"]) * self.east_m_per_deg,
            (place["latitude"] - self.origin["latitude"]) * EARTH_M_PER_DEG,
        )

    def place(self, point):
        return {
            "latitude": round(self.origin["latitude"] + point[1] / EARTH_M_PER_DEG, 7),
            "longitude": round(self.origin["longitude"] + point[0] / self.east_m_per_deg, 7),
        }


def side(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def do_cross(a, b, c, d):
    return side(a, b, c) * side(a, b, d) <= 0 and side(c, d, a) * side(c, d, b) <= 0


def edges(corners):
    return zip(corners, corners[1:] + corners[:1])


def is_inside(point, corners):
    crossings = 0
    for (x1, y1), (x2, y2) in edges(corners):
        if (y1 > point[1]) != (y2 > point[1]) and point[0] < x1 + (point[1] - y1) / (y2 - y1) * (x2 - x1):
            crossings += 1
    return crossings % 2 == 1


def is_free(a, b, fences):
    """FENCES: (kind, corners)."""

    def crosses(corners):
        return any(do_cross(a, b, c, d) for c, d in edges(corners))

    inclusions = [corners for kind, corners in fences if kind == "INCLUSION"]
    if inclusions and not any(is_inside(a, each) and is_inside(b, each) and not crosses(each) for each in inclusions):
        return False
    return not any(is_inside(a, each) or crosses(each) for kind, each in fences if kind == "EXCLUSION")


def points_of(item, plane):
    """Where a vehicle may come to and leave an item; empty: it has no place."""
    if item["kind"] == "survey":
        return [plane.point(corner) for corner in item["polygon"]]
    if item["kind"] == "return":
        return [(0.0, 0.0)]
    return [plane.point(item["at"])] if "at" in item else []


def first_points(items, plane):
    return next((points for item in items if (points := points_of(item, plane))), [(0.0, 0.0)])


def altitude_before(items):
    for item in reversed(items):
        for height in (item.get("altitude_m"), item.get("at", {}).get("altitude_m")):
            if height:
                return height
    return 10


def middle(points):
    return sum(x for x, _ in points) / len(points), sum(y for _, y in points) / len(points)


def around(point):
    return [(point[0] + east, point[1] + north) for east in (-MARGIN_M, MARGIN_M) for north in (-MARGIN_M, MARGIN_M)]


def detour(before, behind, fences):
    """A point beside the way from one of BEFORE to one of BEHIND, from and to which each way is free."""
    a, b = middle(before), middle(behind)
    centre = ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
    length = math.dist(a, b) or 1
    for offset in SIDEWAYS_M:
        point = (centre[0] - (b[1] - a[1]) / length * offset, centre[1] + (b[0] - a[0]) / length * offset)
        if all(is_free(each, corner, fences) for each in before + behind for corner in around(point)):
            return point
    return centre


def middle_of(mission):
    """Where the mission leads back to; of a file that a ground station has written, where it was planned for."""
    return mission.get("return_point") or mission["planned_home"]


def other_tail(mission, index, number):
    """Items that replace all after item INDEX. NUMBER tells their names from those of earlier tails."""
    plane = Plane(middle_of(mission))
    fences = [(each["kind"], [plane.point(corner) for corner in each["vertices"]]) for each in mission["geofences"]]
    flown, rest = mission["items"][: index + 1], mission["items"][index + 1 :]
    point = detour(first_points(flown[::-1], plane), first_points(rest, plane), fences)
    look = {
        "id": f"detour-{number}",
        "kind": "waypoint",
        "at": {**plane.place(point), "altitude_m": altitude_before(flown)},
        "hold_s": 0,
        "accept_radius_m": 2,
    }
    ending = f"-anew-{number}"
    return [look, *({**item, "id": item["id"][: MAX_ID - len(ending)] + ending} for item in rest)]
