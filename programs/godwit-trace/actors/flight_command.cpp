// godwit-trace flight: the flight on one page, for people.
#include "io/fields/json_text.hpp"
#include "programs/godwit-trace/actors/flight_events.hpp"
#include "programs/godwit-trace/actors/text_forms.hpp"
#include "programs/godwit-trace/actors/trace_arguments.hpp"
#include "programs/godwit-trace/commands.hpp"
#include "programs/godwit-trace/utc_time.hpp"

namespace godwit::trace_tool {

namespace {

void append_event(std::string& out, const flight_event& each, std::int64_t begin_ns, const paint& colours) {
  constexpr std::int64_t ns_per_us = 1'000;
  constexpr std::size_t column = 9;
  append_utc_ns(out, each.at_ns);
  std::string since;
  append_seconds(since, (each.at_ns - begin_ns) / ns_per_us);
  constexpr std::size_t width = 12;
  out.append(width - std::min(width, since.size()), ' ').append(since).append(" ");
  std::string matter(io::name_of(each.matter));
  matter.resize(column, ' ');
  out.append(colours.faint()).append(matter).append(colours.end());
  out += each.is_bad ? colours.bad() : "";
  append_printable(out, each.sentence);
  out.append(each.is_bad ? colours.end() : "").append("\n");
}

void append_json(std::string& out, const flight_event& each) {
  out += R"({"time":")" + utc_ns(each.at_ns) + R"(","time_ns":)" + std::to_string(each.at_ns) + R"(,"run":)" +
         std::to_string(each.run) + R"(,"id":)" + std::to_string(each.id) + R"(,"matter":")";
  out.append(io::name_of(each.matter)).append(R"(","is_bad":)").append(each.is_bad ? "true" : "false");
  out += R"(,"sentence":)";
  io::append_json_string(out, each.sentence);
  out += "}\n";
}

exit_code run_flight(const trace_arguments& given, console& to) {
  auto trace = open_trace(given, to);
  if (!trace) {
    to.say(trace.error());
    return exit_code::failed;
  }
  const paint colours(to.is_terminal);
  flight_events events((*trace)->names);
  std::int64_t begin_ns = 0;
  runtime::delivery each;
  while (to.out.flush_if_full() && (*trace)->ordered.next(each)) {
    begin_ns = begin_ns == 0 ? each.began_ns : begin_ns;
    const auto event = events.take(each);
    if (!event)
      continue;
    if (given.json)
      append_json(to.out.text(), *event);
    else
      append_event(to.out.text(), *event, begin_ns, colours);
  }
  say_losses((*trace)->reader, to);
  return exit_code::ok;
}

} // namespace

command add_flight_command(CLI::App& to) {
  auto* const app = to.add_subcommand("flight", "Tells the flight on one time line, for people.");
  const auto given = std::make_shared<trace_arguments>();
  add_trace_arguments(*app, *given);
  app->footer(
      R"(Phases, who has the vehicle, modes, commands, plans, failsafes, restarts, reports, and what the vehicle says. Phases
are known from what was told to those who asked: the control socket and ground stations.

Examples:
  godwit-trace flight trace
  godwit-trace flight trace --json | jq -r 'select(.is_bad) | .sentence')");
  return {app, [given](console& into) { return run_flight(*given, into); }};
}

} // namespace godwit::trace_tool
