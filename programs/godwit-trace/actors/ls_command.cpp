// godwit-trace ls: the runs of a trace, and in each which actors there were and how much each of them did.
#include <algorithm>
#include <map>
#include <set>

#include "io/fields/json_text.hpp"
#include "programs/godwit-trace/actors/text_forms.hpp"
#include "programs/godwit-trace/actors/trace_arguments.hpp"
#include "programs/godwit-trace/commands.hpp"

namespace godwit::trace_tool {

namespace {

using runtime::delivery;
using runtime::outcome;

constexpr double ns_a_second = 1e9;

struct actor_row {
  std::uint32_t first_incarnation = UINT32_MAX;
  std::uint32_t last_incarnation = 0;
  std::uint64_t messages = 0;
  std::uint64_t crashed = 0;
  std::uint64_t not_handled = 0; // ended in another way than handled or crashed
  std::int64_t handling_ns = 0;
  std::int64_t longest_ns = 0;

  void add(const delivery& each) {
    first_incarnation = std::min(first_incarnation, each.incarnation);
    last_incarnation = std::max(last_incarnation, each.incarnation);
    ++messages;
    crashed += each.how == outcome::crashed ? 1 : 0;
    not_handled += each.how != outcome::crashed && each.how != outcome::handled ? 1 : 0;
    handling_ns += each.duration_ns;
    longest_ns = std::max(longest_ns, each.duration_ns);
  }
};

struct run_row {
  std::int64_t first_ns = INT64_MAX;
  std::int64_t last_ns = INT64_MIN;
  std::uint64_t messages = 0;
  std::map<std::uint32_t, actor_row> actors; // by the number of the name

  void add(const delivery& each) {
    first_ns = std::min(first_ns, each.began_ns);
    last_ns = std::max(last_ns, each.ended_ns());
    ++messages;
    actors[each.actor].add(each);
  }
  [[nodiscard]] double seconds() const { return static_cast<double>(last_ns - first_ns) / ns_a_second; }
  [[nodiscard]] double rate_hz(std::uint64_t count) const {
    return seconds() > 0 ? static_cast<double>(count) / seconds() : 0;
  }
};

std::string fixed(double value, int decimals) {
  std::array<char, 64> text{};
  const int size = std::snprintf(text.data(), text.size(), "%.*f", decimals, value); // NOLINT(*-vararg)
  return {text.data(), static_cast<std::size_t>(std::max(size, 0))};
}

std::string incarnations(const actor_row& row) {
  const auto first = std::to_string(row.first_incarnation);
  return row.first_incarnation == row.last_incarnation ? first : first + "-" + std::to_string(row.last_incarnation);
}

void append_run(std::string& out, std::uint64_t number, const run_row& run, const runtime::name_table& names) {
  out += "run " + std::to_string(number) + ": " + utc_ns(run.first_ns) + " to " + utc_ns(run.last_ns) + " (" +
         fixed(run.seconds(), 3) + " s), " + std::to_string(run.messages) + " messages\n";
  text_table table({{"ACTOR", false},
                    {"INCARNATION"},
                    {"MESSAGES"},
                    {"HZ"},
                    {"HANDLING"},
                    {"BUSY %"},
                    {"LONGEST"},
                    {"CRASHED"},
                    {"NOT HANDLED"}});
  constexpr double percent = 100;
  for (const auto& [actor, row] : run.actors)
    table.add(
        {names.name(actor), incarnations(row), std::to_string(row.messages), fixed(run.rate_hz(row.messages), 1),
         duration_text(row.handling_ns),
         fixed(run.seconds() > 0 ? percent * static_cast<double>(row.handling_ns) / ns_a_second / run.seconds() : 0, 2),
         duration_text(row.longest_ns), std::to_string(row.crashed), std::to_string(row.not_handled)});
  table.append_to(out);
  out += '\n';
}

void append_run_json(std::string& out, std::uint64_t number, const run_row& run, const runtime::name_table& names) {
  out += R"({"run":)" + std::to_string(number) + R"(,"first_ns":)" + std::to_string(run.first_ns) + R"(,"last_ns":)" +
         std::to_string(run.last_ns) + R"(,"messages":)" + std::to_string(run.messages) + R"(,"actors":[)";
  bool is_first = true;
  for (const auto& [actor, row] : run.actors) {
    out += is_first ? R"({"actor":)" : R"(,{"actor":)";
    is_first = false;
    io::append_json_string(out, names.name(actor));
    out += R"(,"first_incarnation":)" + std::to_string(row.first_incarnation) + R"(,"last_incarnation":)" +
           std::to_string(row.last_incarnation) + R"(,"messages":)" + std::to_string(row.messages) + R"(,"rate_hz":)";
    io::append_json_number(out, run.rate_hz(row.messages));
    out += R"(,"handling_ns":)" + std::to_string(row.handling_ns) + R"(,"longest_ns":)" +
           std::to_string(row.longest_ns) + R"(,"crashed":)" + std::to_string(row.crashed) + R"(,"not_handled":)" +
           std::to_string(row.not_handled) + '}';
  }
  out += "]}";
}

exit_code run_ls(const trace_arguments& given, console& to) {
  auto trace = open_trace(given, to);
  if (!trace) {
    to.say(trace.error());
    return exit_code::failed;
  }
  auto& [names, reader, ordered, span] = **trace;
  std::map<std::uint64_t, run_row> runs;
  delivery each;
  while (reader.next(each)) // the order does not matter here
    runs[each.run].add(each);
  auto& out = to.out.text();
  if (given.json) {
    out += R"({"runs":[)";
    for (auto at = runs.begin(); at != runs.end(); ++at) {
      out += at == runs.begin() ? "" : ",";
      append_run_json(out, at->first, at->second, names);
    }
    out += R"(],"losses":[)";
    for (std::size_t n = 0; n < reader.losses().size(); ++n) {
      out += n == 0 ? "" : ",";
      append_loss_json(out, reader.losses()[n]);
    }
    out += R"(],"files":)" + std::to_string(reader.counts().files) + R"(,"bytes":)" +
           std::to_string(reader.counts().bytes) + "}\n";
    return exit_code::ok;
  }
  for (const auto& [number, run] : runs)
    append_run(out, number, run, names);
  out += std::to_string(reader.counts().files) + " files, " + std::to_string(reader.counts().bytes) + " bytes\n";
  report_losses(reader, to);
  return exit_code::ok;
}

} // namespace

command add_ls_command(CLI::App& to) {
  auto* const app = to.add_subcommand("ls", "Lists what the actors did: runs, actors, counts, time in handlers.");
  const auto given = std::make_shared<trace_arguments>();
  add_trace_arguments(*app, *given);
  app->footer(R"(What the trace does not hold (a cut, damage, drops) is said on stderr.

Examples:
  godwit-trace ls /var/lib/godwit/trace
  godwit-trace ls trace/godwit-0000000002-000001.mcap
  godwit-trace ls trace --json | jq '.runs[].actors[] | select(.crashed > 0)')");
  return {app, [given](console& into) { return run_ls(*given, into); }, always};
}

} // namespace godwit::trace_tool
