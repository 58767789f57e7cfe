#include "actors/ground_port/mission_server/plan_store.hpp"

#include <algorithm>
#include <utility>

#include "actors/ground_port/mission_server/item_forms.hpp"
#include "runtime/assert.hpp"

namespace godwit::ground_port::mission_server {

using mavlink::mav_mission_type;

namespace {

std::size_t index_of(mav_mission_type type) {
  const auto index = static_cast<std::size_t>(mavlink::number(type));
  GODWIT_ASSERT(index < plan_types, "there is a mission, a fence and rally points");
  return index;
}

} // namespace

const held_plan& plan_store::plan(mav_mission_type type) const { return plans_[index_of(type)]; }

held_plan& plan_store::place(mav_mission_type type) { return plans_[index_of(type)]; }

bool plan_store::is_staged(mav_mission_type type) const {
  return vehicle_.is_atomic || (type == mav_mission_type::fence && vehicle_.fence.judges_at_the_end);
}

std::uint32_t plan_store::id_of(const std::vector<mavlink::mission_item_int>& items) const {
  return vehicle_.has_plan_ids ? checksum_of(items) : 0;
}

void plan_store::begin(mav_mission_type type, int count) {
  type_ = type;
  staged_.clear();
  if (is_staged(type))
    return;
  auto& items = place(type).items;
  items.resize(std::min(items.size(), static_cast<std::size_t>(count)));
}

void plan_store::begin_in_part(mav_mission_type type) {
  type_ = type;
  if (is_staged(type))
    staged_ = place(type).items;
}

const std::vector<mavlink::mission_item_int>& plan_store::incoming() const {
  return is_staged(type_) ? staged_ : plan(type_).items;
}

void plan_store::put(const mavlink::mission_item_int& item) {
  auto kept = as_kept(item, vehicle_);
  const bool is_home = vehicle_.home && type_ == mav_mission_type::mission && item.seq == 0;
  if (is_home) {
    kept = *vehicle_.home;
    kept.seq = 0;
  }
  auto& items = is_staged(type_) ? staged_ : place(type_).items;
  if (item.seq < items.size())
    items[item.seq] = kept;
  else
    items.push_back(kept);
}

void plan_store::set_home(const mavlink::mission_item_int& home) {
  vehicle_.home = home;
  auto& items = place(mav_mission_type::mission).items;
  if (items.empty())
    return;
  items.front() = home;
  items.front().seq = 0;
}

bool plan_store::complete() {
  auto& plan = place(type_);
  bool is_the_same = false;
  if (is_staged(type_)) {
    is_the_same = checksum_of(plan.items) == checksum_of(staged_);
    plan.items = std::move(staged_);
  }
  staged_.clear();
  plan.id = id_of(plan.items);
  return is_the_same;
}

void plan_store::discard() { staged_.clear(); }

void plan_store::clear(mav_mission_type type) { place(type) = {}; }

void plan_store::restore(mav_mission_type type, std::vector<mavlink::mission_item_int> items) {
  auto& plan = place(type);
  plan.items = std::move(items);
  plan.id = id_of(plan.items);
}

} // namespace godwit::ground_port::mission_server
