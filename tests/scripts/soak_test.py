#!/usr/bin/python3
"""The soak tells growth from what comes and goes, looks after a flight that is paused, and draws what it sampled."""

import random
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
sys.dont_write_bytecode = True

from soak_lib import faults, page, samples  # noqa: E402


def sampled(name, values):
    at_rest = {"memory_kib": 20_000, "descriptors": 30, "threads": 17, "journal_kib": 300, "trace_kib": 5_000}
    return [{**at_rest, "at_s": float(at_s), name: value} for at_s, value in enumerate(values)]


class Growth(unittest.TestCase):
    def test_what_stays_does_not_grow(self):
        self.assertEqual(samples.growths(sampled("memory_kib", [20_000] * 40)), [])

    def test_what_comes_and_goes_does_not_grow(self):
        self.assertEqual(samples.growths(sampled("descriptors", [30, 30, 30, 45] * 10)), [])

    def test_a_descriptor_that_is_lost_now_and_then_is_growth(self):
        found = samples.growths(sampled("descriptors", [30 + number // 5 for number in range(40)]))
        self.assertEqual(len(found), 1)
        self.assertIn("descriptors", found[0])

    def test_memory_that_is_lost_is_growth(self):
        found = samples.growths(sampled("memory_kib", range(20_000, 60_000, 1_000)))
        self.assertIn("memory_kib", found[0])

    def test_a_trace_may_fill_its_bound_and_no_more(self):
        self.assertEqual(samples.growths(sampled("trace_kib", range(0, 240_000, 6_000))), [])
        self.assertIn("trace", samples.growths(sampled("trace_kib", range(0, 400_000, 10_000)))[0])

    def test_too_few_samples_say_nothing(self):
        self.assertIn("too few", samples.growths(sampled("threads", [17] * 3))[0])


class Daemon:
    def __init__(self):
        self.said = []

    def ctl(self, *words):
        self.said.append(words)


class Service:
    def __init__(self):
        self.assigned = 0

    def ask(self, _):
        pass

    def assign(self, _after, _items):
        self.assigned += 1


class Faults(unittest.TestCase):
    def setUp(self):
        self.daemon, self.service = Daemon(), Service()
        self.said_to_vehicle = []

    def run_for(self, seconds, seed, flight):
        made = faults.Faults(self.daemon, self.service, 0, random.Random(seed))
        made.vehicle = self.said_to_vehicle.append
        for now in range(seconds):
            made.go_on(now, flight, list)
        return made

    def test_the_same_seed_makes_the_same_faults(self):
        first = self.run_for(200, 3, {"phase": "flying"}).made
        self.assertEqual(first, self.run_for(200, 3, {"phase": "flying"}).made)
        self.assertNotEqual(first, self.run_for(200, 4, {"phase": "flying"}).made)

    def test_a_bad_line_is_a_good_one_again(self):
        self.run_for(300, 3, {"phase": "flying"})
        bad = [words for words in self.said_to_vehicle if words.startswith("faults loss")]
        good = [words for words in self.said_to_vehicle if words == "faults none"]
        self.assertGreater(len(bad), 0)
        self.assertLessEqual(len(bad) - len(good), 1)

    def test_a_flight_that_a_person_has_is_handed_back_and_resumed(self):
        made = faults.Faults(self.daemon, self.service, 0, random.Random(1))
        made.vehicle = self.said_to_vehicle.append
        made.kinds = (lambda _: None,)
        made.kinds[0].__name__ = "nothing"
        for now in range(4):
            made.go_on(now, {"phase": "paused", "reason": "nothing is sent until an operator hands it back"}, list)
        self.assertEqual(self.daemon.said, [("hand-back",), ("resume",)])

    def test_it_is_sent_elsewhere_once_a_minute(self):
        self.run_for(200, 1, {"phase": "flying"})
        self.assertEqual(self.service.assigned, 3)


class Page(unittest.TestCase):
    def test_has_a_plot_of_each_figure_and_each_flaw_and_loads_nothing(self):
        taken = sampled("memory_kib", range(20_000, 60_000, 1_000))
        summary = {"flaws": ["it <grew>"], "figures": samples.figures(taken), "faults": {"cut": 3}, "seed": 1}
        text = page.page_of(summary, taken)
        self.assertEqual(text.count("<svg"), 5)
        self.assertIn("it &lt;grew&gt;", text)
        self.assertIn("FAILED", text)
        for word in ("<script", "http", "src="):
            self.assertNotIn(word, text)


if __name__ == "__main__":
    unittest.main()
