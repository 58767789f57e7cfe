#include "actors/domain/vehicle_text/vehicle_text.hpp"

#include <algorithm>
#include <array>

namespace godwit::flight {
namespace {

constexpr std::array<std::string_view, 9> failsafes{
    "EKF Failsafe",      "Radio Failsafe",   "Battery Failsafe", "Radio + Battery Failsafe", "GCS Failsafe",
    "RC Short Failsafe", "RC Long Failsafe", "Terrain Failsafe", "Deadreckon Failsafe"};
constexpr std::array<std::string_view, 2> changes_nothing{"Cleared", "Continuing"};
constexpr std::array<std::string_view, 2> not_armed{"PreArm: ", "Preflight Fail: "};

constexpr std::array<std::string_view, 2> breaches{" fence breached", " fences breached"};
constexpr std::array<std::string_view, 2> new_plan{"Auto mission changed", "Flight plan received"};

template <class Texts>
bool begins_with_one_of(std::string_view text, const Texts& texts) {
  return std::ranges::any_of(texts, [&](std::string_view each) { return text.starts_with(each); });
}

} // namespace

std::string_view text_of(const io::mavlink::statustext& m) {
  const auto end = std::ranges::find(m.text, '\0');
  return {m.text.data(), static_cast<std::size_t>(end - m.text.begin())};
}

bool tells_failsafe(std::string_view text) {
  const auto says = [&](std::string_view word) { return text.find(word) != std::string_view::npos; };
  return begins_with_one_of(text, failsafes) && std::ranges::none_of(changes_nothing, says);
}

bool tells_fence_breach(std::string_view text) {
  return std::ranges::any_of(breaches, [&](std::string_view each) { return text.ends_with(each); });
}

bool tells_new_plan(std::string_view text) { return begins_with_one_of(text, new_plan); }

bool tells_landing_of_plan(std::string_view text) { return text == "Landing sequence start"; }

bool tells_why_not_armed(std::string_view text) { return begins_with_one_of(text, not_armed); }

} // namespace godwit::flight
