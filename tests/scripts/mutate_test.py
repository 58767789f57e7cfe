"""scripts/mutate: which mistakes it finds in a file, that they lie apart, and what becomes of the text."""

import importlib.machinery
import importlib.util
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "scripts"))
LOADER = importlib.machinery.SourceFileLoader("mutate", str(ROOT / "scripts" / "mutate"))
mutate = importlib.util.module_from_spec(importlib.util.spec_from_loader("mutate", LOADER))
sys.modules["mutate"] = mutate
LOADER.exec_module(mutate)

SOURCE = """int far_away(int a, int b);
void warn();
int judge(int a, int b) {
  int result = 0;
  if (a < b && b > 3)
    return 1;
  result = a + b;
  warn();
  return far_away(a, result);
}
constexpr int fixed(int a) { return a < 2 ? a : 2; }
"""


class Mutate(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.before = mutate.ROOT
        self.addCleanup(lambda: setattr(mutate, "ROOT", self.before))
        mutate.ROOT = Path(folder.name)
        (mutate.ROOT / "judge.cpp").write_text(SOURCE)
        clang = mutate.load_clang()
        self.clang, self.index = clang, clang.Index.create()
        self.found = mutate.Reader(clang, self.index, "judge.cpp", ["-std=c++20"]).mutants()

    def became(self, kind):
        return sorted(each.before if each.is_statement else each.changed for each in self.found if each.kind == kind)

    def test_each_kind_of_mistake_is_found(self):
        self.assertEqual(self.became("negate"), ["!(a < b && b > 3)"])
        self.assertEqual(self.became("drop"), ["a < b", "b > 3"])
        self.assertEqual(self.became("limit"), ["a <= b", "b >= 3"])
        self.assertEqual(self.became("number"), ["b > 3 + 1"])
        self.assertEqual(self.became("sign"), ["a - b"])
        self.assertEqual(self.became("assignment"), ["result = a + b;"])
        self.assertEqual(self.became("return"), ["return 1;"])
        self.assertEqual(self.became("effect"), ["warn();"])
        self.assertEqual(self.became("swap"), ["far_away(result, a)"])

    def test_what_is_decided_by_the_compiler_is_left_alone(self):
        self.assertFalse([each for each in self.found if SOURCE.index("constexpr") <= each.start])

    def test_chosen_places_lie_apart_and_are_the_same_for_the_same_seed(self):
        chosen = mutate.choose(self.found, 100, 3)
        self.assertEqual(chosen, mutate.choose(self.found, 100, 3))
        ends = sorted((each.start, each.end) for each in chosen)
        self.assertTrue(all(one[1] <= other[0] for one, other in zip(ends, ends[1:])))

    def test_each_mutant_is_behind_its_number_and_the_text_compiles(self):
        (mutate.ROOT / mutate.SWITCH).write_text(mutate.SWITCH_TEXT)
        mutate.WORK = mutate.ROOT
        numbered = list(enumerate(mutate.choose(self.found, 100, 3)))
        taken = mutate.compiles(self.clang, self.index, "judge.cpp", ["-std=c++20"], numbered)
        self.assertEqual([number for number, _ in taken], [number for number, _ in numbered])
        text = mutate.with_mutants(SOURCE.encode(), numbered).decode()
        for number, _ in numbered:
            self.assertEqual(text.count(f"mutation::is({number})"), 1)

    def test_a_mutant_that_does_not_compile_is_left_out(self):
        wrong = mutate.Mutant("judge.cpp", SOURCE.index("a + b"), SOURCE.index("a + b") + 5, "sign", "a + b", "a + nothing", False)
        fine = next(each for each in self.found if each.kind == "effect")
        (mutate.ROOT / mutate.SWITCH).write_text(mutate.SWITCH_TEXT)
        mutate.WORK = mutate.ROOT
        taken = mutate.compiles(self.clang, self.index, "judge.cpp", ["-std=c++20"], [(0, wrong), (1, fine)])
        self.assertEqual([number for number, _ in taken], [1])


if __name__ == "__main__":
    unittest.main()
