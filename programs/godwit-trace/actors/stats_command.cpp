// godwit-trace stats: how long messages waited and how long they were handled, apart, by actor and type.
#include <algorithm>
#include <array>
#include <map>

#include "io/fields/json_text.hpp"
#include "programs/godwit-trace/actors/latency.hpp"
#include "programs/godwit-trace/actors/text_forms.hpp"
#include "programs/godwit-trace/actors/trace_arguments.hpp"
#include "programs/godwit-trace/commands.hpp"

namespace godwit::trace_tool {

namespace {

using runtime::delivery;

struct stats_arguments {
  trace_arguments trace;
  filter_arguments filter;
  bool histogram = false;
};

struct stats_row {
  latency_histogram waiting;
  latency_histogram handling;
};

using stats_rows = std::map<std::pair<std::uint32_t, std::uint32_t>, stats_row>; // by actor and type

constexpr double median = 0.5;
constexpr double nearly_all = 0.99;

std::string quantile(const latency_histogram& of, double part) {
  return of.count() == 0 ? "-" : duration_text(of.quantile_ns(part));
}

void append_table(std::string& out, const stats_rows& rows, const runtime::name_table& names) {
  text_table table({{"ACTOR", false},
                    {"TYPE", false},
                    {"COUNT"},
                    {"WAIT p50"},
                    {"p99"},
                    {"MAX"},
                    {"HANDLING p50"},
                    {"p99"},
                    {"MAX"},
                    {"SUM"}});
  std::vector<const stats_rows::value_type*> sorted;
  for (const auto& each : rows)
    sorted.push_back(&each);
  std::ranges::stable_sort(sorted, [](const auto* a, const auto* b) {
    return a->second.handling.total_ns() > b->second.handling.total_ns();
  });
  for (const auto* each : sorted) {
    const auto& [key, row] = *each;
    const auto& [waiting, handling] = row;
    table.add({names.name(key.first), names.name(key.second), std::to_string(handling.count()),
               quantile(waiting, median), quantile(waiting, nearly_all), quantile(waiting, 1),
               quantile(handling, median), quantile(handling, nearly_all), quantile(handling, 1),
               duration_text(handling.total_ns())});
  }
  table.append_to(out);
}

void append_bars(std::string& out, const char* title, const latency_histogram& of) {
  constexpr std::uint64_t widest = 50;
  const auto counts = of.by_doubling();
  const auto most = counts.empty() ? 0 : *std::ranges::max_element(counts);
  out.append("\n").append(title).append("\n");
  bool has_begun = false;
  for (std::size_t n = 0; n < counts.size(); ++n) {
    has_begun = has_begun || counts[n] > 0;
    if (!has_begun)
      continue;
    auto from = duration_text(std::int64_t{1} << n);
    from.insert(0, from.size() < 8 ? 8 - from.size() : 0, ' ');
    const auto width = (counts[n] * widest + most - 1) / most;
    out.append(from).append(" ").append(static_cast<std::size_t>(width), '#').append(" ");
    out.append(std::to_string(counts[n])).append("\n");
  }
}

void append_histogram_json(std::string& out, const char* name, const latency_histogram& of) {
  out.append(",\"").append(name).append(R"(":{"count":)").append(std::to_string(of.count()));
  out.append(R"(,"p50_ns":)").append(std::to_string(of.quantile_ns(median)));
  out.append(R"(,"p99_ns":)").append(std::to_string(of.quantile_ns(nearly_all)));
  out.append(R"(,"max_ns":)").append(std::to_string(of.max_ns()));
  out.append(R"(,"sum_ns":)").append(std::to_string(of.total_ns())).append("}");
}

void append_rows_json(std::string& out, const stats_rows& rows, const runtime::name_table& names) {
  for (const auto& [key, row] : rows) {
    out += R"({"actor":)";
    io::append_json_string(out, names.name(key.first));
    out += R"(,"type":)";
    io::append_json_string(out, names.name(key.second));
    append_histogram_json(out, "waiting", row.waiting);
    append_histogram_json(out, "handling", row.handling);
    out += "}\n";
  }
}

exit_code run_stats(const stats_arguments& given, console& to) {
  auto trace = open_trace(given.trace, to);
  if (!trace) {
    to.say(trace.error());
    return exit_code::failed;
  }
  delivery_filter filter(given.filter);
  recent_handlers recent;
  stats_rows rows;
  stats_row all;
  delivery each;
  while ((*trace)->ordered.next(each)) {
    const auto waited_ns = recent.waiting_ns(each);
    if (!filter.wants(each, (*trace)->names))
      continue;
    auto& row = rows[{each.actor, each.type}];
    row.handling.add(each.duration_ns);
    if (given.histogram)
      all.handling.add(each.duration_ns);
    if (!waited_ns)
      continue;
    row.waiting.add(*waited_ns);
    if (given.histogram)
      all.waiting.add(*waited_ns);
  }
  auto& out = to.out.text();
  if (given.trace.json) {
    append_rows_json(out, rows, (*trace)->names);
  } else {
    append_table(out, rows, (*trace)->names);
    if (given.histogram) {
      append_bars(out, "WAITING (from this on)", all.waiting);
      append_bars(out, "HANDLING (from this on)", all.handling);
    }
  }
  report_losses((*trace)->reader, to);
  return exit_code::ok;
}

} // namespace

command add_stats_command(CLI::App& to) {
  auto* const app = to.add_subcommand("stats", "Waiting and handling times, by actor and type of message.");
  const auto given = std::make_shared<stats_arguments>();
  add_trace_arguments(*app, given->trace);
  add_filter_arguments(*app, given->filter);
  app->add_flag("--histogram", given->histogram, "Draw how the times of all that is shown are spread");
  app->footer(
      R"(WAIT is from the end of the handler that sent a message to the begin of its own: the mailbox, and the disk where a
message waits for it. What an actor sends itself (timers) has none. Values are exact to 6 %.

Examples:
  godwit-trace stats trace
  godwit-trace stats trace --actor executor --histogram)");
  return {app, [given](console& into) { return run_stats(*given, into); }, always};
}

} // namespace godwit::trace_tool
