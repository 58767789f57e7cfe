#include "actors/ground_port/mission_server/plan_store.hpp"

#include <algorithm>
#include <utility>

#include <zlib.h>

#include "actors/ground_port/mission_server/item_forms.hpp"
#include "io/mavlink/layout.hpp"
#include "runtime/assert.hpp"

namespace godwit::ground_port::mission_server {

using mavlink::mav_mission_type;

std::uint32_t checksum_of(const std::vector<mavlink::mission_item_int>& items) {
  auto crc = crc32(0, nullptr, 0);
  for (const auto& each : items) {
    std::array<std::byte, mavlink::layout<mavlink::mission_item_int>::full_length> bytes;
    mavlink::write_fields(each, bytes.data());
    crc = crc32(crc, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size()));
  }
  if (items.empty())
    return 0;
  return crc == 0 ? 1 : static_cast<std::uint32_t>(crc);
}

namespace {

std::size_t index_of(mav_mission_type type) {
  const auto index = static_cast<std::size_t>(mavlink::number(type));
  GODWIT_ASSERT(index < plan_types, "there is a mission, a fence and rally points");
  return index;
}

} // namespace

const held_plan& plan_store::plan(mav_mission_type type) const { return plans_[index_of(type)]; }

held_plan& plan_store::place(mav_mission_type type) { return plans_[index_of(type)]; }

void plan_store::begin(mav_mission_type type, int count) {
  type_ = type;
  count_ = count;
  incoming_.clear();
  if (vehicle_.is_atomic)
    return;
  auto& items = place(type).items;
  items.resize(std::min(items.size(), static_cast<std::size_t>(count)));
}

void plan_store::put(const mavlink::mission_item_int& item) {
  auto kept = as_kept(item, vehicle_);
  const bool is_home = vehicle_.home && type_ == mav_mission_type::mission && item.seq == 0;
  if (is_home) {
    kept = *vehicle_.home;
    kept.seq = 0;
  }
  if (vehicle_.is_atomic) {
    incoming_.push_back(kept);
    return;
  }
  auto& items = place(type_).items;
  if (item.seq < items.size())
    items[item.seq] = kept;
  else
    items.push_back(kept);
}

void plan_store::complete() {
  auto& plan = place(type_);
  if (vehicle_.is_atomic)
    plan.items = std::move(incoming_);
  incoming_.clear();
  plan.id = vehicle_.has_plan_ids ? checksum_of(plan.items) : 0;
}

void plan_store::discard() { incoming_.clear(); }

void plan_store::clear(mav_mission_type type) { place(type) = {}; }

} // namespace godwit::ground_port::mission_server
