#include "actors/executor/flight/pending_commands.hpp"

#include <algorithm>
#include <utility>

namespace godwit::executor {

std::optional<station_act> pending_commands::begin(const station_act& what, std::int64_t now_ns) {
  std::optional<station_act> oldest;
  if (waiting_.size() == max_pending) {
    oldest = std::move(waiting_.front().what);
    waiting_.erase(waiting_.begin());
  }
  waiting_.push_back({what, now_ns + answered_within_ns});
  return oldest;
}

std::optional<station_act> pending_commands::acknowledge(const act_acknowledged& m) {
  const auto found = std::ranges::find_if(waiting_, [&](const waiting& each) { return each.what.number == m.number; });
  if (found == waiting_.end())
    return std::nullopt;
  auto result = m.is_refused ? std::nullopt : std::optional(std::move(found->what));
  waiting_.erase(found);
  return result;
}

std::optional<station_act> pending_commands::take_silent(std::int64_t now_ns) {
  if (waiting_.empty() || now_ns < waiting_.front().until_ns)
    return std::nullopt;
  auto result = std::move(waiting_.front().what);
  waiting_.erase(waiting_.begin());
  return result;
}

} // namespace godwit::executor
