#include "tests/example/actors/odometer/core.hpp"

namespace godwit::odometer {

namespace {

std::vector<core::effect> decide(state& s, const moved& m, std::int64_t now_ns) {
  std::vector<core::effect> effects;
  const auto before_km = s.total_m / core::milestone_m;
  s.total_m += m.distance_m;
  for (auto km = before_km + 1; km <= s.total_m / core::milestone_m; ++km)
    effects.emplace_back(milestone{km, now_ns});
  return effects;
}

std::vector<core::effect> decide(state& s, const reset& r, std::int64_t) {
  if (!s.last_reset || s.last_reset->key != r.key) { // else it is asked again: what was counted since then stays
    s.last_reset = reset_done{r.key, s.total_m};
    s.total_m = 0;
  }
  return {*s.last_reset};
}

} // namespace

std::vector<core::effect> core::apply(state& s, const event& happened, std::int64_t now_ns) {
  return std::visit([&](const auto& each) { return decide(s, each, now_ns); }, happened);
}

// An odometer has nothing under way: what it owes is in the journal, and the runtime gives it out.
std::vector<core::effect> core::resume(const state&, std::int64_t) { return {}; }

tl::expected<nlohmann::json, std::string> core::migrate(nlohmann::json old, int from_version) {
  if (from_version != 1)
    return tl::unexpected("there never was a version " + std::to_string(from_version));
  old["last_reset"] = nullptr;
  return old;
}

} // namespace godwit::odometer
