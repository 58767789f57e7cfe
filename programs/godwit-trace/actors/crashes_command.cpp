// godwit-trace crashes: each crash with the message that did it, what was before, and how it went on.
#include "io/fields/json_text.hpp"
#include "programs/godwit-trace/actors/crash_list.hpp"
#include "programs/godwit-trace/actors/text_forms.hpp"
#include "programs/godwit-trace/actors/trace_arguments.hpp"
#include "programs/godwit-trace/commands.hpp"

namespace godwit::trace_tool {

namespace {

struct crashes_arguments {
  trace_arguments trace;
  std::size_t before = 5;
};

void append_kept(std::string& out, const kept& each, const runtime::name_table& names, const paint& colours) {
  auto whole = each.what;
  whole.body = each.body;
  out += "  ";
  append_line(out, whole, names, colours);
}

void append_crash(std::string& out, const crash& each, const runtime::name_table& names, const paint& colours) {
  append_utc_ns(out, each.at_ns);
  out.append(" ").append(colours.bad()).append(each.actor).append(", incarnation ");
  out.append(std::to_string(each.incarnation)).append(colours.end()).append(" crashed: ");
  append_printable(out, each.reason.empty() ? std::string_view("nobody told why") : each.reason);
  out.append(" (run ").append(std::to_string(each.run)).append(")\n");
  if (!each.before.empty())
    out += " before it:\n";
  for (const auto& one : each.before)
    append_kept(out, one, names, colours);
  if (each.crashed_on) {
    out += " on:\n";
    append_kept(out, *each.crashed_on, names, colours);
    if (each.delivered_again > 0)
      out += " the message was delivered again " + std::to_string(each.delivered_again) + " times; at last it was " +
             each.last_delivery_ended + '\n';
    else
      out += " the message was not delivered again\n";
  } else {
    out += " not in a handler: killed, stopped as hanging, or outside of a message\n";
  }
  if (each.first_after) {
    out += " went on " + duration_text(each.first_after->what.began_ns - each.at_ns) + " later with incarnation " +
           std::to_string(each.first_after->what.incarnation) + ":\n";
    append_kept(out, *each.first_after, names, colours);
  } else {
    out.append(" ").append(colours.bad()).append("took nothing more").append(colours.end()).append("\n");
  }
  out += '\n';
}

void append_json(std::string& out, const kept& each, const runtime::name_table& names) {
  auto whole = each.what;
  whole.body = each.body;
  append_json_line(out, whole, names);
}

void append_crash_json(std::string& out, const crash& each, const runtime::name_table& names) {
  out += R"({"run":)" + std::to_string(each.run) + R"(,"actor":)";
  io::append_json_string(out, each.actor);
  out += R"(,"incarnation":)" + std::to_string(each.incarnation) + R"(,"time":")" + utc_ns(each.at_ns) +
         R"(","time_ns":)" + std::to_string(each.at_ns) + R"(,"reason":)";
  io::append_json_string(out, each.reason);
  out += R"(,"delivered_again":)" + std::to_string(each.delivered_again) + R"(,"crashed_on":)";
  if (each.crashed_on)
    append_json(out, *each.crashed_on, names);
  else
    out += "null";
  out += R"(,"before":[)";
  for (std::size_t n = 0; n < each.before.size(); ++n) {
    out += n == 0 ? "" : ",";
    append_json(out, each.before[n], names);
  }
  out += R"(],"first_after":)";
  if (each.first_after)
    append_json(out, *each.first_after, names);
  else
    out += "null";
  out += "}\n";
}

exit_code run_crashes(const crashes_arguments& given, console& to) {
  auto trace = open_trace(given.trace, to);
  if (!trace) {
    to.say(trace.error());
    return exit_code::failed;
  }
  crash_list list((*trace)->names, given.before);
  runtime::delivery each;
  while ((*trace)->ordered.next(each))
    list.add(each);
  const paint colours(to.is_terminal);
  for (const auto& one : list.crashes()) {
    if (given.trace.json)
      append_crash_json(to.out.text(), one, (*trace)->names);
    else
      append_crash(to.out.text(), one, (*trace)->names, colours);
  }
  say_losses((*trace)->reader, to);
  if (list.crashes().empty())
    to.say("no actor crashed in what could be read");
  if (list.not_kept() > 0)
    to.say("there are " + std::to_string(list.not_kept()) + " more crashes; --from goes on behind the last one");
  return exit_code::ok;
}

} // namespace

command add_crashes_command(CLI::App& to) {
  auto* const app = to.add_subcommand("crashes", "Shows each crash: the message, what was before, how it went on.");
  const auto given = std::make_shared<crashes_arguments>();
  add_trace_arguments(*app, given->trace);
  constexpr std::size_t most = 1'000;
  app->add_option("--before", given->before, "So many messages of the actor before its crash")
      ->check(CLI::Range(std::size_t{0}, most))
      ->capture_default_str();
  app->footer(R"(Examples:
  godwit-trace crashes trace
  godwit-trace crashes trace --before 20 --json | jq -r '.actor + ": " + .reason')");
  return {app, [given](console& into) { return run_crashes(*given, into); }};
}

} // namespace godwit::trace_tool
