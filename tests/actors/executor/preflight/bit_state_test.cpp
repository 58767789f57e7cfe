#include "actors/executor/preflight/bit_state.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/fields/json_text.hpp"
#include "io/fields/json_value.hpp"

namespace godwit::executor::preflight {
namespace bit_state_test {

TEST(preflight_state, it_comes_back_from_json_as_it_went) {
  const state before{phase::awaiting_ack,
                     "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42",
                     3,
                     true,
                     17,
                     open_report{17, {"The camera gives no picture."}, 1'780'000'000'000'000'000, "Ada"},
                     "why"};
  state after;
  ASSERT_TRUE(io::read_json(nlohmann::json::parse(io::to_json(before)), after));
  EXPECT_TRUE(io::equal(after, before));
}

} // namespace bit_state_test
} // namespace godwit::executor::preflight
