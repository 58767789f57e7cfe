#include "programs/godwit-sim/missions/control_answers.hpp"

#include <algorithm>
#include <array>
#include <string>

#include <nlohmann/json.hpp>

#include "actors/domain/mission/read.hpp"
#include "programs/godwit-sim/missions/assignment_table.hpp"
#include "programs/godwit-sim/text_forms.hpp"

namespace godwit::sim::missions {
namespace {

using json = nlohmann::json;

json failure(const std::string& sentence) { return {{"ok", false}, {"error", sentence}}; }

json done(const tl::expected<void, std::string>& result) {
  return result ? json{{"ok", true}} : failure(result.error());
}

json stats(running_service& service) {
  const auto figures = service.figures();
  json requests = json::object();
  for (const auto& [where, by_status] : figures.answers)
    for (const auto& [status, count] : by_status)
      requests[std::string(io::name_of(where))][std::to_string(status)] = count;
  json rows = json::object();
  for (const auto& [kind, counted] : figures.rows)
    rows[std::string(io::name_of(kind))] = {
        {"stored", counted.stored}, {"repeated", counted.repeated}, {"differing", counted.differing}};
  json faults = json::array();
  for (const auto& each : figures.faults)
    faults.push_back({{"fault", each.spec}, {"seen", each.seen}, {"hit", each.hit}});
  const auto& connections = figures.connections;
  return {{"ok", true},
          {"requests", std::move(requests)},
          {"rows", std::move(rows)},
          {"replayed", figures.replayed},
          {"lost", figures.lost},
          {"connections",
           {{"accepted", connections.accepted},
            {"turned_away", connections.turned_away},
            {"open", connections.open},
            {"polls", connections.polls}}},
          {"faults", std::move(faults)}};
}

// The text of the assignment that REQUEST asks for: in it, or in the FILE.
tl::expected<std::string, std::string> assignment_text(const json& request, const std::string& file) {
  const auto inline_one = request.find("assignment");
  if (file.empty() == (inline_one == request.end()))
    return tl::unexpected(std::string("an assignment stands in \"assignment\", or in a file: \"assign FILE\""));
  if (!file.empty())
    return read_text_file(file, mission::max_mission_bytes);
  return inline_one->dump(-1, ' ', false, json::error_handler_t::replace);
}

json assign(running_service& service, const json& request, const std::string& file) {
  const auto wanted = assignment_text(request, file).and_then(parse_assignment_request);
  if (!wanted)
    return failure(wanted.error());
  const auto named = request.find("mission");
  const auto mission_id = named != request.end() && named->is_string()
                              ? tl::expected<std::string, std::string>(named->get<std::string>())
                              : service.only_mission();
  if (!mission_id)
    return failure(mission_id.error());
  const auto made = service.assign(*mission_id, *wanted);
  if (!made)
    return failure(made.error());
  return {{"ok", true},
          {"assignment_id", made->assignment_id},
          {"base_revision", made->base_revision},
          {"revision", made->revision}};
}

json faults(running_service& service, const json&, const std::string& rest) {
  if (rest != "off")
    return failure("it is \"faults off\", or \"fault\" and what is to go wrong");
  service.clear_faults();
  return {{"ok", true}};
}

json quit(running_service& service, const json&, const std::string&) {
  service.end();
  return {{"ok", true}};
}

struct word_row {
  std::string_view word;
  json (*answer)(running_service& service, const json& request, const std::string& rest);
};

constexpr std::array word_rows{
    word_row{"assign", assign},
    word_row{"delete", [](running_service& service, const json&,
                          const std::string& rest) { return done(service.delete_mission(rest)); }},
    word_row{"fault", [](running_service& service, const json&,
                         const std::string& rest) { return done(service.set_fault(rest)); }},
    word_row{"faults", faults},
    word_row{"stats", [](running_service& service, const json&, const std::string&) { return stats(service); }},
    word_row{"quit", quit},
};

// The sentence about a key that means nothing here, or none.
std::string mistake_in_keys(const json& request) {
  constexpr std::array known{"do", "mission", "assignment", "id"};
  for (const auto& [key, value] : request.items())
    if (std::ranges::find(known, key) == known.end())
      return in_quotes(key) + " is no part of a request; there are do, mission, assignment and id";
  return {};
}

} // namespace

json answer_control(running_service& service, const json& request) {
  if (auto wrong = mistake_in_keys(request); !wrong.empty())
    return failure(wrong);
  const auto what = request.find("do");
  if (what == request.end() || !what->is_string())
    return failure("\"do\" is missing: what is to be done, such as \"stats\"");
  const auto text = what->get<std::string>();
  const auto word = text.substr(0, text.find(' '));
  const auto rest = std::string(trimmed(std::string_view(text).substr(word.size())));
  for (const auto& row : word_rows)
    if (row.word == word)
      return row.answer(service, request, rest);
  return failure(in_quotes(word) + " is nothing that can be done; there are assign, delete, fault, faults off, stats "
                                   "and quit");
}

} // namespace godwit::sim::missions
