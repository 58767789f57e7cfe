#include "programs/common/signal_descriptor.hpp"

#include <gtest/gtest.h>
#include <poll.h>

namespace godwit::programs {
namespace signal_descriptor_test {

bool is_readable(const signal_descriptor& stop) {
  pollfd watched{stop.descriptor(), POLLIN, 0};
  return ::poll(&watched, 1, 0) == 1;
}

TEST(signal_descriptor, ctrl_c_and_a_polite_kill_make_the_descriptor_readable) {
  for (const int each : {SIGINT, SIGTERM}) {
    const signal_descriptor stop({SIGINT, SIGTERM});
    EXPECT_FALSE(is_readable(stop));
    ASSERT_EQ(::raise(each), 0);
    EXPECT_TRUE(is_readable(stop));
    EXPECT_EQ(stop.take(), each);
    EXPECT_EQ(stop.take(), std::nullopt);
  }
}

TEST(signal_descriptor, afterwards_signals_are_as_they_were) {
  sigset_t before;
  sigset_t after;
  ::pthread_sigmask(SIG_SETMASK, nullptr, &before);
  { const signal_descriptor stop({SIGINT, SIGTERM}); }
  ::pthread_sigmask(SIG_SETMASK, nullptr, &after);
  EXPECT_EQ(sigismember(&before, SIGINT), sigismember(&after, SIGINT));
}

} // namespace signal_descriptor_test
} // namespace godwit::programs
