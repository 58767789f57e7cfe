#include "programs/godwitd/limit_check.hpp"

#include <gtest/gtest.h>

namespace godwit::daemon {
namespace limit_check_test {

TEST(limit_check, what_is_too_little_is_named_with_what_is_needed) {
  EXPECT_FALSE(objection_to_limits(limits_now()));
  EXPECT_FALSE(objection_to_limits({least_address_space, least_descriptors}));
  EXPECT_NE(objection_to_limits({least_address_space - 1, 1'024})->find("ulimit -v"), std::string::npos);
  EXPECT_NE(objection_to_limits({least_address_space, 20})->find("ulimit -n"), std::string::npos);
}

} // namespace limit_check_test
} // namespace godwit::daemon
