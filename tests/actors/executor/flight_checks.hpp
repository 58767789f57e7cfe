// What tests of flights ask of one. Thread: one.
#pragma once

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "tests/actors/executor/flight_world.hpp"

namespace godwit::tests {

[[nodiscard]] inline bool is_told(const flight_world& world, mission::progress_kind kind, const std::string& item) {
  return std::ranges::any_of(world.reports(),
                             [&](const auto& each) { return each.kind == kind && each.item_id == item; });
}

// Until it is told that of ITEM.
[[nodiscard]] inline testing::AssertionResult fly_to(flight_world& world, const mission::document& mission,
                                                     mission::progress_kind kind, const std::string& item) {
  world.load(mission);
  const bool came = world.run_until([&] { return is_told(world, kind, item); }, 900);
  return came ? testing::AssertionSuccess() : testing::AssertionFailure() << world.story();
}

} // namespace godwit::tests
