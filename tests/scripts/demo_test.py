#!/usr/bin/python3
"""The demo counts doubled and lost reports truthfully, keeps its detours clear of fences, and leaves nothing behind."""

import json
import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
sys.dont_write_bytecode = True

from demo_lib import camera, children, faults, restarts, service, sightings, tail, watch  # noqa: E402

MISSION = {"items": [{"id": "up", "kind": "takeoff"}, {"id": "w1", "kind": "waypoint"}]}
HOME = {"latitude": 47.4, "longitude": 8.5, "altitude_m": 0}


def report(number, kind, item=None, generation=1):
    what = {"report_no": number, "kind": kind, "generation": generation}
    return {**what, "item_id": item} if item else what


FLOWN = [report(1, "started", "up"), report(2, "reached", "up"), report(3, "reached", "w1"), report(4, "complete")]


class Doubled(unittest.TestCase):
    def doubled(self, *reports, deliveries=1):
        return service.doubled([(each, deliveries) for each in reports])

    def test_a_flight_without_repetitions_has_none(self):
        self.assertEqual(self.doubled(*FLOWN), 0)

    def test_a_number_that_came_twice_is_one(self):
        self.assertEqual(self.doubled(report(1, "reached", "up"), deliveries=2), 1)

    def test_the_same_item_of_the_same_plan_under_another_number_is_one(self):
        self.assertEqual(self.doubled(*FLOWN, report(5, "reached", "w1")), 1)

    def test_an_item_that_begins_again_in_another_plan_is_none(self):
        self.assertEqual(self.doubled(report(1, "started", "w1"), report(2, "started", "w1", generation=2)), 0)

    def test_a_mission_that_is_complete_twice_is_one_in_any_plan(self):
        self.assertEqual(self.doubled(report(1, "complete"), report(2, "complete", generation=2)), 1)


class Lost(unittest.TestCase):
    def test_a_whole_flight_has_none(self):
        self.assertEqual(service.lost(FLOWN, 4, MISSION), 0)

    def test_a_gap_is_one(self):
        self.assertEqual(service.lost([FLOWN[0], *FLOWN[2:]], 4, {"items": []}), 1)

    def test_what_was_made_and_did_not_come_is_lost(self):
        self.assertEqual(service.lost(FLOWN[:2], 4, MISSION), 2)
        self.assertEqual(service.lost([], 3, MISSION), 3)

    def test_an_item_of_a_complete_mission_that_no_report_names_is_one(self):
        self.assertEqual(service.lost([report(1, "reached", "up"), report(2, "complete")], 2, MISSION), 1)

    def test_an_item_that_was_skipped_is_not_lost(self):
        reports = [report(1, "skipped", "up"), report(2, "reached", "w1"), report(3, "complete")]
        self.assertEqual(service.lost(reports, 3, MISSION), 0)


def box(west, south, east, north):
    return [(west, south), (east, south), (east, north), (west, north)]


class Ways(unittest.TestCase):
    def test_a_way_inside_of_an_inclusion_is_free_and_one_out_of_it_is_not(self):
        fences = [("INCLUSION", box(0, 0, 100, 100))]
        self.assertTrue(tail.is_free((10, 10), (90, 90), fences))
        self.assertFalse(tail.is_free((10, 10), (110, 90), fences))
        self.assertFalse(tail.is_free((110, 10), (110, 90), fences))

    def test_a_way_through_or_in_an_exclusion_is_not_free(self):
        fences = [("EXCLUSION", box(40, 40, 60, 60))]
        self.assertFalse(tail.is_free((0, 50), (100, 50), fences))
        self.assertFalse(tail.is_free((45, 45), (55, 55), fences))
        self.assertTrue(tail.is_free((0, 30), (100, 30), fences))

    def test_a_way_may_not_leave_a_dented_inclusion_in_between(self):
        dented = [(0, 0), (100, 0), (100, 100), (50, 10), (0, 100)]
        self.assertFalse(tail.is_free((5, 80), (95, 80), [("INCLUSION", dented)]))


def waypoint(name, east, north):
    return {"id": name, "kind": "waypoint", "at": {**tail.Plane(HOME).place((east, north)), "altitude_m": 20}}


class Tail(unittest.TestCase):
    def mission(self, *fences):
        items = [{"id": "up", "kind": "takeoff", "altitude_m": 20}, waypoint("a", 0, 50), waypoint("b", 100, 50)]
        plane = tail.Plane(HOME)
        fences = [{"kind": kind, "vertices": [plane.place(at) for at in corners]} for kind, corners in fences]
        return {"items": [*items, {"id": "home", "kind": "return"}], "geofences": fences, "return_point": HOME}

    def test_a_detour_comes_first_and_then_all_that_was_to_be_flown_under_new_names(self):
        items = tail.other_tail(self.mission(), 1, 3)
        self.assertEqual([each["id"] for each in items], ["detour-3", "b-anew-3", "home-anew-3"])

    def test_the_detour_lies_beside_the_way_at_the_height_of_the_way(self):
        at = tail.other_tail(self.mission(), 1, 1)[0]["at"]
        east, north = tail.Plane(HOME).point(at)
        self.assertAlmostEqual(east, 50, delta=0.1)
        self.assertAlmostEqual(abs(north - 50), 25, delta=0.1)
        self.assertEqual(at["altitude_m"], 20)

    def test_the_detour_takes_the_side_that_the_fences_leave_free(self):
        for fence in (box(20, 60, 80, 90), box(20, 10, 80, 40)):
            at = tail.other_tail(self.mission(("EXCLUSION", fence)), 1, 1)[0]["at"]
            _, north = tail.Plane(HOME).point(at)
            self.assertLess(math.dist((0, north), (0, 50)), 26)
            self.assertFalse(fence[0][1] <= north <= fence[2][1], fence)

    def test_names_keep_the_length_that_the_schema_allows(self):
        mission = self.mission()
        mission["items"][2]["id"] = "x" * 64
        self.assertTrue(all(len(each["id"]) <= 64 for each in tail.other_tail(mission, 1, 1)))

    def test_each_shipped_mission_has_a_free_detour_after_each_item_that_is_flown(self):
        for name in ("survey", "delivery", "patrol"):
            mission = json.loads((ROOT / "missions" / f"{name}.json").read_text(encoding="utf-8"))
            plane = tail.Plane(mission["return_point"])
            fences = [(each["kind"], [plane.point(at) for at in each["vertices"]]) for each in mission["geofences"]]
            items = mission["items"]
            for index in range(1, len(items) - 1):
                if items[index]["kind"] in faults.FLOWN and items[index + 1]["kind"] in faults.FLOWN:
                    at = plane.point(tail.other_tail(mission, index, 1)[0]["at"])
                    for each in tail.first_points(items[index::-1], plane):
                        self.assertTrue(tail.is_free(each, at, fences), (name, items[index]["id"]))


class Moments(unittest.TestCase):
    MISSION = {"revision": 1, "items": [{"kind": kind} for kind in ("takeoff", "waypoint", "waypoint", "land")]}

    def is_moment(self, done, **other):
        flight = {"phase": "flying", "is_armed": True, "revision": 1, "items_done": done, **other}
        return faults.is_moment(flight, self.MISSION)

    def test_on_the_way_is_one(self):
        self.assertTrue(self.is_moment(1))

    def test_take_off_and_the_way_to_a_landing_are_none(self):
        self.assertEqual([self.is_moment(done) for done in (0, 2, 3, 4)], [False] * 4)

    def test_another_phase_or_revision_is_none(self):
        self.assertFalse(self.is_moment(1, phase="paused"))
        self.assertFalse(self.is_moment(1, revision=2))
        self.assertFalse(self.is_moment(1, is_armed=False))


class SearchedMeadow:
    """Watch, service and operator of a search in which the operator's word is obeyed, or is not."""

    ITEMS = [{"id": "up", "kind": "takeoff"}, {"id": "meadow", "kind": "survey"}, {"id": "home", "kind": "return"}]
    EXTRA = {"id": "extra1", "kind": "waypoint", "at": {"latitude": 47.4, "longitude": 8.5}}

    def __init__(self, flights, is_obeyed=True, refusal=None, waits_s=0):
        self.flights = [{"phase": "flying", **flight} for flight in flights]
        self.is_obeyed, self.refusal = is_obeyed, refusal
        self.told, self.said, self.items, self.reached = [], [], list(self.ITEMS), []
        self.line = self
        self.operator = camera.Operator(self, self, waits_s)

    def tell(self, text):
        self.told.append(text)

    def status(self):
        return {"points": {"shown": [], "confirmed": [{"number": 3}]}}

    def ctl(self, *words):
        if self.refusal:
            raise children.Trouble(self.refusal)
        self.said.append(words)
        if self.is_obeyed:
            self.items.insert(1, self.EXTRA)

    def mission(self):
        return {"items": self.items}

    def has_item(self, index, kind):
        return self.items[index]["kind"] == kind

    def is_reached(self, item_id):
        return item_id in self.reached

    def wait_for(self, what, is_there, _seconds):
        while self.flights:
            flight = self.flights.pop(0)
            self.reached = flight.get("reached", [])
            if is_there(flight):
                return flight
        raise children.Trouble(f"{what} did not come")

    def visit(self):
        camera.visit(self, self, self.operator, 1)


class Visiting(unittest.TestCase):
    CLIMBING, SEARCHING = {"items_done": 0, "items": 3}, {"items_done": 1, "items": 3}
    THERE = {"items_done": 2, "items": 4, "reached": ["extra1"]}

    def test_the_vehicle_is_sent_from_the_survey_to_the_point_and_back_to_it(self):
        on_its_way = {"items_done": 1, "items": 4}
        world = SearchedMeadow([self.CLIMBING, self.SEARCHING, self.SEARCHING, on_its_way, self.THERE, self.THERE])
        world.visit()
        self.assertEqual(world.said, [("insert", "--point", "3", "--altitude", "40")])
        self.assertEqual(world.operator.visited, [3])
        self.assertEqual(world.told[-1], "the vehicle goes on with 'meadow'")

    def test_one_that_never_gets_there_is_no_visit(self):
        world = SearchedMeadow([self.SEARCHING, *[{"items_done": 1, "items": 4}] * 3])
        with self.assertRaisesRegex(children.Trouble, "the vehicle at the point did not come"):
            world.visit()
        self.assertEqual(world.operator.visited, [])

    def test_one_that_does_not_go_on_with_the_survey_is_no_visit(self):
        paused = {**self.THERE, "phase": "paused"}
        world = SearchedMeadow([self.SEARCHING, {"items_done": 1, "items": 4}, self.THERE, paused])
        with self.assertRaisesRegex(children.Trouble, "the survey again did not come"):
            world.visit()

    def test_who_has_control_at_the_page_is_not_disturbed(self):
        world = SearchedMeadow([self.SEARCHING], refusal="anna has control", waits_s=20)
        world.visit()
        self.assertEqual((world.said, world.operator.visited), ([], []))
        self.assertIn("anna has control", world.told[-1])

    def test_a_refusal_without_a_person_ends_the_demo(self):
        with self.assertRaises(children.Trouble):
            SearchedMeadow([self.SEARCHING], refusal="no").visit()


class StandingStill(unittest.TestCase):
    def judge(self, cause):
        look = watch.Watch(None, [], None)
        look.stuck_since = -watch.STUCK_S  # longer ago than it may be
        look.judge({"phase": "paused", "cause": cause, "sentence": "why"})

    def test_a_pause_that_waits_for_a_person_ends_the_demo(self):
        with self.assertRaisesRegex(children.Trouble, "why"):
            self.judge("not_done")

    def test_a_pause_that_was_asked_for_does_not(self):
        self.judge("asked")


class Children(unittest.TestCase):
    def test_one_that_does_not_end_when_asked_is_killed(self):
        with tempfile.TemporaryDirectory() as folder:
            command = ["/bin/bash", "-c", "trap '' TERM; echo ready; while :; do sleep 0.05; done"]
            child = children.Child("stubborn", command, Path(folder))
            child.wait_for("ready", 10)
            children.PATIENCE_S, before = 0.2, children.PATIENCE_S
            self.addCleanup(setattr, children, "PATIENCE_S", before)
            self.assertEqual(child.end(), -9)

    def test_one_that_can_not_be_started_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaisesRegex(children.Trouble, "absent can not be started"):
                children.Child("absent", ["/nowhere/absent"], Path(folder))

    def test_one_that_ends_by_itself_is_reported_with_what_it_said_last(self):
        with tempfile.TemporaryDirectory() as folder:
            child = children.Child("short", ["/bin/bash", "-c", "echo no such port; exit 3"], Path(folder))
            with self.assertRaisesRegex(children.Trouble, "(?s)ended with 3.*no such port"):
                child.wait_for("listening", 10)


class Pipe(unittest.TestCase):
    def test_a_reader_that_was_killed_gets_all_lines_again(self):
        with tempfile.TemporaryDirectory() as folder:
            seen = sightings.Sightings(Path(folder) / "pipe", HOME)
            self.addCleanup(seen.stop)
            seen.lines = [b'{"id": 1}\n', b'{"id": 2}\n']
            seen.again()
            with open(seen.path, "rb") as reader:
                self.assertEqual([reader.readline(), reader.readline()], seen.lines)


class Trace(unittest.TestCase):
    LINE = '{"run":%d,"id":%d,"message":{"name":"executor","kind":"up","incarnation":%d,"reason":""}}\n'

    def test_incarnations_after_the_first_are_counted_once_while_the_trace_grows(self):
        with tempfile.TemporaryDirectory() as folder:
            told = Path(folder) / "told"
            program = Path(folder) / "godwit-trace"
            program.write_text(f"#!/bin/sh\ncat {told}\n", encoding="utf-8")
            program.chmod(0o755)
            counted = restarts.Restarts(program, Path(folder))
            self.assertEqual(counted.count(), 0)
            first, again, other = self.LINE % (1, 5, 1), self.LINE % (1, 9, 2), self.LINE % (2, 9, 3)
            for lines, count in ((first, 0), (first + again, 1), (first + again + other, 2), (other, 2)):
                told.write_text(lines, encoding="utf-8")
                self.assertEqual(counted.count(), count)


class CommandLine(unittest.TestCase):
    def test_mistakes_are_refused_before_anything_is_started(self):
        for words in (("--personality", "plane"), ("--bin", "/nowhere"), ("--speed", "x"), ("now",)):
            command = ["/usr/bin/python3", "-B", str(ROOT / "scripts/demo"), *words]
            result = subprocess.run(command, capture_output=True, text=True, timeout=30, check=False)
            self.assertEqual((result.returncode, result.stdout), (2, ""), words)
            self.assertIn("usage: demo", result.stderr)


if __name__ == "__main__":
    unittest.main()
