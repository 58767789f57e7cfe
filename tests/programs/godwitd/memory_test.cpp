// What godwitd needs of memory while it pulls a large map. Not built with a sanitizer, which needs more itself.
#include <gtest/gtest.h>

#include "tests/programs/godwitd/daemon_world.hpp"
#include "tests/programs/godwitd/process.hpp"

namespace memory_test {

using namespace godwit::test;

// The most that was resident so far, in KiB; proc(5).
long peak_kib(int process) {
  const auto status = scratch::read("/proc/" + std::to_string(process) + "/status");
  const auto found = status.find("VmHWM:");
  return found == std::string::npos ? 0 : std::atol(status.c_str() + found + 6);
}

TEST(daemon_memory, a_pull_of_100000_objects_stays_below_150_mb) {
  const daemon_world world(100'000);
  program daemon(GODWITD, world.words("here"));
  ASSERT_TRUE(daemon.waits_for("map pulled: 100000 objects")) << daemon.said();
  const auto peak = peak_kib(daemon.id());
  RecordProperty("peak_kib", std::to_string(peak));
  EXPECT_GT(peak, 0);
  EXPECT_LE(peak, 150 * 1024);
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.ends(), 0) << daemon.said();
}

} // namespace memory_test
