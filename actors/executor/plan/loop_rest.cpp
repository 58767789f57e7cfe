#include "actors/executor/plan/loop_rest.hpp"

#include <algorithm>
#include <span>
#include <string>

#include "actors/domain/mission/commands/item_class.hpp"
#include "actors/executor/plan/vehicle_items.hpp"

namespace godwit::executor::plan {

namespace {

const mission::jump* jump_at(const mission::document& mission, std::size_t index) {
  const auto* const found = std::get_if<mission::jump>(&mission.items[index]);
  return found != nullptr && found->times != 0 ? found : nullptr;
}

// Its size: there is none.
std::size_t target_of(const mission::document& mission, const mission::jump& jump) {
  return mission::index_of(mission.items, jump.to).value_or(mission.items.size());
}

bool has_landing(const mission::document& mission, std::size_t begin, std::size_t end) {
  return begin < end && std::ranges::any_of(std::span(mission.items).subspan(begin, end - begin), mission::is_landing);
}

const progress::taken_jump* count_of(const plan_from& from, const std::string& id) {
  const auto found = std::ranges::find(from.jumps, id, &progress::taken_jump::item_id);
  return found == from.jumps.end() ? nullptr : &*found;
}

// Another jump leads back over the one at INDEX: an ArduPilot begins to count anew each time that it leaves the inner
// loop, which a plan with the rounds that are left now can not say.
bool is_inner(const mission::document& mission, std::size_t index) {
  for (std::size_t i = index + 1; i < mission.items.size(); ++i)
    if (const auto* const outer = jump_at(mission, i); outer != nullptr && target_of(mission, *outer) <= index)
      return true;
  return false;
}

} // namespace

std::size_t loop_begin(const mission::document& mission, std::size_t from) {
  auto begin = from;
  for (auto i = from; i < mission.items.size() && !mission::is_landing(mission.items[i]); ++i)
    if (const auto* const jump = jump_at(mission, i))
      begin = std::min(begin, target_of(mission, *jump));
  // The items that were added have jumps of their own.
  for (auto i = from; i > begin; --i)
    if (const auto* const jump = jump_at(mission, i - 1))
      begin = std::min(begin, target_of(mission, *jump));
  return has_landing(mission, begin, from) ? from : begin;
}

std::optional<plan_error> uncounted_jump(const mission::document& mission, std::size_t begin, const plan_from& from,
                                         const plan_setting& setting) {
  for (auto i = begin; i < mission.items.size(); ++i) {
    const auto* const jump = jump_at(mission, i);
    if (jump == nullptr || jump->times < 0)
      continue;
    const auto* const count = count_of(from, jump->id);
    const bool leads_on = i < from.item_index && target_of(mission, *jump) > i;
    const bool forgets = count != nullptr && count->taken > 0 && is_ardupilot(setting) && is_inner(mission, i);
    if (leads_on || forgets || (count != nullptr && !count->is_certain))
      return jump_left_out(mission, from.item_index, i);
  }
  return std::nullopt;
}

plan_error jump_left_out(const mission::document& mission, std::size_t from, std::size_t index) {
  const auto& jump = std::get<mission::jump>(mission.items[index]);
  if (from == 0 || has_landing(mission, target_of(mission, jump), index))
    return {plan_errc::jump_left_out, index, jump.id, "It leads back to item '" + jump.to + "', over a landing",
            "take the jump out, or put it before the landing"};
  return {plan_errc::jump_left_out, index, jump.id,
          "It leads to item '" + jump.to + "', and how many rounds are left is not known",
          "start the mission again from item '" + jump.to + "', or take the jump out"};
}

} // namespace godwit::executor::plan
