// godwit-trace diff: where two runs part.
#include <map>

#include <nlohmann/json.hpp>

#include "io/fields/json_text.hpp"
#include "programs/godwit-trace/actors/run_difference.hpp"
#include "programs/godwit-trace/actors/text_forms.hpp"
#include "programs/godwit-trace/actors/trace_arguments.hpp"
#include "programs/godwit-trace/commands.hpp"

namespace godwit::trace_tool {

namespace {

using nlohmann::json;
using runtime::delivery;

struct diff_arguments {
  std::string a;
  std::string b;
  std::optional<std::uint64_t> run_a;
  std::optional<std::uint64_t> run_b;
  std::vector<std::string> ignored;
  bool json = false;
};

// One side: its trace, and the one run of it that is compared.
struct side {
  trace_arguments where;

  side(const std::string& path, std::optional<std::uint64_t> run) {
    where.paths = {path};
    where.run = run;
  }
};

// Gives each delivery of the first run to DO.
tl::expected<void, std::string> for_each_of_run(const side& of, console& to, const auto& run) {
  auto trace = open_trace(of.where, to);
  if (!trace)
    return tl::unexpected(trace.error());
  delivery each;
  std::optional<std::uint64_t> first;
  while ((*trace)->ordered.next(each)) {
    if (each.run != first.value_or(each.run))
      return tl::unexpected(of.where.paths[0] + " has several runs; choose one with --run-a or --run-b");
    first = each.run;
    run(each, (*trace)->names);
  }
  if (!first)
    return tl::unexpected(of.where.paths[0] + ": there are no messages in it");
  report_losses((*trace)->reader, to);
  return {};
}

// A delivery as it is shown, fetched by its number.
struct shown {
  std::string line;
  std::string json_line;
  json message;
};

std::optional<shown> fetch(const side& of, console& to, std::optional<std::uint64_t> number, const paint& colours) {
  std::optional<shown> result;
  if (!number)
    return result;
  std::uint64_t at = 0;
  (void)for_each_of_run(of, to, [&](const delivery& each, const runtime::name_table& names) {
    if (at++ != *number)
      return;
    result.emplace();
    append_line(result->line, each, names, colours);
    append_json_line(result->json_line, each, names);
    result->message = json::parse(each.body, nullptr, false);
  });
  return result;
}

void append_fields(std::string& out, const json& a, const json& b) {
  if (a.is_discarded() || b.is_discarded())
    return;
  const auto before = a.flatten();
  const auto after = b.flatten();
  const auto text = [](const json& of, const std::string& key) {
    return of.contains(key) ? of[key].dump(-1, ' ', false, json::error_handler_t::replace) : std::string("(absent)");
  };
  std::map<std::string, bool> keys;
  for (const auto* each : {&before, &after})
    for (const auto& [key, value] : each->items())
      keys[key] = true;
  for (const auto& [key, is_there] : keys)
    if (text(before, key) != text(after, key)) {
      out += "  ";
      append_printable(out, key + ": " + text(before, key) + " in A, " + text(after, key) + " in B");
      out += '\n';
    }
}

void append_text(std::string& out, const difference& found, const std::optional<shown>& a,
                 const std::optional<shown>& b) {
  out += "the runs part at message " + std::to_string(found.index + 1) + " of " + found.stream + "; " +
         std::to_string(found.streams_that_differ) + " ways between actors differ from somewhere on\n";
  out += "A: " + (a ? a->line : std::string("nothing more came\n"));
  out += "B: " + (b ? b->line : std::string("nothing more came\n"));
  if (a && b)
    append_fields(out, a->message, b->message);
  if (!found.a_symptoms.empty())
    out += std::to_string(found.a_symptoms.size()) + " older differences came of this one\n";
}

void append_json(std::string& out, const difference& found, const std::optional<shown>& a,
                 const std::optional<shown>& b) {
  out += R"({"same":false,"stream":)";
  io::append_json_string(out, found.stream);
  out += R"(,"index":)" + std::to_string(found.index) + R"(,"streams_that_differ":)" +
         std::to_string(found.streams_that_differ) + R"(,"a":)" + (a ? a->json_line : "null") + R"(,"b":)" +
         (b ? b->json_line : "null") + "}\n";
}

exit_code run_diff(const diff_arguments& given, console& to) {
  const side a(given.a, given.run_a);
  const side b(given.b, given.run_b);
  compared_run in_a(given.ignored);
  compared_run in_b(given.ignored);
  const auto read = [&](const side& of, compared_run& into) {
    return for_each_of_run(of, to,
                           [&](const delivery& each, const runtime::name_table& names) { into.add(each, names); });
  };
  if (const auto done = read(a, in_a).and_then([&] { return read(b, in_b); }); !done) {
    to.say(done.error());
    return exit_code::usage;
  }
  const auto found = first_difference(in_a, in_b);
  auto& out = to.out.text();
  if (!found) {
    out += given.json ? "{\"same\":true}\n" : "the runs are the same: " + std::to_string(in_a.count()) + " messages\n";
    return exit_code::ok;
  }
  const paint colours(to.is_terminal);
  const auto shown_a = fetch(a, to, found->a_number, colours);
  const auto shown_b = fetch(b, to, found->b_number, colours);
  if (given.json)
    append_json(out, *found, shown_a, shown_b);
  else
    append_text(out, *found, shown_a, shown_b);
  return exit_code::failed;
}

} // namespace

command add_diff_command(CLI::App& to) {
  auto* const app = to.add_subcommand("diff", "Shows where two runs differ first.");
  const auto given = std::make_shared<diff_arguments>();
  app->add_option("A", given->a, "One trace: a folder or a file")->required();
  app->add_option("B", given->b, "The other one")->required();
  app->add_option("--run-a", given->run_a, "The run of A, where there are several")->type_name("N");
  app->add_option("--run-b", given->run_b, "The run of B")->type_name("N");
  app->add_option("--ignore", given->ignored, "Fields that are not compared, at any depth")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("FIELD,...");
  app->add_flag("--json", given->json, "One JSON object instead of text");
  app->footer(
      R"(Compared is what each actor took from each sender, in order; not times and ids. Shown is the first cause: what came
of it later differs too. The exit code is 0 when the runs are the same, 1 when they part, 2 when they can not be compared.

Examples:
  godwit-trace diff before/trace after/trace --ignore time_boot_ms,time_usec
  godwit-trace diff trace trace --run-a 1 --run-b 2 --json)");
  return {app, [given](console& into) { return run_diff(*given, into); }, always};
}

} // namespace godwit::trace_tool
