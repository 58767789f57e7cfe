#!/usr/bin/python3
"""Each check of the tree finds the mistakes it is there for, and accepts the same tree without them."""

import json
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
GOOD_HEADER = "#pragma once\n"


class Tree(unittest.TestCase):
    """A small tree of its own for each test."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name) / "tree"
        self.cache = Path(folder.name) / "cache"
        self.root.mkdir()

    def write(self, path, text):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")

    def run_check(self, name, *words):
        environment = {**os.environ, "XDG_CACHE_HOME": str(self.cache)}
        environment.pop("LINT_BASE", None)
        command = ["/usr/bin/python3", str(ROOT / "scripts" / f"check_{name}"), "--root", str(self.root), *words]
        result = subprocess.run(command, capture_output=True, text=True, env=environment, timeout=60, check=False)
        self.assertIn(result.returncode, (0, 1), result.stderr)
        return result

    def accepts(self, name, *words):
        result = self.run_check(name, *words)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return result.stdout

    def finds(self, name, *sentences, words=()):
        result = self.run_check(name, *words)
        self.assertEqual(result.returncode, 1, result.stdout)
        for sentence in sentences:
            self.assertIn(sentence, result.stdout)
        return result.stdout


class Includes(Tree):
    def file(self, path, *includes, body=""):
        self.write(path, GOOD_HEADER + "".join(f"#include {name}\n" for name in includes) + body)

    def setUp(self):
        super().setUp()
        self.file("io/fields/table.hpp")
        self.file("io/bytes.hpp", '"io/fields/table.hpp"')
        self.file("runtime/define_message.hpp")
        self.file("runtime/actor_base.hpp", "<caf/all.hpp>", '"io/bytes.hpp"', body="caf::actor x;\n")
        self.file("messages/link/types.hpp", '"io/fields/table.hpp"', "<string>")
        self.file("messages/link/types.cpp", '"messages/link/types.hpp"', '"runtime/define_message.hpp"')
        self.file("messages/link/handle.hpp", '"runtime/actor_base.hpp"', '"messages/link/types.hpp"')
        self.file("actors/domain/position.hpp")
        self.file("actors/link/state.hpp", '"actors/domain/position.hpp"')
        self.file("actors/link/core.hpp", '"actors/link/state.hpp"', '"messages/link/types.hpp"')
        self.file("actors/link/core.cpp", '"actors/link/core.hpp"', body="// caf:: in a comment\nauto x = \"caf::\";\n")
        self.file("actors/link/actor.hpp", '"actors/link/core.hpp"', '"messages/link/handle.hpp"', '"runtime/actor_base.hpp"')
        self.file("programs/godwitd/main.cpp", '"actors/link/actor.hpp"')
        self.file("tests/support.hpp")
        self.file("tests/runtime/cell_test.cpp", "<caf/all.hpp>", '"runtime/actor_base.hpp"', '"tests/support.hpp"')

    def test_a_tree_that_keeps_the_rule_is_accepted(self):
        self.accepts("includes")

    def test_layers_know_only_what_stands_left_of_them(self):
        self.file("io/bad.cpp", '"runtime/actor_base.hpp"')
        self.file("runtime/bad.cpp", '"messages/link/types.hpp"')
        self.file("messages/link/bad.cpp", '"actors/link/actor.hpp"')
        self.file("actors/link/bad.cpp", '"programs/bad.hpp"')
        self.file("programs/bad.hpp")
        self.finds("includes", "io/bad.cpp:2: ", "runtime/bad.cpp:2: ", "messages/link/bad.cpp:2: ")
        self.finds("includes", "actors/link/bad.cpp:2: ")

    def test_only_tests_include_from_tests(self):
        self.file("programs/bad.cpp", '"tests/support.hpp"')
        self.finds("includes", "programs/bad.cpp:2: ", "only tests may include from tests/")

    def test_caf_is_known_in_runtime_only(self):
        self.file("io/bad.cpp", "<caf/actor.hpp>")
        self.file("actors/link/bad.cpp", body="void f(caf::actor);\n")
        self.file("tests/drills/bad.cpp", body="using ::caf::actor;\n")
        self.finds("includes", "io/bad.cpp:2: ", "actors/link/bad.cpp:2: ", "tests/drills/bad.cpp:2: ")

    def test_words_that_only_end_in_caf_are_not_caf(self):
        self.file("programs/good.cpp", body="int x = decaf::y + own::caf::z;\n")
        self.accepts("includes")

    def test_types_know_only_fields_and_types(self):
        self.file("messages/other/types.hpp", '"messages/link/types.hpp"')
        self.file("messages/bad/types.hpp", '"messages/other/types.hpp"', '"runtime/actor_base.hpp"')
        self.file("tests/x.cpp", '"messages/bad/types.hpp"')
        output = self.finds("includes", "messages/bad/types.hpp:3: ")
        self.assertNotIn("messages/bad/types.hpp:2", output)

    def test_a_core_is_pure(self):
        self.file("actors/link/core.cpp", '"actors/link/core.hpp"', '"runtime/actor_base.hpp"', '"messages/link/handle.hpp"')
        self.finds("includes", "actors/link/core.cpp:3: ", "actors/link/core.cpp:4: ")

    def test_what_a_core_reaches_is_pure_too(self):
        self.file("io/link/link.hpp")
        self.file("actors/link/rule.hpp", '"actors/link/state.hpp"')
        self.file("actors/link/core.cpp", '"actors/link/core.hpp"', '"actors/link/rule.hpp"')
        self.file("tests/x.cpp", '"io/link/link.hpp"')
        self.accepts("includes")
        self.file("actors/link/rule.hpp", '"io/link/link.hpp"')
        self.finds("includes", "actors/link/core.cpp:3: ", "actors/link/rule.hpp -> io/link/link.hpp")

    def test_siblings_never_include_each_other(self):
        self.file("actors/health/actor.cpp", '"actors/link/state.hpp"')
        self.file("actors/domain/bad.cpp", '"actors/link/state.hpp"')
        self.finds("includes", "actors/health must not know actors/link", "actors/domain/bad.cpp:2: ")

    def test_programs_share_only_what_is_common(self):
        self.file("programs/common/printer.hpp")
        self.file("programs/godwit-sim/sim.hpp")
        self.file("programs/godwitd/good.cpp", '"programs/common/printer.hpp"')
        self.file("programs/godwit-drill/flights.cpp", '"programs/godwit-sim/sim.hpp"')
        self.accepts("includes")
        self.file("programs/godwitd/bad.cpp", '"programs/godwit-sim/sim.hpp"')
        self.file("programs/common/bad.cpp", '"programs/godwit-sim/sim.hpp"')
        self.finds("includes", "programs/godwitd/bad.cpp:2: ", "programs/common/bad.cpp:2: ", "no program depends on")

    def test_includes_start_at_the_root_and_exist(self):
        self.file("io/bad.cpp", '"bytes.hpp"', '"../runtime/actor_base.hpp"', '"io/none.hpp"', "<io/bytes.hpp>")
        self.finds("includes", "io/bad.cpp:2: ", "io/bad.cpp:3: ", "io/bad.cpp:4: ", "io/bad.cpp:5: ")

    def test_a_header_that_nothing_includes_is_found(self):
        self.file("runtime/lonely.hpp")
        self.finds("includes", "runtime/lonely.hpp: nothing includes this header")


class Headers(Tree):
    def setUp(self):
        super().setUp()
        self.write("io/good.hpp", GOOD_HEADER + "#include <string>\ninline std::string name() { return {}; }\n")

    def test_a_header_that_compiles_alone_is_accepted_and_remembered(self):
        self.assertIn("1 compiled now", self.accepts("headers"))
        self.assertIn("0 compiled now", self.accepts("headers"))

    def test_a_changed_header_is_compiled_again(self):
        self.write("io/user.hpp", GOOD_HEADER + '#include "io/good.hpp"\ninline auto other() { return name(); }\n')
        self.assertIn("2 compiled now", self.accepts("headers"))
        self.write("io/good.hpp", GOOD_HEADER)
        self.finds("headers", "io/user.hpp: does not compile alone")

    def test_a_missing_include_is_found(self):
        self.write("io/bad.hpp", GOOD_HEADER + "inline std::string name() { return {}; }\n")
        self.finds("headers", "io/bad.hpp: does not compile alone")
        self.finds("headers", "io/bad.hpp: does not compile alone")

    def test_a_header_that_can_not_be_included_twice_is_found(self):
        self.write("io/bad.hpp", "struct once {};\n")
        self.finds("headers", "io/bad.hpp: does not compile alone")


class Json(Tree):
    SCHEMA = {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "type": "object",
        "properties": {"port": {"type": "integer", "minimum": 1}},
    }

    def setUp(self):
        super().setUp()
        self.write("config/a.schema.json", json.dumps(self.SCHEMA))
        self.write("config/a.json", '// comment\n{"port": 5 /* "here" */}')
        self.write("config/b.json", '{"$schema": "a.schema.json", "port": 7}')
        self.write("tests/data/fuzz/a/broken.json", "{")
        self.write("tests/peers/node_modules/x/broken.json", "{")

    def test_valid_documents_are_accepted(self):
        self.assertIn("3 documents, 2 against a schema", self.accepts("json"))

    def test_what_is_no_json_is_found(self):
        self.write("tests/data/x.json", "{,}")
        self.write("tests/data/y.json", "// comments belong to config\n{}")
        self.finds("json", "tests/data/x.json: is not JSON", "tests/data/y.json: is not JSON")

    def test_a_key_that_stands_twice_is_found(self):
        self.write("tests/data/x.json", '{"a": 1, "a": 2}')
        self.finds("json", 'the key "a" stands twice')

    def test_a_number_that_only_python_knows_is_found(self):
        self.write("tests/data/x.json", '{"a": NaN}')
        self.write("tests/data/y.json", '[-Infinity]')
        self.finds("json", "tests/data/x.json: is not JSON: NaN", "tests/data/y.json: is not JSON: -Infinity")

    def test_a_document_that_its_schema_forbids_is_found(self):
        self.write("config/a.json", '{"port": 0}')
        self.write("config/b.json", '{"$schema": "a.schema.json", "port": "x"}')
        self.finds("json", "config/a.json: at port: ", "config/b.json: at port: ")

    def test_a_broken_schema_is_found(self):
        self.write("config/a.schema.json", json.dumps({**self.SCHEMA, "type": "objekt"}))
        self.finds("json", "config/a.schema.json: is not a draft-07 schema")

    def test_a_schema_of_another_draft_is_found(self):
        self.write("config/a.schema.json", json.dumps({"type": "object"}))
        self.finds("json", "config/a.schema.json: a schema says")

    def test_a_configuration_without_a_schema_is_found(self):
        self.write("config/c.json", "{}")
        self.write("config/d.json", '{"$schema": "none.schema.json"}')
        self.finds("json", "config/c.json: has no schema", "config/d.json: names the schema")

    def test_a_reference_to_another_schema_is_followed(self):
        self.write("config/schemas/port.schema.json", json.dumps(self.SCHEMA))
        whole = {"$schema": self.SCHEMA["$schema"], "properties": {"http": {"$ref": "schemas/port.schema.json"}}}
        self.write("config/a.schema.json", json.dumps(whole))
        self.write("config/a.json", '{"http": {"port": 0}}')
        self.finds("json", "config/a.json: at http.port: ")

    def test_a_reference_that_leads_nowhere_is_found(self):
        for reference in ("none.schema.json", "#/definitions/none", "https://example.org/a.schema.json"):
            whole = {"$schema": self.SCHEMA["$schema"], "properties": {"port": {"$ref": reference}}}
            self.write("config/a.schema.json", json.dumps(whole))
            self.finds("json", f'"$ref": "{reference}" leads nowhere')

    def test_an_example_in_a_document_that_its_schema_forbids_is_found(self):
        self.write("config/schemas/port.schema.json", json.dumps(self.SCHEMA))
        self.write("docs/a.md", '```json schema=port\n{"port": 1}\n```\n')
        self.assertIn("1 examples", self.accepts("json"))
        self.write("docs/b.md", 'text\n```json schema=port\n{"port": 0}\n```\n')
        self.write("docs/c.md", "```json schema=port\n{,}\n```\n")
        self.write("docs/d.md", "```json schema=none\n{}\n```\n")
        self.finds("json", "docs/b.md:2: at port: ", "docs/c.md:1: is not JSON", "docs/d.md:1: names the schema")


class Api(Tree):
    def setUp(self):
        super().setUp()
        self.write("config/schemas/port.schema.json", json.dumps(Json.SCHEMA))
        self.body = {"schema": {"$ref": "schemas/port.schema.json"}, "example": {"port": 5}}
        self.api = {
            "openapi": "3.1.0",
            "jsonSchemaDialect": Json.SCHEMA["$schema"],
            "paths": {
                "/a/{id}": {
                    "post": {
                        "operationId": "post_a",
                        "parameters": [{"$ref": "#/components/parameters/id"}],
                        "requestBody": {"content": {"application/json": self.body}},
                        "responses": {"200": {"$ref": "#/components/responses/done"}},
                    }
                }
            },
            "components": {
                "parameters": {"id": {"name": "id", "schema": {"type": "integer"}, "example": 7}},
                "responses": {"done": {"content": {"application/json": dict(self.body)}}},
            },
        }

    def save(self):
        self.write("config/api.json", json.dumps(self.api))

    def test_a_description_of_an_api_with_valid_examples_is_accepted(self):
        self.save()
        self.assertIn("3 examples", self.accepts("json"))

    def test_an_example_that_its_schema_forbids_is_found(self):
        self.body["example"] = {"port": 0}
        self.api["components"]["parameters"]["id"]["example"] = "x"
        self.save()
        self.finds(
            "json",
            "config/api.json: POST /a/{id}, request (application/json): the example is wrong at port: ",
            "config/api.json: POST /a/{id}, parameter id: the example is wrong at the whole document: ",
        )

    def test_a_body_without_an_example_is_found(self):
        del self.api["components"]["responses"]["done"]["content"]["application/json"]["example"]
        self.save()
        self.finds("json", "config/api.json: POST /a/{id}, 200 (application/json): has no schema or no example")

    def test_calls_of_the_same_name_are_found(self):
        self.api["paths"]["/b"] = self.api["paths"]["/a/{id}"]
        self.save()
        self.finds("json", "config/api.json: operationId post_a: each call has one, and its own")

    def test_another_dialect_is_found(self):
        self.api["jsonSchemaDialect"] = "https://json-schema.org/draft/2020-12/schema"
        self.save()
        self.finds("json", "config/api.json: a description of an API says")


class Docs(Tree):
    def setUp(self):
        super().setUp()
        self.write("io/x.hpp", "one\ntwo\nthree\n")
        self.write("docs/other.md", "# A heading\n\n## Second (part 2)\n")
        self.write(
            "README.md",
            "# Top\n[a](docs/other.md) [b](docs/other.md#second-part-2) [c](#top)\n"
            "[d](http://example.org/none) `[e](none)`\n"
            "```cpp file=io/x.hpp\ntwo\nthree\n```\n```\n[f](none)\n```\n",
        )

    def test_good_documents_are_accepted(self):
        self.assertIn("3 links, 1 quoted files", self.accepts("docs"))

    def test_a_dead_link_is_found(self):
        self.write("docs/bad.md", "[a](../none.md)\n\n[b](other.md#none)\n[c](/README.md)\n\n[d]: none.txt\n")
        self.finds("docs", "docs/bad.md:1: ", "docs/bad.md:3: ", "docs/bad.md:4: ", "docs/bad.md:6: ")

    def test_a_quote_that_differs_is_found(self):
        for body in ("one\nthree\n", "wo\nthree\n", "", "one\ntwo\nthree\nfour\n"):
            self.write("CONTRIBUTING.md", f"```cpp file=io/x.hpp\n{body}```\n")
            self.finds("docs", "CONTRIBUTING.md:1: ")

    def test_a_quote_of_a_missing_file_is_found(self):
        self.write("CONTRIBUTING.md", "```cpp file=io/none.hpp\none\n```\n")
        self.finds("docs", "quotes io/none.hpp, which does not exist")

    def test_a_document_that_a_comment_names_and_that_is_gone_is_found(self):
        self.write("io/why.hpp", "#pragma once\n// Why: docs/other.md.\n// Why: docs/gone.md.\n")
        self.assertNotIn("docs/other.md", self.finds("docs", "io/why.hpp:3: names docs/gone.md"))

    def test_a_folder_over_its_budget_of_words_is_found(self):
        self.write("docs/decisions/long.md", "word " * 14_500)
        self.accepts("docs")
        self.write("docs/decisions/more.md", "word\n")
        self.finds("docs", "docs/decisions: has 14501 words")


@unittest.skipUnless(shutil.which("clang-tidy-14") and shutil.which("clang++-14"), "clang-tidy-14 is not installed")
class Tidy(Tree):
    GOOD = (
        "namespace godwit {\n#define GODWIT_ONE 1\ntemplate <class Value>\nclass some_class {\npublic:\n"
        "  Value value() const { return value_; }\nprivate:\n  Value value_{GODWIT_ONE};\n};\n"
        "int answer() { return some_class<int>{}.value(); }\n} // namespace godwit\n"
    )

    def check(self, name, code):
        shutil.copy(ROOT / ".clang-tidy", self.root / ".clang-tidy")
        self.write("io/unit.cpp", code)
        file = str(self.root / "io/unit.cpp")
        command = f"clang++-14 -std=c++20 -I{self.root} -o unit.o -c {file}"
        commands = [{"directory": str(self.root), "command": command, "file": file}]
        self.write("build/lint/compile_commands.json", json.dumps(commands))
        return self.run_check("tidy", f"--{name}")

    def test_good_code_is_accepted_and_remembered(self):
        first = self.check("full", self.GOOD)
        self.assertEqual(first.returncode, 0, first.stdout)
        self.assertIn("1 looked at now", first.stdout)
        self.assertIn("0 looked at now", self.check("full", self.GOOD).stdout)

    def test_names_and_defects_are_found(self):
        for good, bad, rule in (
            ("some_class", "SomeClass", "readability-identifier-naming"),
            ("value_", "amount", "readability-identifier-naming"),
            ("Value", "value_type", "readability-identifier-naming"),
            ("answer", "theAnswer", "readability-identifier-naming"),
            ("GODWIT_ONE", "ONE", "readability-identifier-naming"),
            ("int answer()", "int* nothing = 0;\nint answer()", "modernize-use-nullptr"),
        ):
            result = self.check("full", self.GOOD.replace(good, bad))
            self.assertEqual(result.returncode, 1, bad)
            self.assertIn(rule, result.stdout)

    def test_a_file_that_is_not_compiled_is_found(self):
        self.write("runtime/lost.cpp", "")
        self.assertIn("runtime/lost.cpp: no CMakeLists.txt names this file", self.check("full", self.GOOD).stdout)

    def git(self, *words, hour=12):
        identity = ("-c", "user.name=test", "-c", "user.email=test@example.org", "-c", "commit.gpgsign=false")
        environment = {**os.environ, "GIT_COMMITTER_DATE": f"2026-01-01T{hour:02}:00:00Z"}
        subprocess.run(["git", *identity, *words], cwd=self.root, check=True, capture_output=True, env=environment)

    def land(self):
        """A landed commit of 6 o'clock with the unit in it."""
        self.write(".gitignore", "build/\n")
        self.check("full", self.GOOD)
        self.git("init", "-q")
        self.git("add", ".")
        self.git("commit", "-q", "-m", "landed", hour=6)
        self.git("update-ref", "refs/remotes/origin/main", "HEAD")

    def test_only_what_changed_since_the_landed_commit_is_looked_at(self):
        self.land()
        self.git("commit", "-q", "--allow-empty", "-m", "new", hour=7)
        self.assertIn("0 of 1 files", self.check("changed", self.GOOD).stdout)
        self.assertIn("1 of 1 files", self.check("changed", self.GOOD + "\n").stdout)

    def test_where_all_is_landed_the_last_round_of_work_is_looked_at(self):
        self.land()
        self.git("commit", "-q", "--allow-empty", "-m", "new", hour=11)
        self.git("update-ref", "refs/remotes/origin/main", "HEAD")
        self.assertIn("0 of 1 files", self.check("changed", self.GOOD).stdout)
        self.write("io/unit.cpp", self.GOOD + "\n")
        self.git("commit", "-q", "-a", "-m", "newer", hour=14)
        self.git("update-ref", "refs/remotes/origin/main", "HEAD")
        self.assertIn("1 of 1 files", self.check("changed", self.GOOD + "\n").stdout)

    def test_without_an_older_commit_everything_is_looked_at(self):
        self.land()
        self.assertIn("1 of 1 files", self.check("changed", self.GOOD).stdout)


class Shell(Tree):
    def run_script(self, name, path, text):
        self.write(path, text)
        command = [str(ROOT / "scripts" / name), str(self.root / path)]
        return subprocess.run(command, capture_output=True, timeout=60, check=False).returncode

    @unittest.skipUnless(shutil.which("shellcheck"), "shellcheck is not installed")
    def test_shellcheck_finds_a_careless_script(self):
        self.assertEqual(self.run_script("check_scripts", "good", "#!/usr/bin/env bash\necho 'x'\n"), 0)
        self.assertEqual(self.run_script("check_scripts", "bad", "#!/usr/bin/env bash\nrm $1\n"), 1)

    @unittest.skipUnless(shutil.which("clang-format-14"), "clang-format-14 is not installed")
    def test_clang_format_finds_a_careless_file(self):
        shutil.copy(ROOT / ".clang-format", self.root / ".clang-format")
        self.assertEqual(self.run_script("check_format", "io/good.cpp", "int* x = nullptr;\n"), 0)
        self.assertEqual(self.run_script("check_format", "io/bad.cpp", "int *x=nullptr ;\n"), 1)


class Requirements(Tree):
    def page(self, proof, requirement="X1", more=""):
        self.write("docs/requirements.md", f"| Id | R | P |\n|---|---|---|\n| XX{requirement[1:]} | words | {proof} |\n{more}")

    def setUp(self):
        super().setUp()
        self.write("tests/a_test.cpp", "TEST(kite, flies) {}\nTEST_P(kite, falls) {}\nRC_GTEST_PROP(line, holds, ()) {}\n")
        self.write("tests/b_test.py", "class Wind(unittest.TestCase):\n    def test_it_blows(self):\n        pass\n")
        self.write("tests/CMakeLists.txt", "add_test(NAME drill.flight COMMAND x)\nforeach(script checks demo)\n")

    def test_each_kind_of_test_can_be_named(self):
        self.page("`kite.flies`, `kite.falls`, `line.holds`, `Wind.test_it_blows`, `drill.flight`, `scripts.demo`, `kite.*`")
        self.assertIn("1 requirements, 7 tests named", self.accepts("requirements"))

    def test_a_test_that_does_not_exist_is_found(self):
        self.page("`kite.flies`, `kite.sinks`, `boat.*`")
        self.finds("requirements", "there is no test kite.sinks", "there is no test boat.*")

    def test_a_name_in_a_comment_is_no_test(self):
        self.write("tests/a_test.cpp", "// TEST(kite, flies) {}\n")
        self.page("`kite.flies`")
        self.finds("requirements", "there is no test kite.flies")

    def test_a_row_names_a_test_or_a_gap(self):
        self.page("open: roadmap, Pieces")
        self.accepts("requirements")
        self.page("surely")
        self.finds("requirements", "XX1 names no test and no gap")

    def test_an_id_stands_once(self):
        self.page("`kite.flies`", more="| XX1 | again | `kite.falls` |\n")
        self.finds("requirements", "XX1 stands twice")

    def test_a_test_that_another_page_names_exists(self):
        self.page("`kite.flies`")
        self.write("docs/kite.md", "| Rule | Tests |\n|---|---|\n| flies | `kite.flies`, `line.*`, [a_test.cpp](../tests/a_test.cpp), `a_test.cpp` |\n")
        self.assertIn("2 on other pages", self.accepts("requirements"))
        self.write("docs/kite.md", "| Rule | Test |\n|---|---|\n| flies | `kite.flies` |\n| sinks | `kite.sinks` |\n")
        self.finds("requirements", "docs/kite.md:4: there is no test kite.sinks")
        self.write("docs/kite.md", "## Requirements\n\n- It flies: `kite.flies`\n- It sinks: `kite.sinks`\n\n## Bounds\n\n- `a.b`: 1\n")
        self.finds("requirements", "docs/kite.md:4: there is no test kite.sinks")

    def test_a_page_without_rows_is_no_page(self):
        self.write("docs/requirements.md", "# Requirements\n")
        self.finds("requirements", "there is no requirement")


class Configuration(Tree):
    def setUp(self):
        super().setUp()
        self.write_schema("The link.")
        self.write("programs/godwitd/configuration.hpp", 'option_row{"vehicle", "/vehicle/uri", option_kind::text, "URI", ""},\n')
        (self.root / "docs").mkdir()

    def write_schema(self, description):
        uri = {"type": "string", "description": description, "default": ""}
        system = {"type": "integer", "description": "Its id.", "minimum": 0, "maximum": 255, "default": 0}
        vehicle = {"description": "The vehicle.", "properties": {"uri": uri, "system": system}}
        self.write("config/godwit.schema.json", json.dumps({"properties": {"vehicle": vehicle}}))

    def test_the_page_that_it_writes_is_accepted_and_names_defaults_ranges_and_options(self):
        self.assertIn("2 settings", self.accepts("configuration", "--fix"))
        self.accepts("configuration")
        page = (self.root / "docs/configuration.md").read_text(encoding="utf-8")
        self.assertIn("- **uri**, `--vehicle`: none. The link.", page)
        self.assertIn("- **system**: `0` (0..255). Its id.", page)
        defaults = (self.root / "config/godwit.json").read_text(encoding="utf-8")
        self.assertIn('    // Its id. (0..255)\n    "system": 0\n', defaults)

    def test_a_page_of_another_schema_is_found(self):
        self.finds("configuration", "docs/configuration.md: is not what the schema", "config/godwit.json: is not what the schema")
        self.accepts("configuration", "--fix")
        self.write_schema("The link to the autopilot.")
        self.finds("configuration", "docs/configuration.md: is not what the schema")


if __name__ == "__main__":
    unittest.main()
