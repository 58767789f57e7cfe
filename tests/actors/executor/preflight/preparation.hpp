// A flight that is prepared, with the state of its preflight checks, a clock, and all that was announced. Thread: one
// owner.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "actors/executor/preflight/bit.hpp"

namespace godwit::executor::preflight::test {

using texts = std::vector<std::string>;

inline const std::string survey = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";
inline const std::string delivery = "00000000-0000-4000-8000-000000000001";
inline constexpr std::int64_t one_second_ns = 1'000'000'000;

inline const texts camera{"The camera gives no picture."};
inline const texts map{"A copy of the map is used."};
inline const texts both{camera[0], map[0]};
inline const texts no_home{"The vehicle has no home."};

// A report of a look in which one check passed, and these found something.
inline report found(const texts& degraded, const texts& failing = {}, const std::string& mission_id = survey,
                    std::int32_t revision = 1) {
  report result{0, mission_id, revision, {}, {{"sound", verdict::pass, "All is well."}}};
  for (const auto& each : degraded)
    result.findings.push_back({"weak", verdict::degraded, each});
  for (const auto& each : failing)
    result.findings.push_back({"broken", verdict::fail, each});
  result.overall = worst_of(result.findings);
  return result;
}

class preparation {
public:
  // The checks of SURVEY at its first revision are wanted.
  preparation() { happens(checks_wanted{survey, 1}); }

  announcements happens(const event& what) {
    now_ns += one_second_ns;
    return apply(s, what, now_ns);
  }
  announcements looks(const texts& degraded, const texts& failing = {}) {
    return happens(looked{found(degraded, failing)});
  }
  // The answer.
  acknowledgement_answered acknowledges(std::uint32_t id, const std::string& by = "Ada") {
    return std::get<acknowledgement_answered>(happens(acknowledged{id, by}).at(0));
  }
  void passes_s(std::int64_t seconds) { now_ns += seconds * one_second_ns; }

  [[nodiscard]] bool is_passed() const { return preflight::is_passed(s, survey, 1); }

  state s;
  std::int64_t now_ns = 1'780'000'000 * one_second_ns;
};

template <class What>
std::optional<What> said(const announcements& all) {
  for (const auto& each : all)
    if (const auto* it = std::get_if<What>(&each); it != nullptr)
      return *it;
  return std::nullopt;
}

} // namespace godwit::executor::preflight::test
