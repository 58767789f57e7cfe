#include "programs/godwitd/landing_watch/core.hpp"

#include <algorithm>

namespace godwit::landing_watch {

void core::on_heartbeat(bool is_armed, std::int64_t now_ns) {
  const bool has_gap = now_ns - last_ns_ > heard_ns;
  last_ns_ = now_ns;
  if (is_armed)
    disarmed_ns_.reset();
  else if (!disarmed_ns_ || has_gap)
    disarmed_ns_ = now_ns;
}

bool core::stands(std::int64_t now_ns) const {
  return disarmed_ns_ && now_ns - last_ns_ <= heard_ns && now_ns - *disarmed_ns_ >= stands_ns;
}

bool is_given_up(const runtime::children& all, const std::string& name) {
  return std::ranges::any_of(all.list, [&](const runtime::child_report& each) {
    return each.name == name && each.phase == runtime::child_phase::given_up;
  });
}

} // namespace godwit::landing_watch
