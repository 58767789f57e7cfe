#include "programs/godwit-trace/actors/crash_list.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace godwit::trace_tool {

using runtime::delivery;
using runtime::outcome;

void crash_list::add(const delivery& each) {
  const auto& actor = names_.name(each.actor);
  auto& history = actors_[actor];
  if (history.run != each.run)
    history = {each.run, {}, {}};
  if (names_.name(each.type) == "runtime.restored")
    return take_restored(each, history);
  close(each, history);
  if (each.how == outcome::crashed)
    if (auto* const made = begin_crash(each, actor, each.incarnation))
      made->crashed_on.emplace(each);
  if (names_.name(each.type) == "runtime.child_event")
    take_event(each);
  if (before_ > 0) {
    if (history.newest.size() == before_)
      history.newest.pop_front();
    history.newest.emplace_back(each);
  }
}

crash* crash_list::crash_of(std::uint64_t run, const std::string& actor, std::uint64_t incarnation) {
  const auto found = std::ranges::find_if(crashes_, [&](const crash& each) {
    return each.run == run && each.actor == actor && each.incarnation == incarnation;
  });
  return found == crashes_.end() ? nullptr : &*found;
}

crash* crash_list::begin_crash(const delivery& each, const std::string& actor, std::uint64_t incarnation) {
  if (auto* const known = crash_of(each.run, actor, incarnation))
    return known;
  if (crashes_.size() == max_crashes) {
    ++not_kept_;
    return nullptr;
  }
  auto& history = actors_[actor];
  crash made{.run = each.run,
             .actor = actor,
             .incarnation = incarnation,
             .at_ns = each.began_ns,
             .reason = {},
             .crashed_on = {},
             .before = {history.newest.begin(), history.newest.end()},
             .restored = {},
             .first_after = {},
             .delivered_again = 0,
             .last_delivery_ended = {}};
  // A crash that somebody told of later: what the next incarnation took already comes after it.
  const auto later =
      std::ranges::find_if(made.before, [&](const kept& one) { return one.what.incarnation > incarnation; });
  if (later != made.before.end())
    made.first_after = *later;
  made.before.erase(later, made.before.end());
  history.open.push_back(crashes_.size());
  crashes_.push_back(std::move(made));
  return &crashes_.back();
}

void crash_list::take_event(const delivery& each) {
  const auto told = nlohmann::json::parse(each.body, nullptr, false);
  if (!told.is_object() || !told.contains("kind") || !told["kind"].is_string() || !told.contains("name") ||
      !told["name"].is_string() || !told.contains("incarnation") || !told["incarnation"].is_number_unsigned())
    return;
  const auto kind = told["kind"].get<std::string>();
  if (kind != "crashed" && kind != "gave_up")
    return;
  if (auto* const made = begin_crash(each, told["name"].get<std::string>(), told["incarnation"].get<std::uint64_t>()))
    if (told.contains("reason") && told["reason"].is_string() && made->reason.empty())
      made->reason = told["reason"].get<std::string>();
}

// What a later incarnation takes ends the wait of a crash, and shows whether its message is delivered again.
void crash_list::close(const delivery& each, actor_history& history) {
  for (const auto at : history.open) {
    auto& open = crashes_[at];
    if (each.incarnation <= open.incarnation)
      continue;
    if (!open.first_after)
      open.first_after.emplace(each);
    if (open.crashed_on && each.id != 0 && each.id == open.crashed_on->what.id) {
      ++open.delivered_again;
      open.last_delivery_ended = io::name_of(each.how);
    }
  }
}

// Of several parts the first says how large all are.
void crash_list::take_restored(const delivery& each, const actor_history& history) {
  const auto told = nlohmann::json::parse(each.body, nullptr, false);
  if (!told.is_object() || told.value("part", 0) != 0)
    return;
  restored_state state;
  state.bytes = told.value("bytes", std::uint64_t{0});
  const auto text = nlohmann::json::parse(told.value("text", std::string()), nullptr, false);
  if (text.is_object() && text.contains("effects")) {
    state.is_known = true;
    state.last_event = text.value("last_event", std::int64_t{0});
    state.effects = text["effects"].size();
  }
  for (const auto at : history.open)
    if (auto& open = crashes_[at]; each.incarnation > open.incarnation && !open.restored)
      open.restored = state;
}

} // namespace godwit::trace_tool
