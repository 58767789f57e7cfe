#include "programs/godwitd/landing_watch/core.hpp"
#include "tests/support/time_units.hpp"

#include <gtest/gtest.h>

namespace godwit::landing_watch {
namespace landing_watch_core_test {

using godwit::tests::s;

// A heartbeat a second.
void beat(core& watch, bool is_armed, std::int64_t from_s, std::int64_t to_s) {
  for (auto at = from_s; at <= to_s; ++at)
    watch.on_heartbeat(is_armed, at * s);
}

TEST(landing_watch, a_vehicle_stands_that_is_heard_to_be_disarmed_for_ten_seconds) {
  core watch;
  EXPECT_FALSE(watch.stands(100 * s));
  beat(watch, true, 100, 110);
  EXPECT_FALSE(watch.stands(110 * s));
  beat(watch, false, 111, 120);
  EXPECT_FALSE(watch.stands(121 * s - 1));
  EXPECT_TRUE(watch.stands(121 * s));
}

TEST(landing_watch, who_was_armed_in_between_begins_anew) {
  core watch;
  beat(watch, false, 100, 120);
  beat(watch, true, 121, 121);
  beat(watch, false, 122, 131);
  EXPECT_FALSE(watch.stands(131 * s));
  beat(watch, false, 132, 132);
  EXPECT_TRUE(watch.stands(132 * s));
}

TEST(landing_watch, a_vehicle_that_is_not_heard_does_not_stand) {
  core watch;
  beat(watch, false, 100, 120);
  EXPECT_TRUE(watch.stands(120 * s + heard_ns));
  EXPECT_FALSE(watch.stands(120 * s + heard_ns + 1));
  beat(watch, false, 124, 124);
  EXPECT_FALSE(watch.stands(124 * s)) << "it may have been armed meanwhile";
}

runtime::child_report child(const std::string& name, runtime::child_phase phase) {
  runtime::child_report result;
  result.name = name;
  result.phase = phase;
  return result;
}

TEST(landing_watch, who_is_restarted_is_not_given_up) {
  runtime::children all;
  for (const auto phase : {runtime::child_phase::running, runtime::child_phase::starting}) {
    all.list = {child("executor", phase), child("other", runtime::child_phase::given_up)};
    EXPECT_FALSE(is_given_up(all, "executor"));
  }
  all.list[0].phase = runtime::child_phase::given_up;
  EXPECT_TRUE(is_given_up(all, "executor"));
}

} // namespace landing_watch_core_test
} // namespace godwit::landing_watch
