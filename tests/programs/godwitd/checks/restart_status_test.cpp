#include "programs/godwitd/checks/restart_status.hpp"

#include <gtest/gtest.h>

namespace godwit::daemon {
namespace restart_status_test {

nlohmann::json status(bool in_flight, bool is_armed, const char* phase) {
  return {{"ok", true},
          {"flight", {{"in_flight", in_flight}, {"is_armed", is_armed}, {"phase", phase}, {"sentence", phase}}}};
}

TEST(may_restart, only_while_no_flight_is_under_way_and_nothing_is_armed) {
  EXPECT_EQ(why_not_restart_now(status(false, false, "ready")), "");
  EXPECT_EQ(why_not_restart_now(status(true, true, "flying")), "a flight is under way: flying");
  EXPECT_EQ(why_not_restart_now(status(true, false, "paused")), "a flight is under way: paused");
  EXPECT_EQ(why_not_restart_now(status(false, true, "ready")), "the vehicle is armed: ready");
  EXPECT_EQ(why_not_restart_now(status(false, false, "starting")), "the vehicle is armed: starting");
}

TEST(may_restart, not_while_it_is_not_known) {
  EXPECT_NE(why_not_restart_now({{"ok", false}, {"error", "busy"}}).find("busy"), std::string::npos);
  EXPECT_NE(why_not_restart_now({{"ok", true}}), "");
  EXPECT_NE(why_not_restart_now({{"ok", true}, {"flight", {{"phase", "ready"}}}}), "");
}

} // namespace restart_status_test
} // namespace godwit::daemon
