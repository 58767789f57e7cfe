#include <gtest/gtest.h>

#include "programs/godwit-trace/message_printer.hpp"
#include "tests/programs/godwit-trace/tool_fixture.hpp"

namespace godwit::trace_tool::test {

namespace message_printer_test {

using namespace io::mavlink;

const frame_buffer reached_frame = frame_of(mission_item_reached{.seq = 3}, 0, {1, 190});

std::string printed(const message_printer& printer, const frame_view& what) {
  std::string out;
  printer.append(out, some_day_us, what);
  return out;
}

TEST(message_printer, a_line_begins_with_time_and_sender) {
  EXPECT_EQ(printed(message_printer(print_form::text), reached_frame.view()),
            "2026-06-09T10:13:20.123456Z 1/190   MISSION_ITEM_REACHED seq=3\n");
}

TEST(message_printer, times_since_the_beginning_stand_in_a_column) {
  message_printer printer(print_form::text, print_time::since_begin);
  printer.begin_at(some_day_us - 1'500'000);
  EXPECT_EQ(printed(printer, reached_frame.view()), "    1.500000 1/190   MISSION_ITEM_REACHED seq=3\n");
  printer.begin_at(some_day_us + 1'500'000);
  EXPECT_EQ(printed(printer, reached_frame.view()), "   -1.500000 1/190   MISSION_ITEM_REACHED seq=3\n");
}

TEST(message_printer, signed_frames_say_so) {
  signer key(counting_key(), link_id{1}, signing_time{0});
  auto signed_frame = encode(mission_item_reached{.seq = 3}, {1, 1}, 0, signing::on);
  ASSERT_TRUE(key.sign(signed_frame, static_cast<std::int64_t>(some_day_us) * 1'000));
  EXPECT_EQ(printed(message_printer(print_form::text), signed_frame.view()),
            "2026-06-09T10:13:20.123456Z 1/1     MISSION_ITEM_REACHED seq=3 (signed)\n");
}

TEST(message_printer, json_has_a_line_for_each_message) {
  const auto line = printed(message_printer(print_form::json), reached_frame.view());
  EXPECT_TRUE(line.starts_with("{\"time_us\":1781000000123456,"));
  EXPECT_TRUE(line.ends_with("}\n"));
}

} // namespace message_printer_test

namespace message_filter_test {

using namespace io::mavlink;

TEST(message_filter, empty_lists_want_all) {
  EXPECT_TRUE(message_filter().wants(frame_of(heartbeat{}, 0, {255, 0}).view()));
  EXPECT_TRUE(message_filter({}, {}, {}).wants_sender({0, 255}));
}

TEST(message_filter, name_system_and_component_must_all_be_wanted) {
  const std::vector<std::string> names{"HEARTBEAT"};
  const std::vector<std::uint8_t> systems{1, 255};
  const std::vector<std::uint8_t> components{1};
  const message_filter filter(*name_filter::parse(names), systems, components);
  EXPECT_TRUE(filter.wants(frame_of(heartbeat{}, 0, {1, 1}).view()));
  EXPECT_TRUE(filter.wants(frame_of(heartbeat{}, 0, {255, 1}).view()));
  EXPECT_FALSE(filter.wants(frame_of(heartbeat{}, 0, {2, 1}).view()));
  EXPECT_FALSE(filter.wants(frame_of(heartbeat{}, 0, {1, 2}).view()));
  EXPECT_FALSE(filter.wants(frame_of(attitude{}, 0, {1, 1}).view()));
  EXPECT_TRUE(filter.wants_sender({1, 1}));
}

} // namespace message_filter_test

} // namespace godwit::trace_tool::test
