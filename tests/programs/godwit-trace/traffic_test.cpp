#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "programs/godwit-trace/traffic.hpp"
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

namespace signature_check_test {

using namespace io::mavlink;

frame_buffer signed_heartbeat(std::uint8_t key_first, std::uint64_t at_us) {
  signer key(counting_key(key_first), link_id{1}, signing_time{0});
  auto frame = encode(heartbeat{}, {1, 1}, 0, signing::on);
  EXPECT_TRUE(key.sign(frame, static_cast<std::int64_t>(at_us) * 1'000));
  return frame;
}

std::uint64_t count_of(const signature_check& check, std::string_view key) {
  for (const auto& each : check.refused())
    if (each.key == key)
      return each.count;
  return 0;
}

TEST(signature_check, without_a_key_everything_passes) {
  signature_check check(std::nullopt);
  EXPECT_TRUE(check.judge(frame_of(heartbeat{}).view(), some_day_us).is_accepted);
  EXPECT_TRUE(check.judge(signed_heartbeat(9, some_day_us).view(), some_day_us).is_accepted);
  EXPECT_TRUE(check.refused().empty());
}

TEST(signature_check, with_a_key_only_what_is_signed_with_it_passes) {
  signature_check check(counting_key());
  EXPECT_TRUE(check.judge(signed_heartbeat(1, some_day_us).view(), some_day_us).is_accepted);
  const auto other = check.judge(signed_heartbeat(2, some_day_us + 1'000).view(), some_day_us);
  EXPECT_FALSE(other.is_accepted);
  EXPECT_EQ(other.sentence, "refused HEARTBEAT of 1/1: its signature is wrong: another key, or changed on the way "
                            "(further ones are only counted)");
  EXPECT_FALSE(check.judge(frame_of(heartbeat{}).view(), some_day_us).is_accepted);
  EXPECT_FALSE(check.judge(signed_heartbeat(1, some_day_us).view(), some_day_us).is_accepted) << "replayed";
  EXPECT_EQ(count_of(check, "refused_bad_signature"), 1U);
  EXPECT_EQ(count_of(check, "refused_unsigned"), 1U);
  EXPECT_EQ(count_of(check, "refused_replayed"), 1U);
}

TEST(signature_check, each_cause_is_said_once) {
  signature_check check(counting_key());
  EXPECT_NE(check.judge(frame_of(heartbeat{}).view(), some_day_us).sentence, "");
  EXPECT_EQ(check.judge(frame_of(heartbeat{}).view(), some_day_us).sentence, "");
  EXPECT_NE(check.judge(signed_heartbeat(2, some_day_us).view(), some_day_us).sentence, "");
  EXPECT_EQ(count_of(check, "refused_unsigned"), 2U);
}

TEST(signature_check, a_clock_that_is_wrong_is_told_as_such) {
  signature_check check(counting_key());
  constexpr std::uint64_t hour_us = 3'600'000'000;
  EXPECT_NE(check.judge(signed_heartbeat(1, some_day_us + hour_us).view(), some_day_us).sentence.find("ahead"),
            std::string::npos);
  EXPECT_NE(check.judge(signed_heartbeat(1, some_day_us - hour_us).view(), some_day_us).sentence.find("old"),
            std::string::npos);
}

} // namespace signature_check_test

} // namespace godwit::trace_tool::test
