#include "programs/godwit-trace/message_printer.hpp"

#include <gtest/gtest.h>

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
} // namespace godwit::trace_tool::test
