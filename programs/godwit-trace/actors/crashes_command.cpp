// godwit-trace crashes: each crash with the message that did it, what was before, and how it went on.
#include <set>

#include "io/fields/json_text.hpp"
#include "programs/godwit-trace/actors/crash_list.hpp"
#include "programs/godwit-trace/actors/dead_letters.hpp"
#include "programs/godwit-trace/actors/text_forms.hpp"
#include "programs/godwit-trace/actors/trace_arguments.hpp"
#include "programs/godwit-trace/commands.hpp"

namespace godwit::trace_tool {

namespace {

struct crashes_arguments {
  trace_arguments trace;
  std::size_t before = 5;
  std::string journal; // empty: none is looked into
};

void append_kept(std::string& out, const kept& each, const runtime::name_table& names, const paint& colours) {
  auto whole = each.what;
  whole.body = each.body;
  out += "  ";
  append_line(out, whole, names, colours);
}

void append_restored(std::string& out, const restored_state& state) {
  out += " the restart restored " + std::to_string(state.bytes) + " bytes";
  if (state.is_known)
    out += " of state, up to event " + std::to_string(state.last_event) + ", with " + std::to_string(state.effects) +
           (state.effects == 1 ? " effect" : " effects") + " that had not gone out";
  out += '\n';
}

void append_crash(std::string& out, const crash& each, const runtime::name_table& names, const paint& colours) {
  append_utc_ns(out, each.at_ns);
  out.append(" ").append(colours.bad()).append(each.actor).append(", incarnation ");
  out.append(std::to_string(each.incarnation)).append(colours.end()).append(" crashed: ");
  append_printable(out, each.reason.empty() ? std::string_view("no reason is recorded") : each.reason);
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
  if (each.restored)
    append_restored(out, *each.restored);
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
  out += R"(],"restored":)";
  out += !each.restored            ? "null"
         : each.restored->is_known ? R"({"bytes":)" + std::to_string(each.restored->bytes) + R"(,"last_event":)" +
                                         std::to_string(each.restored->last_event) + R"(,"effects":)" +
                                         std::to_string(each.restored->effects) + '}'
                                   : R"({"bytes":)" + std::to_string(each.restored->bytes) + '}';
  out += R"(,"first_after":)";
  if (each.first_after)
    append_json(out, *each.first_after, names);
  else
    out += "null";
  out += "}\n";
}

// False: the journal can not be read.
bool print_dead_letters(const crashes_arguments& given, const std::vector<std::string>& actors, console& to) {
  const auto letters = read_dead_letters(given.journal, actors);
  if (!letters) {
    to.say(letters.error());
    return false;
  }
  const paint colours(to.is_terminal);
  for (const auto& each : *letters) {
    if (given.trace.json)
      append_dead_letter_json(to.out.text(), each);
    else
      append_dead_letter(to.out.text(), each, colours);
  }
  return true;
}

exit_code run_crashes(const crashes_arguments& given, console& to) {
  auto trace = open_trace(given.trace, to);
  if (!trace) {
    to.say(trace.error());
    return exit_code::failed;
  }
  crash_list list((*trace)->names, given.before);
  runtime::delivery each;
  std::set<std::uint32_t> actors;
  while ((*trace)->ordered.next(each)) {
    actors.insert(each.actor);
    list.add(each);
  }
  const paint colours(to.is_terminal);
  for (const auto& one : list.crashes()) {
    if (given.trace.json)
      append_crash_json(to.out.text(), one, (*trace)->names);
    else
      append_crash(to.out.text(), one, (*trace)->names, colours);
  }
  std::vector<std::string> names;
  for (const auto actor : actors)
    names.push_back((*trace)->names.name(actor));
  const bool is_read = given.journal.empty() || print_dead_letters(given, names, to);
  report_losses((*trace)->reader, to);
  if (list.crashes().empty())
    to.say("no actor crashed in what could be read");
  if (list.not_kept() > 0)
    to.say("there are " + std::to_string(list.not_kept()) + " more crashes; --from continues after the last one");
  return is_read ? exit_code::ok : exit_code::failed;
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
  app->add_option("--journal", given->journal, "Shows what is in the dead letters of this journal, too")
      ->type_name("FILE");
  app->footer(R"(Examples:
  godwit-trace crashes trace
  godwit-trace crashes trace --before 20 --json | jq -r '.actor + ": " + .reason')");
  return {app, [given](console& into) { return run_crashes(*given, into); }, always};
}

} // namespace godwit::trace_tool
