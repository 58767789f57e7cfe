"""The missions service of the demo, and its own record of what was delivered to it.

What godwitd says of itself plays no part here: reports are counted in the file of the service."""

import collections
import contextlib
import json
import os
import socket
import sqlite3

from demo_lib.children import Child, Trouble

START_S = 10
ANSWER_S = 5

Figures = collections.namedtuple("Figures", "reports doubled lost items_flown observations is_complete")


class Service:
    def __init__(self, programs, folder, mission, allow_partial):
        self.token = folder / "token"
        self.token.touch(mode=0o600)
        self.token.write_text("demo-token\n", encoding="utf-8")
        self.file = folder / "missions.db"
        self.child = Child(
            "missions",
            [programs / "godwit-sim", "missions", "--listen", "127.0.0.1:0", "--control", "127.0.0.1:0"]
            + ["--token-file", self.token, "--mission", os.path.abspath(mission), "--db", self.file]
            + (["--allow-partial"] if allow_partial else []),
            folder,
        )
        try:
            port = self.child.wait_for(r"control port 127\.0\.0\.1:(\d+)", START_S)
            self.url = self.child.wait_for(r"listening on (http://\S+)", START_S).group(1)
        except BaseException:
            self.child.end()
            raise
        self.control_port = int(port.group(1))
        self.mission_id = self.rows("SELECT mission_id FROM missions")[0][0]

    def rows(self, query, *values):
        with contextlib.closing(sqlite3.connect(f"file:{self.file}?mode=ro", uri=True)) as file:
            return file.execute(query, values).fetchall()

    def ask(self, request):
        """An answer of the control port."""
        try:
            with socket.create_connection(("127.0.0.1", self.control_port), ANSWER_S) as connection:
                connection.sendall(json.dumps(request).encode() + b"\n")
                answer = json.loads(connection.makefile().readline())
        except (OSError, ValueError) as error:
            raise Trouble(f"the missions service does not answer at its control port: {error}") from error
        if not answer.get("ok"):
            raise Trouble(f"the missions service refuses '{request['do']}': {answer.get('error')}")
        return answer

    def mission(self):
        """The mission at its newest revision: that of the last assignment that was accepted."""
        return json.loads(self.rows("SELECT text FROM missions")[0][0])

    def has_item(self, index, kind):
        """Whether the newest revision has an item of KIND there."""
        items = self.mission()["items"]
        return index < len(items) and items[index]["kind"] == kind

    def is_reached(self, item_id):
        """As the reports say that were delivered."""
        return any(each["kind"] == "reached" and each.get("item_id") == item_id for each, _ in self.delivered("progress"))

    def assign(self, after, items):
        return self.ask({"do": "assign", "assignment": {"replace_after_item_id": after, "items": items}})

    def answer_to(self, assignment_id):
        """(outcome, reason) of an assignment; (None, "") while the vehicle has not answered."""
        outcome = self.rows("SELECT outcome FROM assignments WHERE assignment_id = ?", assignment_id)[0][0]
        rows = self.rows("SELECT text FROM delivered WHERE kind = 'response' AND id = ?", assignment_id)
        return outcome, json.loads(rows[0][0]).get("reason", "") if rows else ""

    def delivered(self, kind):
        """(content, deliveries) of each row of KIND."""
        rows = self.rows("SELECT text, deliveries FROM delivered WHERE kind = ? ORDER BY seq", kind)
        return [(json.loads(text), deliveries) for text, deliveries in rows]

    def figures(self, reports_made):
        """REPORTS_MADE: how many reports of the mission there are, as whoever makes them says."""
        rows = self.delivered("progress")
        reports = [report for report, _ in rows]
        return Figures(
            reports=len(reports),
            doubled=doubled(rows),
            lost=lost(reports, reports_made, self.mission()),
            items_flown=len({each["item_id"] for each in reports if each["kind"] == "reached" and "item_id" in each}),
            observations=len(self.delivered("observation")),
            is_complete=any(each["kind"] == "complete" for each in reports),
        )


def doubled(rows):
    """Deliveries of a report that was there already, and reports that say the same under another number.

    A request that is repeated under its idempotency key is not delivered twice: the service answers it from memory."""
    again = sum(deliveries - 1 for _, deliveries in rows)
    said = collections.Counter(what_it_says(report) for report, _ in rows)
    return again + sum(count - 1 for count in said.values())


def what_it_says(report):
    if "item_id" not in report:
        return report["kind"]  # a mission is complete once, whatever plan is flown
    return report["generation"], report["item_id"], report["kind"]


def lost(reports, made, mission):
    """Numbers that are missing, and items of a complete mission of which no report says what became of them."""
    numbers = {report["report_no"] for report in reports}
    missing = max([made, *numbers]) - len(numbers)
    if not any(report["kind"] == "complete" for report in reports):
        return missing
    settled = {report.get("item_id") for report in reports if report["kind"] in ("reached", "skipped")}
    return missing + sum(item["id"] not in settled for item in mission["items"])
