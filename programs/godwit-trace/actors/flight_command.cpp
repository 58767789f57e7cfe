// godwit-trace flight: the flight on one page, for people.
#include "io/fields/json_text.hpp"
#include "io/time_units.hpp"
#include "programs/godwit-trace/actors/flight_events.hpp"
#include "programs/godwit-trace/actors/link_frames.hpp"
#include "programs/godwit-trace/actors/text_forms.hpp"
#include "programs/godwit-trace/actors/trace_arguments.hpp"
#include "programs/godwit-trace/commands.hpp"
#include "programs/godwit-trace/message_forms.hpp"
#include "programs/godwit-trace/utc_time.hpp"

namespace godwit::trace_tool {

namespace {

struct flight_arguments {
  trace_arguments trace;
  link_arguments link;
};

// What people and programs ask of a vehicle, and what it answers.
constexpr const char* names_of_interest = "COMMAND_LONG,COMMAND_INT,COMMAND_ACK,SET_MODE,MISSION_COUNT,MISSION_ACK,"
                                          "MISSION_SET_CURRENT,MISSION_CLEAR_ALL,STATUSTEXT";

void append_head(std::string& out, std::int64_t at_ns, std::int64_t begin_ns, std::string matter,
                 const paint& colours) {
  constexpr std::size_t column = 9;
  append_utc_ns(out, at_ns);
  std::string since;
  append_seconds(since, (at_ns - begin_ns) / ns_per_us);
  constexpr std::size_t width = 12;
  out.append(width - std::min(width, since.size()), ' ').append(since).append(" ");
  matter.resize(column, ' ');
  out.append(colours.faint()).append(matter).append(colours.end());
}

void append_event(std::string& out, const flight_event& each, std::int64_t begin_ns, const paint& colours) {
  append_head(out, each.at_ns, begin_ns, std::string(io::name_of(each.matter)), colours);
  out += each.is_bad ? colours.bad() : "";
  append_printable(out, each.sentence);
  out.append(each.is_bad ? colours.end() : "").append("\n");
}

void append_frame(std::string& out, const link_frame& each, std::int64_t begin_ns, const paint& colours) {
  append_head(out, each.at_ns, begin_ns, "link", colours);
  out.append(*each.link).append(" <- ").append(std::to_string(each.frame.from().system)).append("/");
  out.append(std::to_string(each.frame.from().component)).append(" ");
  append_message_text(out, each.frame);
  out += '\n';
}

void append_json(std::string& out, const flight_event& each) {
  out += R"({"time":")" + utc_ns(each.at_ns) + R"(","time_ns":)" + std::to_string(each.at_ns) + R"(,"run":)" +
         std::to_string(each.run) + R"(,"id":)" + std::to_string(each.id) + R"(,"matter":")";
  out.append(io::name_of(each.matter)).append(R"(","is_bad":)").append(each.is_bad ? "true" : "false");
  out += R"(,"sentence":)";
  io::append_json_string(out, each.sentence);
  out += "}\n";
}

exit_code run_flight(const flight_arguments& given, console& to) {
  auto trace = open_trace(given.trace, to);
  if (!trace) {
    to.say(trace.error());
    return exit_code::failed;
  }
  auto wanted = given.link;
  if (wanted.names.empty())
    wanted.names.emplace_back(names_of_interest);
  auto frames = open_links(wanted, **trace);
  if (!frames) {
    to.say(frames.error());
    return exit_code::usage;
  }
  const paint colours(to.is_terminal);
  flight_events events((*trace)->names);
  std::int64_t begin_ns = 0;
  const auto print_frame = [&](const link_frame& frame) {
    given.trace.json ? append_frame_json_line(to.out.text(), frame)
                     : append_frame(to.out.text(), frame, begin_ns, colours);
  };
  runtime::delivery each;
  while (to.out.flush_if_full() && (*trace)->ordered.next(each)) {
    begin_ns = begin_ns == 0 ? each.began_ns : begin_ns;
    while (const auto frame = frames->next_until(each.run, each.began_ns))
      print_frame(*frame);
    const auto event = events.take(each);
    if (!event)
      continue;
    if (given.trace.json)
      append_json(to.out.text(), *event);
    else
      append_event(to.out.text(), *event, begin_ns, colours);
  }
  while (const auto frame = frames->next())
    print_frame(*frame);
  report_losses((*trace)->reader, to);
  report_problems(*frames, to);
  return exit_code::ok;
}

} // namespace

command add_flight_command(CLI::App& to) {
  auto* const app = to.add_subcommand("flight", "Shows the flight on one time line, for people.");
  const auto given = std::make_shared<flight_arguments>();
  add_trace_arguments(*app, given->trace);
  add_link_arguments(*app, given->link);
  app->footer(
      R"(Phases, who has the vehicle, modes, commands, plans, failsafes, restarts, reports, and what the vehicle says. Phases
are known from what was told to those who asked: the control socket and ground stations. With --links also commands,
answers, modes, plans and texts as they went over the links, or what --name says.

Examples:
  godwit-trace flight trace
  godwit-trace flight trace --links
  godwit-trace flight trace --json | jq -r 'select(.is_bad) | .sentence')");
  return {app, [given](console& into) { return run_flight(*given, into); }, always};
}

} // namespace godwit::trace_tool
