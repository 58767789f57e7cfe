#include "actors/health/core.hpp"

#include <algorithm>
#include <tuple>

namespace godwit::health {
namespace {

std::string without_numbers(std::string reason) {
  std::erase_if(reason, [](char each) { return each >= '0' && each <= '9'; });
  return reason;
}

bool is_news(const part_health& before, const part_health& now) {
  return before.health != now.health ||
         (now.health != colour::green && without_numbers(before.reason) != without_numbers(now.reason));
}

const part_health* find(const std::vector<part_health>& all, const std::string& part) {
  const auto found = std::ranges::find(all, part, &part_health::part);
  return found == all.end() ? nullptr : &*found;
}

} // namespace

bool core::on_board(const std::vector<posted>& all, std::int64_t wall_ms) {
  const bool is_first = status_.since_ms == 0;
  bool has_changed = is_first;
  health_status next;
  for (const auto& each : all) {
    if (next.parts.size() == max_parts)
      break;
    part_health now{each.part, each.health, each.reason, wall_ms};
    const auto* const before = find(status_.parts, each.part);
    if (before != nullptr && before->health == now.health)
      now.since_ms = before->since_ms;
    has_changed |= before == nullptr ? now.health != colour::green : is_news(*before, now);
    next.worst = std::max(next.worst, now.health);
    next.parts.push_back(std::move(now));
  }
  std::ranges::sort(next.parts, [](const part_health& a, const part_health& b) {
    return std::tie(b.health, a.part) < std::tie(a.health, b.part);
  });
  next.since_ms = !is_first && next.worst == status_.worst ? status_.since_ms : wall_ms;
  status_ = std::move(next);
  return has_changed;
}

} // namespace godwit::health
