#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "programs/godwit-trace/traffic.hpp"
#include "tests/programs/godwit-trace/tool_fixture.hpp"

namespace godwit::trace_tool::test {
namespace traffic_json_test {

using namespace io::mavlink;

nlohmann::json json_of(const traffic_report& report) {
  std::string out;
  append_traffic_json(out, report);
  return nlohmann::json::parse(out);
}

TEST(traffic_json, it_is_one_object_with_all_that_the_table_has) {
  traffic heard;
  heard.note(some_day_us, frame_of(heartbeat{}).view());
  heard.note(some_day_us + 2'000'000, raw_frame(54'321, {1}).view());
  const auto json = json_of({heard, {sender_counters{{1, 1}, 0, 0, 3, 1, 2}}, {{"bad", "bad ones", 4}}});
  EXPECT_EQ(json.at("frames"), 2);
  EXPECT_EQ(json.at("known"), 1);
  EXPECT_EQ(json.at("other"), 1);
  EXPECT_EQ(json.at("duration_s"), 2.0);
  EXPECT_EQ(json.at("bytes"), 21 + 13);
  EXPECT_EQ(json.at("first_us"), some_day_us);
  EXPECT_EQ(json.at("messages").size(), 2U);
  EXPECT_EQ(json.at("messages").at(0),
            nlohmann::json::parse(R"({"system":1,"component":1,"id":0,"name":"HEARTBEAT","count":1,)"
                                  R"("rate_hz":0.5,"mean_bytes":21})"));
  EXPECT_EQ(json.at("messages").at(1).at("name"), "UNKNOWN_54321");
  EXPECT_EQ(json.at("senders").at(0).at("lost"), 1);
  EXPECT_EQ(json.at("senders").at(0).at("out_of_order"), 2);
  EXPECT_EQ(json.at("passed_over").at("bad"), 4);
}

TEST(traffic_json, a_rate_that_is_not_known_is_null) {
  traffic heard;
  heard.note(5, frame_of(heartbeat{}).view());
  EXPECT_TRUE(json_of({heard, {}, {}}).at("messages").at(0).at("rate_hz").is_null());
}

} // namespace traffic_json_test
} // namespace godwit::trace_tool::test
