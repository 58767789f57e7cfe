#include "actors/ground_port/command_dedup.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "runtime/assert.hpp"

namespace godwit::ground_port {

namespace {

using vehicle_role::order;

// By bits: a NaN that is repeated is the same one.
std::array<std::uint64_t, 7> bits_of(const order& what) {
  const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
  return {bits(what.param1), bits(what.param2), bits(what.param3), bits(what.param4),
          bits(what.x),      bits(what.y),      bits(what.z)};
}

bool is_same(const order& a, const order& b) {
  return a.from == b.from && a.command == b.command && a.is_in_integers == b.is_in_integers && a.is_item == b.is_item &&
         a.frame == b.frame && bits_of(a) == bits_of(b);
}

} // namespace

bool command_dedup::is_forgotten(const entry& each, std::int64_t now_ns) {
  return each.result && now_ns - each.resolved_ns >= remembered_ns;
}

const command_dedup::entry* command_dedup::last_of(mavlink::sender from) const {
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const entry& each) { return each.what.from == from; });
  return found == entries_.end() ? nullptr : &*found;
}

std::optional<mavlink::mav_result> command_dedup::heard_before(const order& what, std::int64_t now_ns) const {
  const auto* const last = last_of(what.from);
  if (last == nullptr || is_forgotten(*last, now_ns) || !is_same(last->what, what))
    return std::nullopt;
  return last->result.value_or(mavlink::mav_result::in_progress);
}

bool command_dedup::may_begin(mavlink::sender from, std::int64_t now_ns) const {
  if (const auto* const last = last_of(from))
    return last->result.has_value();
  return entries_.size() < max_stations ||
         std::any_of(entries_.begin(), entries_.end(), [&](const entry& each) { return is_forgotten(each, now_ns); });
}

std::uint64_t command_dedup::begin(const order& what, std::int64_t now_ns) {
  GODWIT_ASSERT(may_begin(what.from, now_ns), "one word of each station is under way");
  std::erase_if(entries_, [&](const entry& each) { return each.what.from == what.from || is_forgotten(each, now_ns); });
  entries_.push_back({.what = what, .request = ++last_request_});
  return last_request_;
}

std::optional<order> command_dedup::resolve(std::uint64_t request, mavlink::mav_result result, std::int64_t now_ns) {
  const auto found = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const entry& each) { return each.request == request && !each.result; });
  if (found == entries_.end())
    return std::nullopt;
  found->result = result;
  found->resolved_ns = now_ns;
  return found->what;
}

} // namespace godwit::ground_port
