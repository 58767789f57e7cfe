#include "actors/executor/mode_watch.hpp"

namespace godwit::executor {

void mode_watch::expect(mode_kind kind, std::int64_t now_ns) {
  expected_until_ns_.at(static_cast<std::size_t>(kind)) = now_ns + expected_for_ns;
}

void mode_watch::forget() { *this = {}; }

bool mode_watch::is_expected(mode_kind kind, std::int64_t now_ns) const {
  const bool is_end = kind == mode_kind::hold || kind == mode_kind::returning || kind == mode_kind::landing;
  return (plan_ends_ && is_end) || now_ns < expected_until_ns_.at(static_cast<std::size_t>(kind));
}

bool mode_watch::is_taken_over_by(const flight_mode& mode, std::int64_t now_ns) {
  if (ours_ == mode)
    return false;
  if (ours_ && !is_expected(mode.kind, now_ns))
    return true;
  expected_until_ns_.at(static_cast<std::size_t>(mode.kind)) = 0; // the next change into it is another's
  ours_ = mode;
  return false;
}

} // namespace godwit::executor
