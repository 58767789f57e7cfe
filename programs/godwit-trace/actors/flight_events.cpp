#include "programs/godwit-trace/actors/flight_events.hpp"

#include <utility>

#include "actors/domain/flight_mode/flight_modes.hpp"
#include "io/mavlink/enums/command.hpp"
#include "io/mavlink/messages/heartbeat.hpp"

namespace godwit::trace_tool {

namespace {

using nlohmann::json;
using runtime::delivery;
using runtime::name_table;

// The member of that name as text; empty when it is not there. A message of another version of godwit lacks some.
std::string text(const json& of, const char* name) {
  const auto found = of.is_object() ? of.find(name) : of.end();
  if (!of.is_object() || found == of.end() || found->is_null())
    return {};
  return found->is_string() ? found->get<std::string>() : found->dump();
}

const json& member(const json& of, const char* name) {
  static const json none;
  const auto found = of.is_object() ? of.find(name) : of.end();
  return !of.is_object() || found == of.end() ? none : *found;
}

std::uint64_t number(const json& of, const char* name) {
  const auto& found = member(of, name);
  return found.is_number_unsigned() ? found.get<std::uint64_t>() : 0;
}

bool flag(const json& of, const char* name) { return member(of, name) == true; }

std::string with_reason(std::string sentence, const std::string& reason) {
  return reason.empty() ? sentence : std::move(sentence) + ": " + reason;
}

std::string command_name(std::uint64_t number) {
  for (const auto& [value, name] : enum_names(io::mavlink::mav_cmd{}))
    if (static_cast<std::uint64_t>(value) == number)
      return std::string(name);
  return "command " + std::to_string(number);
}

std::string mode_name(const io::mavlink::heartbeat& beat) {
  const auto kind = flight::mode_of(beat).kind;
  return kind == flight::mode_kind::unknown ? "mode " + std::to_string(beat.custom_mode)
                                            : std::string(io::name_of(kind));
}

bool is_asking_for_a_message(std::uint64_t command) {
  return command == static_cast<std::uint64_t>(io::mavlink::mav_cmd::request_message) ||
         command == static_cast<std::uint64_t>(io::mavlink::mav_cmd::set_message_interval);
}

} // namespace

// In the order of what people ask for.
const flight_events::row flight_events::rows[] = {
    {"executor.flight_status", nullptr,
     [](const json& m, const delivery&, const name_table&) -> std::optional<saying> {
       const auto phase = text(m, "phase");
       const auto sentence = text(m, "sentence");
       const bool is_plain = sentence.empty() || sentence == phase;
       return saying{flight_matter::phase, is_plain ? phase : sentence, phase == "paused" || phase == "aborted"};
     },
     how_often::when_another},
    {"failsafe.stance", "executor",
     [](const json& m, const delivery&, const name_table&) -> std::optional<saying> {
       const auto& reacts = member(m, "reacts");
       if (reacts.is_object())
         return saying{flight_matter::failsafe,
                       "the failsafe acts: " + text(reacts, "what") + " because of " + text(reacts, "why") + " (" +
                           text(reacts, "stage") + ")",
                       true};
       if (flag(m, "taken_over"))
         return saying{flight_matter::control, "somebody else has the vehicle; the failsafe warns and sends nothing",
                       true};
       return saying{flight_matter::control,
                     flag(m, "in_flight") ? "in flight, the failsafe watches" : "on the ground, the failsafe rests",
                     false};
     },
     how_often::when_another},
    {"failsafe.taken_over", nullptr,
     [](const json&, const delivery&, const name_table&) -> std::optional<saying> {
       return saying{flight_matter::control, "a pilot took the vehicle over", true};
     },
     how_often::always},
    {"failsafe.hand_back", nullptr,
     [](const json&, const delivery&, const name_table&) -> std::optional<saying> {
       return saying{flight_matter::control, "the vehicle was handed back to the mission", false};
     },
     how_often::always},
    {"failsafe.override_rule", nullptr,
     [](const json& m, const delivery&, const name_table&) -> std::optional<saying> {
       return saying{flight_matter::failsafe,
                     with_reason("the rule " + text(m, "scope") + " is overridden", text(m, "reason")), true};
     },
     how_often::always},
    {"operator.word", "executor",
     [](const json& m, const delivery&, const name_table&) -> std::optional<saying> {
       const auto by = text(m, "by");
       return saying{flight_matter::control,
                     "operator command: " + text(m, "verb") + (by.empty() ? "" : " (" + by + ")"), false};
     },
     how_often::always},
    {"executor.start_mission", nullptr,
     [](const json& m, const delivery&, const name_table&) -> std::optional<saying> {
       return saying{flight_matter::control,
                     "ground station " + text(member(m, "asked_by"), "system") + " starts the mission", false};
     },
     how_often::always},
    {"HEARTBEAT", "executor",
     [](const json& m, const delivery&, const name_table&) -> std::optional<saying> {
       io::mavlink::heartbeat beat;
       beat.type = static_cast<decltype(beat.type)>(number(m, "type"));
       beat.autopilot = static_cast<decltype(beat.autopilot)>(number(m, "autopilot"));
       beat.custom_mode = static_cast<std::uint32_t>(number(m, "custom_mode"));
       constexpr std::uint64_t armed_flag = 128; // MAV_MODE_FLAG_SAFETY_ARMED
       const bool is_armed = (number(m, "base_mode") & armed_flag) != 0;
       return saying{flight_matter::vehicle,
                     "the vehicle is in " + mode_name(beat) + (is_armed ? ", armed" : ", disarmed"), false};
     },
     how_often::when_another},
    {"vehicle_link.connection_changed", "executor",
     [](const json& m, const delivery&, const name_table&) -> std::optional<saying> {
       const auto phase = text(m, "phase");
       return saying{flight_matter::vehicle, with_reason("the link is " + phase, text(m, "reason")),
                     phase != "connected"};
     },
     how_often::when_another},
    {"vehicle_link.vehicle_restarted", "executor",
     [](const json&, const delivery&, const name_table&) -> std::optional<saying> {
       return saying{flight_matter::vehicle, "the autopilot started again", true};
     },
     how_often::always},
    {"vehicle_link.send_command", "vehicle_link",
     [](const json& m, const delivery& each, const name_table& names) -> std::optional<saying> {
       const auto command = number(m, "command");
       if (is_asking_for_a_message(command))
         return std::nullopt;
       return saying{flight_matter::command,
                     names.name(each.sender) + " commands " + command_name(command) + " (" + text(m, "param1") + ", " +
                         text(m, "param2") + ")",
                     false};
     },
     how_often::always},
    {"vehicle_link.command_outcome", nullptr,
     [](const json& m, const delivery& each, const name_table& names) -> std::optional<saying> {
       const auto command = number(m, "command");
       const auto verdict = text(m, "verdict");
       if (is_asking_for_a_message(command) && verdict == "accepted")
         return std::nullopt;
       return saying{
           flight_matter::command,
           with_reason(command_name(command) + " of " + names.name(each.actor) + ": " + verdict, text(m, "reason")),
           verdict != "accepted"};
     },
     how_often::always},
    {"vehicle_link.upload_plan", "vehicle_link",
     [](const json& m, const delivery&, const name_table&) -> std::optional<saying> {
       return saying{flight_matter::plan,
                     "a " + text(m, "mission_type") + " of " + std::to_string(member(m, "items").size()) +
                         " items goes to the vehicle",
                     false};
     },
     how_often::always},
    {"vehicle_link.transfer_outcome", "executor",
     [](const json& m, const delivery&, const name_table&) -> std::optional<saying> {
       const auto verdict = text(m, "verdict");
       return saying{flight_matter::plan,
                     "the transfer of the " + text(m, "mission_type") + " ended: " + verdict + ", the vehicle holds " +
                         text(m, "holding"),
                     verdict != "accepted"};
     },
     how_often::always},
    {"mission_client.mission_loaded", "executor",
     [](const json& m, const delivery&, const name_table&) -> std::optional<saying> {
       const auto& document = member(m, "document");
       return saying{flight_matter::plan,
                     "mission " + text(document, "mission_id") + ", revision " + text(document, "revision") + ", " +
                         std::to_string(member(document, "items").size()) + " items (" + text(m, "cause") + ")",
                     false};
     },
     how_often::always},
    {"mission_client.mission_refused", "executor",
     [](const json& m, const delivery&, const name_table&) -> std::optional<saying> {
       return saying{flight_matter::plan, with_reason("the mission is refused", text(m, "reason")), true};
     },
     how_often::always},
    {"mission_client.assignment_arrived", "executor",
     [](const json& m, const delivery&, const name_table&) -> std::optional<saying> {
       const auto& assigned = member(m, "assignment");
       const auto after = text(assigned, "replace_after_item_id");
       return saying{flight_matter::plan,
                     "replan to revision " + text(assigned, "revision") + ": " +
                         std::to_string(member(assigned, "items").size()) + " items " +
                         (after.empty() ? "instead of all" : "after " + after),
                     false};
     },
     how_often::always},
    {"mission_client.report_progress", nullptr,
     [](const json& m, const delivery&, const name_table&) -> std::optional<saying> {
       const auto& report = member(m, "report");
       const auto item = text(report, "item_id");
       return saying{flight_matter::report,
                     "report " + text(report, "report_no") + ": " + text(report, "kind") +
                         (item.empty() ? "" : " " + item) + (flag(report, "inferred") ? " (inferred)" : ""),
                     text(report, "kind") == "aborted"};
     },
     how_often::always},
    {"runtime.child_event", nullptr,
     [](const json& m, const delivery&, const name_table&)
         -> std::
             optional<saying> {
               const auto kind = text(m, "kind");
               return saying{flight_matter::actor,
                             with_reason(text(m, "name") + ", incarnation " + text(m, "incarnation") + ": " + kind,
                                         text(m, "reason")),
                             kind != "up" && kind != "stopped"};
             },
     how_often::once_a_run},
    {"STATUSTEXT", "executor",
     [](const json& m, const delivery&, const name_table&)
         -> std::
             optional<saying> {
               constexpr std::uint64_t warning = 4; // MAV_SEVERITY_WARNING
               auto said = text(m, "text");
               said.erase(said.find_last_not_of("\t \n") + 1);
               return saying{flight_matter::text, "the vehicle reports: " + said, number(m, "severity") <= warning};
             },
     how_often::always},
};

flight_events::flight_events(const name_table& names) : names_(names) {}

std::optional<flight_event> flight_events::take(const delivery& each) {
  if (each.run != run_ || !has_begun_) { // the first message of a run is the runtime's own and says nothing to people
    last_.clear();
    said_.clear();
    run_ = each.run;
    const bool is_another = std::exchange(has_begun_, true);
    return flight_event{.at_ns = each.began_ns,
                        .run = each.run,
                        .matter = flight_matter::process,
                        .sentence = "godwitd begins (run " + std::to_string(each.run) + ")",
                        .is_bad = is_another};
  }
  if (by_type_.size() <= each.type) {
    by_type_.resize(each.type + 1, nullptr);
    is_looked_up_.resize(each.type + 1, false);
  }
  if (!is_looked_up_[each.type]) {
    is_looked_up_[each.type] = true;
    for (const auto& one : rows)
      if (names_.name(each.type) == one.type)
        by_type_[each.type] = &one;
  }
  const auto* const of = by_type_[each.type];
  if (of == nullptr || each.how == runtime::outcome::repetition ||
      (of->actor != nullptr && names_.name(each.actor) != of->actor))
    return std::nullopt;
  const auto message = json::parse(each.body, nullptr, false);
  const auto said = message.is_discarded() ? std::nullopt : of->read(message, each, names_);
  if (!said || (of->told == how_often::when_another && last_[of] == said->sentence) ||
      (of->told == how_often::once_a_run && !said_.insert(said->sentence).second))
    return std::nullopt;
  last_[of] = said->sentence;
  return flight_event{each.began_ns, each.run, each.id, said->matter, said->sentence, said->is_bad};
}

} // namespace godwit::trace_tool
