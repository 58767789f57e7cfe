#include "programs/godwit-trace/actors/delivery_filter.hpp"

#include <algorithm>

#include "io/fields/field_table.hpp"
#include "programs/godwit-trace/name_filter.hpp"

namespace godwit::trace_tool {

void add_filter_arguments(CLI::App& command, filter_arguments& to) {
  const auto add = [&command](const char* option, std::vector<std::string>& list, const char* help) {
    return command.add_option(option, list, help)->delimiter(',')->allow_extra_args(false)->type_name("NAME,...");
  };
  add("--actor", to.actors, "Only what these actors took, such as executor,vehicle_*");
  add("--sender", to.senders, "Only what these actors sent");
  add("--type", to.types, "Only these types of message, such as HEARTBEAT,failsafe.*");
  std::vector<std::string> outcomes;
  for (const auto& [value, text] : enum_names(runtime::outcome{}))
    outcomes.emplace_back(text);
  add("--outcome", to.outcomes, "Only what ended so")->check(CLI::IsMember(outcomes));
  command.add_option("--text", to.text, "Only messages in which this text stands, as the trace has it (JSON)");
  command.add_option("--cause", to.cause, "Only what was sent because of this message")->type_name("ID");
}

bool delivery_filter::is_one_of(const std::vector<std::string>& patterns, std::uint32_t number,
                                const runtime::name_table& names, answers& known) {
  if (patterns.empty())
    return true;
  if (known.size() <= number)
    known.resize(number + 1, answer::unknown);
  auto& said = known[number];
  if (said == answer::unknown)
    said = std::ranges::any_of(patterns, [&](const auto& each) { return matches(each, names.name(number)); })
               ? answer::yes
               : answer::no;
  return said == answer::yes;
}

bool delivery_filter::wants(const runtime::delivery& each, const runtime::name_table& names) {
  return (!wanted_.cause || each.cause == *wanted_.cause) && is_one_of(wanted_.actors, each.actor, names, actors_) &&
         is_one_of(wanted_.senders, each.sender, names, senders_) &&
         is_one_of(wanted_.types, each.type, names, types_) &&
         (wanted_.outcomes.empty() || std::ranges::count(wanted_.outcomes, io::name_of(each.how)) > 0) &&
         (wanted_.text.empty() || each.body.find(wanted_.text) != std::string_view::npos);
}

} // namespace godwit::trace_tool
