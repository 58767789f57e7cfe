#include "programs/godwit-trace/actors/latency.hpp"

#include <gtest/gtest.h>

#include "programs/godwit-trace/actors/cause_index.hpp"
#include "programs/godwit-trace/actors/text_forms.hpp"

namespace godwit::trace_tool {
namespace latency_test {

TEST(latency_histogram, quantiles_are_exact_to_six_percent_at_every_size) {
  for (std::int64_t unit = 1; unit < 1'000'000'000'000; unit *= 10) {
    latency_histogram histogram;
    for (std::int64_t n = 1; n <= 1000; ++n)
      histogram.add(n * unit);
    for (const double part : {0.5, 0.99}) {
      const auto exact = static_cast<double>(unit) * 1000 * part;
      EXPECT_NEAR(static_cast<double>(histogram.quantile_ns(part)), exact, exact * 0.0625 + 1) << unit;
    }
    EXPECT_EQ(histogram.max_ns(), 1000 * unit);
    EXPECT_EQ(histogram.quantile_ns(1), 1000 * unit);
    EXPECT_EQ(histogram.count(), 1000U);
  }
}

TEST(latency_histogram, doublings_count_all) {
  latency_histogram histogram;
  for (const std::int64_t each : {0, 1, 2, 3, 4, 1024, 1500, -5})
    histogram.add(each);
  EXPECT_EQ(histogram.by_doubling(), (std::vector<std::uint64_t>{3, 2, 1, 0, 0, 0, 0, 0, 0, 0, 2}));
}

TEST(recent_handlers, a_message_waits_from_the_end_of_the_handler_that_sent_it) {
  recent_handlers recent;
  EXPECT_EQ(recent.waiting_ns({.id = 1, .began_ns = 100, .duration_ns = 50, .actor = 7}), std::nullopt);
  EXPECT_EQ(recent.waiting_ns({.id = 2, .cause = 1, .began_ns = 180, .actor = 8, .sender = 7}), 30);
  EXPECT_EQ(recent.waiting_ns({.id = 3, .cause = 1, .began_ns = 180, .actor = 7, .sender = 7}), std::nullopt)
      << "a timer";
  EXPECT_EQ(recent.waiting_ns({.run = 2, .id = 4, .cause = 1, .began_ns = 900, .actor = 8, .sender = 7}), std::nullopt)
      << "ids begin again with each run";
}

TEST(cause_index, a_family_is_bounded_and_says_so) {
  cause_index index;
  for (std::uint64_t id = 2; id <= 100; ++id)
    index.add(id, id - 1);
  index.add(50, 49); // taken twice
  index.sort();
  const auto all = index.family_of(50, 1000);
  EXPECT_EQ(all.ids.size(), 100U);
  EXPECT_EQ(all.origin, 1U);
  EXPECT_TRUE(all.is_all);
  const auto some = index.family_of(50, 60);
  EXPECT_EQ(some.ids.size(), 60U);
  EXPECT_FALSE(some.is_all);
}

TEST(text_forms, times_have_their_zone_and_durations_a_unit_that_fits) {
  EXPECT_EQ(utc_ns(1'795'421'029'195'141'393), "2026-11-23T08:03:49.195141393Z");
  EXPECT_EQ(utc_ns(-1), "1969-12-31T23:59:59.999999999Z");
  EXPECT_EQ(duration_text(999), "999 ns");
  EXPECT_EQ(duration_text(6'700), "6.7 us");
  EXPECT_EQ(duration_text(12'345'678), "12.3 ms");
  EXPECT_EQ(duration_text(4'560'000'000), "4.56 s");
}

TEST(text_forms, what_could_command_a_terminal_is_escaped) {
  std::string out;
  append_printable(out, "a\x1b[2Jb\n");
  EXPECT_EQ(out, "a\\x1b[2Jb\\x0a");
}

} // namespace latency_test
} // namespace godwit::trace_tool
