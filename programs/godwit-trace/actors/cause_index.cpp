#include "programs/godwit-trace/actors/cause_index.hpp"

#include <algorithm>
#include <deque>
#include <numeric>

namespace godwit::trace_tool {

void cause_index::add(std::uint64_t id, std::uint64_t cause) {
  if (id != 0 && by_cause_.size() < UINT32_MAX)
    by_cause_.push_back({cause, id});
}

void cause_index::sort() {
  std::ranges::sort(by_cause_);
  const auto doubled = std::ranges::unique(by_cause_); // taken more than once: after a crash, or a repetition
  by_cause_.erase(doubled.begin(), doubled.end());
  by_id_.resize(by_cause_.size());
  std::iota(by_id_.begin(), by_id_.end(), 0U);
  std::ranges::sort(by_id_, {}, [this](std::uint32_t at) { return by_cause_[at].id; });
}

std::uint64_t cause_index::cause_of(std::uint64_t id) const {
  const auto found = std::ranges::lower_bound(by_id_, id, {}, [this](std::uint32_t at) { return by_cause_[at].id; });
  return found != by_id_.end() && by_cause_[*found].id == id ? by_cause_[*found].cause : 0;
}

cause_index::family cause_index::family_of(std::uint64_t id, std::size_t limit) const {
  family result;
  result.origin = id;
  result.ids.insert(id);
  while (const auto cause = cause_of(result.origin)) {
    if (result.ids.size() >= limit || !result.ids.insert(cause).second) { // a circle: ids of two runs
      result.is_all = false;
      break;
    }
    result.origin = cause;
  }
  std::deque<std::uint64_t> waiting{id};
  while (!waiting.empty()) {
    const auto range = std::ranges::equal_range(by_cause_, waiting.front(), {}, &edge::cause);
    waiting.pop_front();
    for (const auto& each : range) {
      if (result.ids.contains(each.id))
        continue;
      if (result.ids.size() >= limit) {
        result.is_all = false;
        return result;
      }
      result.ids.insert(each.id);
      waiting.push_back(each.id);
    }
  }
  return result;
}

} // namespace godwit::trace_tool
