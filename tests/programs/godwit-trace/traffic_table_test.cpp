#include <gtest/gtest.h>

#include "programs/godwit-trace/traffic.hpp"
#include "tests/programs/godwit-trace/tool_fixture.hpp"

namespace godwit::trace_tool::test {
namespace traffic_table_test {

using namespace io::mavlink;

TEST(traffic_table, messages_senders_and_totals_are_told) {
  traffic heard;
  heard.note(some_day_us, frame_of(heartbeat{}).view());
  heard.note(some_day_us + 500'000, frame_of(heartbeat{}).view());
  heard.note(some_day_us + 2'000'000, raw_frame(31, {1}).view());
  const traffic_report report{heard,
                              {sender_counters{{1, 1}, 0, 0, 3, 1, 2}},
                              {{"bad", "bad ones", 4}, {"none", "what is not there", 0}, {"cut", "cut ones", 1}}};
  std::string out;
  append_table(out, report);
  EXPECT_EQ(lines_of(out), (std::vector<std::string>{
                               "SENDER   MESSAGE                                   COUNT         HZ    BYTES",
                               "1/1      ATTITUDE_QUATERNION                           1       0.50     13.0",
                               "1/1      HEARTBEAT                                     2       1.00     21.0",
                               "",
                               "SENDER    RECEIVED       LOST   LOST %  OUT OF ORDER",
                               "1/1              3          1    25.00             2",
                               "",
                               "2026-06-09T10:13:20.123456Z to 2026-06-09T10:13:22.123456Z, 2.000 s",
                               "3 frames, 55 bytes: 2 of messages that are decoded, 1 of other ids; 0 signed",
                               "passed over: bad ones: 4; cut ones: 1",
                           }));
}

TEST(traffic_table, where_nothing_was_heard_there_are_no_tables) {
  const traffic heard;
  std::string out;
  append_table(out, {heard, {}, {}});
  EXPECT_EQ(out, "0 frames, 0 bytes: 0 of messages that are decoded, 0 of other ids; 0 signed\n"
                 "passed over: nothing\n");
}

} // namespace traffic_table_test
} // namespace godwit::trace_tool::test
