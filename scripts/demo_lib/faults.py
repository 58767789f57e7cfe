"""What goes wrong in the demo while the vehicle flies, each once: another tail, a crash, a kill."""

import time

from demo_lib.children import Trouble
from demo_lib.tail import other_tail

OVER_S = 20
BETWEEN_S = 1  # flown undisturbed before each fault, so that it can be told from the next one
MAX_TAILS = 3  # the vehicle may reach the next item while an assignment is on its way, and rightly refuse it
FLOWN = ("waypoint", "loiter", "survey")  # what takes a while


def is_moment(flight, mission):
    """On the way, and with a way to go: what happens shortly before a landing would be over on the ground."""
    if flight["phase"] != "flying" or not flight["is_armed"] or flight["revision"] != mission["revision"]:
        return False
    done = flight["items_done"]
    kinds = [item["kind"] for item in mission["items"][done : done + 2]]
    if done == 0 or len(kinds) < 2 or kinds[0] not in FLOWN:
        return False
    return kinds[0] == "survey" or kinds[1] in (*FLOWN, "change_speed")


def wait_for_moment(watch, service, what, seconds):
    """(flight, mission). A mission with a landing in the middle may have its next moment in the next flight."""
    not_before = time.monotonic() + BETWEEN_S
    mission = service.mission()

    def is_now(flight):
        return time.monotonic() >= not_before and is_moment(flight, mission)

    return watch.wait_for(f"a moment for {what}", is_now, seconds), mission


def reassign(watch, service, seconds):
    """The service replaces what is after the item that is flown now."""
    for number in range(1, MAX_TAILS + 1):
        flight, mission = wait_for_moment(watch, service, "another tail", seconds)
        after = mission["items"][flight["items_done"]]["id"]
        tail = other_tail(mission, flight["items_done"], number)
        made = service.assign(after, tail)
        watch.line.tell(f"fault: the service replaces all after '{after}' by {len(tail)} other items")
        answer = wait_for_answer(watch, service, made["assignment_id"])
        if answer[0] == "accepted":
            watch.wait_for(
                "the flight of the new tail",
                lambda now: now["revision"] == made["revision"] and now["phase"] == "flying",
                OVER_S,
            )
            watch.line.tell(f"over: the vehicle has accepted it and flies revision {made['revision']}")
            return
        watch.line.tell(f"  the vehicle has rejected it: {answer[1]}")
    raise Trouble(f"the vehicle has rejected {MAX_TAILS} tails")


def wait_for_answer(watch, service, assignment_id):
    """(outcome, reason)."""
    answers = []

    def is_answered(_):
        answers.append(service.answer_to(assignment_id))
        return answers[-1][0] is not None

    watch.wait_for("the answer to the assignment", is_answered, OVER_S, ends_with_flight=False)
    return answers[-1]


def crash_executor(watch, service, seconds):
    flight, _ = wait_for_moment(watch, service, "the crash", seconds)
    before = watch.daemon.restarts.count()
    watch.line.tell("fault: the executor crashes (godwitd ctl crash executor)")
    asked = time.monotonic()
    watch.daemon.ctl("crash", "executor")

    def is_back(now):
        return watch.daemon.restarts.count() > before and is_same_flight(now, flight)

    watch.wait_for("the executor", is_back, OVER_S)
    watch.line.tell(f"over: the executor follows the flight again, {time.monotonic() - asked:.1f} s after it")


def kill_daemon(watch, service, seconds, sightings):
    flight, _ = wait_for_moment(watch, service, "the kill", seconds)
    watch.line.tell("fault: godwitd is killed (SIGKILL), and started again with the same command line")
    asked = time.monotonic()
    watch.daemon.kill_and_start()
    sightings.again()
    watch.wait_for("the new godwitd", lambda now: is_same_flight(now, flight), OVER_S)
    watch.line.tell(f"over: the new godwitd follows the flight, {time.monotonic() - asked:.1f} s after the kill")


def is_same_flight(now, before):
    return (
        now["phase"] == "flying"
        and now["in_flight"]
        and now["is_armed"]
        and now["mission_id"] == before["mission_id"]
        and now["revision"] == before["revision"]
        and now["items_done"] >= before["items_done"]
    )
