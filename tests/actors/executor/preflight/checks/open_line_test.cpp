#include "actors/executor/preflight/checks.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace open_line_test {

using namespace test;

const settings open{.open_line = "udpin://0.0.0.0:14550"};

TEST(open_line_check, passes_on_a_line_with_a_key_or_inside_of_the_vehicle) {
  EXPECT_EQ(check_open_line(good_facts(), {}).how, verdict::pass);
}

TEST(open_line_check, is_degraded_without_a_key_and_names_line_vehicle_and_remedy) {
  auto seen = good_facts();
  seen.vehicle.line.vehicle = vehicle_link::vehicle_name{7, 1};
  const auto found = check_open_line(seen, open);
  EXPECT_EQ(found.how, verdict::degraded);
  for (const auto* each : {"vehicle 7", "udpin://0.0.0.0:14550", "vehicle.key_file", "acknowledge"})
    EXPECT_NE(found.sentence.find(each), std::string::npos) << found.sentence;
  EXPECT_TRUE(is_about_open_line(found.sentence));
}

TEST(open_line_check, is_skipped_while_nobody_is_heard) {
  auto seen = good_facts();
  seen.vehicle.link = vehicle_link::connection_phase::lost;
  EXPECT_EQ(check_open_line(seen, open).how, verdict::skipped);
}

} // namespace open_line_test
} // namespace godwit::executor::preflight
