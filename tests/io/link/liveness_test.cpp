#include "io/link/liveness.hpp"

#include <optional>

#include <gtest/gtest.h>

namespace godwit::io::link {
namespace liveness_test {

TEST(liveness, a_handler_is_called_with_its_arguments_while_its_owner_lives) {
  const liveness alive;
  int sum = 0;
  auto handler = alive.guard([&sum](int first, int second) { sum = first + second; });
  handler(2, 3);
  EXPECT_EQ(sum, 5);
}

TEST(liveness, a_handler_of_an_owner_that_is_gone_does_nothing) {
  std::optional<liveness> alive(std::in_place);
  bool called = false;
  auto handler = alive->guard([&called] { called = true; });
  alive.reset();
  handler();
  EXPECT_FALSE(called);
}

} // namespace liveness_test
} // namespace godwit::io::link
