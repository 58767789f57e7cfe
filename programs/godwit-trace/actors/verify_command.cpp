// godwit-trace verify: whether the record of a run shows what godwit promises (invariants/).
#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "invariants/checker.hpp"
#include "io/fields/json_text.hpp"
#include "programs/godwit-trace/actors/dead_letters.hpp"
#include "programs/godwit-trace/actors/text_forms.hpp"
#include "programs/godwit-trace/actors/trace_arguments.hpp"
#include "programs/godwit-trace/commands.hpp"

namespace godwit::trace_tool {

namespace {

using invariants::judged;
using invariants::verdict;

struct verify_arguments {
  trace_arguments trace;
  std::string journal; // empty: none is looked into
  bool list = false;
};

void append_ids(std::string& out, const invariants::finding& each) {
  for (std::size_t n = 0; n < each.ids.size(); ++n)
    out.append(n == 0 ? " #" : ", #").append(std::to_string(each.ids[n]));
}

// Of a promise that is undecided.
std::string_view what_is_missing(const judged& each, bool has_journal, bool has_deliveries) {
  if (!has_deliveries)
    return "there is no message in the record: it was cut off, or nothing has run\n";
  if (each.which->asks_journal && !has_journal)
    return "it is about the journal: name it with --journal\n";
  return each.findings.empty() ? "records are missing\n" : "what is missing in the record may explain it\n";
}

void append_judged(std::string& out, const judged& each, bool has_journal, bool has_deliveries, const paint& colours) {
  constexpr std::size_t width = 10;
  constexpr std::size_t max_shown = 10;
  std::string word(io::name_of(each.how));
  word.resize(width, ' ');
  out.append(each.how == verdict::held ? colours.good() : colours.bad()).append(word).append(colours.end());
  out.append(colours.type()).append(each.which->name).append(colours.end()).append(": ");
  out.append(each.which->requirement).append("\n");
  for (std::size_t n = 0; n < std::min(each.findings.size(), max_shown); ++n) {
    const auto& found = each.findings[n];
    out.append(width, ' ').append(utc_ns(found.at_ns)).append(" run ").append(std::to_string(found.run)).append(": ");
    append_printable(out, found.what);
    append_ids(out, found);
    out += '\n';
  }
  const auto more = each.findings.size() - std::min(each.findings.size(), max_shown) + each.more;
  if (more > 0)
    out.append(width, ' ').append("and ").append(std::to_string(more)).append(" more\n");
  if (each.how == verdict::undecided)
    out.append(width, ' ').append(what_is_missing(each, has_journal, has_deliveries));
}

void append_json(std::string& out, const judged& each) {
  out.append(R"({"name":")").append(each.which->name).append(R"(","requirement":)");
  io::append_json_string(out, each.which->requirement);
  out += R"(,"where":)";
  io::append_json_string(out, each.which->where);
  out.append(R"(,"verdict":")").append(io::name_of(each.how)).append(R"(","findings":[)");
  for (std::size_t n = 0; n < each.findings.size(); ++n) {
    const auto& found = each.findings[n];
    out.append(n == 0 ? "" : ",").append(R"({"run":)").append(std::to_string(found.run));
    out.append(R"(,"time_ns":)").append(std::to_string(found.at_ns)).append(R"(,"ids":[)");
    for (std::size_t i = 0; i < found.ids.size(); ++i)
      out.append(i == 0 ? "" : ",").append(std::to_string(found.ids[i]));
    out += R"(],"what":)";
    io::append_json_string(out, found.what);
    out += '}';
  }
  out.append(R"(],"more":)").append(std::to_string(each.more)).append("}\n");
}

exit_code run_list(console& to) {
  for (const auto& each : invariants::all_rules()) {
    auto& out = to.out.text();
    out.append(each.name).append(": ").append(each.requirement).append(" (").append(each.where).append(")\n");
  }
  return exit_code::ok;
}

exit_code run_verify(const verify_arguments& given, console& to) {
  if (given.list)
    return run_list(to);
  auto trace = open_trace(given.trace, to);
  if (!trace) {
    to.say(trace.error());
    return exit_code::failed;
  }
  invariants::checker checker;
  std::set<std::uint32_t> actors;
  runtime::delivery each;
  while ((*trace)->ordered.next(each)) {
    checker.take(each, (*trace)->names);
    actors.insert(each.actor);
  }
  if (!given.journal.empty()) { // after the trace, so that it is not older
    std::vector<std::string> names;
    for (const auto number : actors)
      names.push_back((*trace)->names.name(number));
    const auto journal = read_journal_record(given.journal, names);
    if (!journal) {
      to.say(journal.error());
      return exit_code::failed;
    }
    checker.take_journal(*journal);
  }
  for (const auto& lost : (*trace)->reader.losses())
    if (lost.is_hole)
      checker.note_hole(lost.run);
  const paint colours(to.is_terminal);
  bool is_violated = false;
  for (const auto& one : checker.judge()) {
    is_violated = is_violated || one.how == verdict::violated;
    if (given.trace.json)
      append_json(to.out.text(), one);
    else
      append_judged(to.out.text(), one, !given.journal.empty(), !actors.empty(), colours);
  }
  report_losses((*trace)->reader, to);
  return is_violated ? exit_code::failed : exit_code::ok;
}

} // namespace

command add_verify_command(CLI::App& to) {
  auto* const app = to.add_subcommand("verify", "Proves what godwit promises on the record of a run.");
  const auto given = std::make_shared<verify_arguments>();
  add_trace_arguments(*app, given->trace);
  app->add_option("--journal", given->journal, "Looks into this journal, too, for what is promised of it")
      ->type_name("FILE");
  app->add_flag("--list", given->list, "Only lists what is checked");
  app->get_option("TRACE")->required(false);
  app->footer(
      R"(held: it is so in all that was recorded. violated: the messages that are named show it. undecided: records are
missing where it would show, or it is about the journal and none was named. The exit code is 1 when one is violated.

Examples:
  godwit-trace verify trace
  godwit-trace verify trace --json | jq -r 'select(.verdict != "held") | .name'
  godwit-trace verify --list)");
  return {app, [given](console& into) {
            if (!given->list && given->trace.paths.empty()) {
              into.say("TRACE is required");
              return exit_code::usage;
            }
            return run_verify(*given, into);
          }};
}

} // namespace godwit::trace_tool
