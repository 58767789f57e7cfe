#include "programs/godwit-trace/stop_signal.hpp"

#include <gtest/gtest.h>
#include <poll.h>

namespace godwit::trace_tool {
namespace {

bool is_readable(const stop_signal& stop) {
  pollfd watched{stop.descriptor(), POLLIN, 0};
  return ::poll(&watched, 1, 0) == 1;
}

TEST(stop_signal, ctrl_c_and_a_polite_kill_make_the_descriptor_readable) {
  for (const int each : {SIGINT, SIGTERM}) {
    const stop_signal stop;
    EXPECT_FALSE(is_readable(stop));
    ASSERT_EQ(::raise(each), 0);
    EXPECT_TRUE(is_readable(stop));
  }
}

TEST(stop_signal, afterwards_signals_are_as_they_were) {
  sigset_t before;
  sigset_t after;
  ::pthread_sigmask(SIG_SETMASK, nullptr, &before);
  { const stop_signal stop; }
  ::pthread_sigmask(SIG_SETMASK, nullptr, &after);
  EXPECT_EQ(sigismember(&before, SIGINT), sigismember(&after, SIGINT));
}

} // namespace
} // namespace godwit::trace_tool
