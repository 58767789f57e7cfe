#include "io/sqlite/writer_health.hpp"

#include <gtest/gtest.h>

namespace godwit::io::sqlite {
namespace writer_health_test {

using namespace std::chrono_literals;

const store_error full{.code = store_errc::disk_full, .file = "f", .what = "full", .remedy = {}};
const writer_health::time_point start{1h};

TEST(writer_health, it_tells_when_failing_turns_on_and_off) {
  int changes = 0;
  writer_health health({}, [&] { ++changes; });
  health.failed(full, start);
  health.failed(full, start + 1s);
  EXPECT_EQ(changes, 1);
  EXPECT_EQ(health.counts().failing_since, start);
  EXPECT_EQ(health.counts().last_error->what, "full");
  health.committed(3);
  health.committed(2);
  EXPECT_EQ(changes, 2);
  const auto counts = health.counts();
  EXPECT_FALSE(counts.failing_since || counts.last_error);
  EXPECT_EQ(counts.commits, 2U);
  EXPECT_EQ(counts.written, 5U);
  EXPECT_EQ(counts.retries, 2U);
}

TEST(writer_health, the_wait_doubles_up_to_the_last_and_begins_anew) {
  writer_health health({.first = 10ms, .last = 25ms}, {});
  EXPECT_TRUE(health.may_try(start));
  for (const auto wait : {10ms, 20ms, 25ms, 25ms}) {
    health.failed(full, start);
    EXPECT_FALSE(health.may_try(start + wait - 1ns));
    EXPECT_TRUE(health.may_try(start + wait));
  }
  health.committed(1);
  health.failed(full, start);
  EXPECT_EQ(health.next_try(), start + 10ms);
}

TEST(writer_health, a_try_at_once_does_not_wait) {
  writer_health health({}, {});
  health.failed(full, start);
  health.try_at_once(start);
  EXPECT_TRUE(health.may_try(start));
  EXPECT_TRUE(health.is_failing());
}

} // namespace writer_health_test
} // namespace godwit::io::sqlite
