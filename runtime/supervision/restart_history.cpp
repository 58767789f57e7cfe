#include "runtime/supervision/restart_history.hpp"

#include <algorithm>

namespace godwit::runtime {

namespace {

std::int64_t ns(milliseconds duration) { return std::chrono::nanoseconds(duration).count(); }

} // namespace

std::optional<std::int64_t> restart_history::on_crash(const restart_policy& policy, std::int64_t now_ns,
                                                      random_source& random) {
  while (!crashes_.empty() && now_ns - crashes_.front() >= ns(policy.period))
    crashes_.pop_front();
  crashes_.push_back(now_ns);
  if (crashes_.size() > policy.intensity)
    return std::nullopt;
  if (crashes_.size() == 1)
    return 0;
  auto wait = ns(policy.backoff_initial);
  for (std::size_t i = 2; i < crashes_.size() && wait < ns(policy.backoff_max); ++i)
    wait *= 2;
  wait = std::min(wait, ns(policy.backoff_max));
  const auto factor = 1.0 + policy.jitter * (2.0 * random.unit() - 1.0);
  return static_cast<std::int64_t>(static_cast<double>(wait) * factor);
}

} // namespace godwit::runtime
