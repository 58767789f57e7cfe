#include "programs/godwit-trace/traffic.hpp"

#include <gtest/gtest.h>

#include "tests/programs/godwit-trace/tool_fixture.hpp"

namespace godwit::trace_tool::test {
namespace traffic_test {

using namespace io::mavlink;

TEST(traffic, rows_are_by_sender_and_message_and_sorted_by_name) {
  traffic heard;
  heard.note(10, frame_of(heartbeat{}, 0, {255, 190}).view());
  heard.note(20, frame_of(heartbeat{}).view());
  heard.note(30, frame_of(attitude{}).view());
  heard.note(40, frame_of(attitude{.roll = 1}).view());
  const auto rows = heard.rows();
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].id, 30U);
  EXPECT_EQ(rows[0].count, 2U);
  EXPECT_EQ(rows[0].bytes, 13U + 20U) << "zeros at the end are cut off on the wire";
  EXPECT_EQ(rows[1].id, 0U);
  EXPECT_EQ(rows[2].from, (sender{255, 190}));
}

TEST(traffic, totals_tell_decoded_from_other_messages) {
  traffic heard;
  heard.note(2'000'000, frame_of(heartbeat{}).view());
  heard.note(1'000'000, raw_frame(31, {1}).view());
  heard.note(1'500'000, raw_frame(54'321, {1}).view());
  const auto& totals = heard.totals();
  EXPECT_EQ(totals.frames, 3U);
  EXPECT_EQ(totals.known, 1U);
  EXPECT_EQ(totals.other(), 2U);
  EXPECT_EQ(totals.first_us, 1'000'000U);
  EXPECT_EQ(totals.duration_s(), 1.0);
  EXPECT_EQ(rate_hz(heard.rows().front(), totals), 1.0);
}

TEST(traffic, a_single_point_in_time_has_no_rate) {
  traffic heard;
  heard.note(5, frame_of(heartbeat{}).view());
  EXPECT_EQ(rate_hz(heard.rows().front(), heard.totals()), std::nullopt);
}

TEST(traffic, rows_are_bounded_and_what_has_none_is_counted) {
  traffic heard;
  for (std::uint32_t id = 0; id < traffic::max_rows + 10; ++id)
    heard.note(id, raw_frame(100'000 + id, {1}).view());
  heard.note(0, raw_frame(100'000, {1}).view());
  EXPECT_EQ(heard.rows().size(), traffic::max_rows);
  EXPECT_EQ(heard.totals().not_listed, 10U);
  EXPECT_EQ(heard.totals().frames, traffic::max_rows + 11);
}

} // namespace traffic_test
} // namespace godwit::trace_tool::test
