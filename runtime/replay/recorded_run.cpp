#include "runtime/replay/recorded_run.hpp"

#include <algorithm>
#include <limits>

#include <nlohmann/json.hpp>

namespace godwit::runtime {

recorded_run::recorded_run(std::string actor, name_table& names)
    : actor_(std::move(actor)), names_(names), actor_number_(names.number(actor_)),
      child_event_(names.number("runtime.child_event")), ask_failed_(names.number("runtime.ask_failed")) {}

recorded_message recorded_run::message_of(const delivery& each) const {
  return {.id = each.id,
          .cause = each.cause,
          .began_ns = each.began_ns,
          .duration_ns = each.duration_ns,
          .clock_offset_ns = each.clock_offset_ns,
          .wall_offset_ns = each.wall_offset_ns,
          .sender = names_.name(each.sender),
          .receiver = names_.name(each.actor),
          .type = names_.name(each.type),
          .incarnation = each.incarnation,
          .how = each.how,
          .oversize = each.oversize,
          .body = std::string(each.body)};
}

void recorded_run::add(const delivery& each) {
  auto& lives = lives_[each.actor];
  if (lives.empty() || lives.back().incarnation != each.incarnation)
    lives.push_back({each.incarnation, 0, each.began_ns, each.began_ns});
  auto& present = lives.back();
  present.last_ns = each.began_ns;
  if (present.first_id == 0)
    present.first_id = each.id; // none: its runtime notes something
  if (each.type == child_event_)
    note_crash(each);
  if (each.type == ask_failed_)
    failed_.insert(each.id);
  const bool is_own = each.actor == actor_number_;
  if (is_own && each.id == 0) { // of its runtime
    auto fact = message_of(each);
    if (fact.type == "runtime.restored")
      note_restored(fact);
    else if (each.sender == actor_number_) // else the guardian has noted something about it
      observed_.emplace(std::pair(fact.incarnation, fact.cause), std::move(fact));
    return;
  }
  if (is_own)
    inputs_.push_back(message_of(each));
  // What the runtime tells an actor of itself was sent by nobody.
  const bool is_of_runtime = is_own && (each.cause == 0 || each.type == ask_failed_);
  if (each.sender == actor_number_ && !is_of_runtime)
    outputs_.push_back(message_of(each));
}

void recorded_run::finish() {
  std::ranges::stable_sort(outputs_, {}, &recorded_message::id);
  const auto again = std::ranges::unique(outputs_, {}, &recorded_message::id); // delivered once more after a crash
  outputs_.erase(again.begin(), again.end());
}

void recorded_run::note_restored(const recorded_message& part) {
  const auto told = nlohmann::json::parse(part.body, nullptr, false);
  if (!told.is_object())
    return;
  auto& known = restored_[part.incarnation];
  known.bytes = told.value("bytes", std::uint64_t{0});
  known.text += told.value("text", std::string());
}

void recorded_run::note_crash(const delivery& each) {
  const auto told = nlohmann::json::parse(each.body, nullptr, false);
  if (told.is_object() && told.value("name", std::string()) == actor_ && told.value("kind", std::string()) == "crashed")
    crashes_[told.value("incarnation", 0U)] = told.value("reason", std::string());
}

std::vector<const recorded_message*> recorded_run::observed(std::uint32_t incarnation, std::uint64_t id) const {
  std::vector<const recorded_message*> result;
  const auto [from, to] = observed_.equal_range({incarnation, id});
  for (auto each = from; each != to; ++each)
    result.push_back(&each->second);
  return result;
}

std::optional<std::string> recorded_run::restored(std::uint32_t incarnation) const {
  const auto found = restored_.find(incarnation);
  if (found == restored_.end())
    return std::nullopt;
  const bool is_whole = found->second.text.size() == found->second.bytes;
  return is_whole ? found->second.text : std::string();
}

std::string recorded_run::crash_reason(std::uint32_t incarnation) const {
  const auto found = crashes_.find(incarnation);
  return found == crashes_.end() ? std::string() : found->second;
}

bool recorded_run::lived_through(const std::string& receiver, std::uint64_t id, std::int64_t from_ns,
                                 std::int64_t to_ns) const {
  const auto found = lives_.find(names_.number(receiver));
  return found != lives_.end() && std::ranges::any_of(found->second, [&](const life& each) {
           const bool had_begun =
               each.first_ns < from_ns || (each.first_ns == from_ns && each.first_id != 0 && each.first_id < id);
           return had_begun && each.last_ns > to_ns;
         });
}

} // namespace godwit::runtime
