#include <fstream>
#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/mavlink/tlog/tlog_reader.hpp"
#include "programs/godwit-trace/tlog_run.hpp"
#include "tests/programs/godwit-trace/tool_fixture.hpp"

namespace godwit::trace_tool::test {

namespace tlog_run_test {

using nlohmann::json;

tlog_options options_for(const std::string& file, print_form form = print_form::text) {
  tlog_options options;
  options.file = file;
  options.print.form = form;
  return options;
}

message_filter names(const std::string& list) { return message_filter(*name_filter::parse(std::vector{list}), {}, {}); }

json stats_of(tlog_options options) {
  options.print.stats = true;
  options.print.form = print_form::json;
  kept_console console;
  EXPECT_EQ(run_tlog(options, console.to), exit_code::ok);
  EXPECT_EQ(console.words(), "");
  return json::parse(console.out());
}

struct recording {
  const char* name;
  int frames, known, other, signed_frames;
  std::map<std::string, int> by_sender;
};

TEST(tlog_run, the_counts_of_recordings_are_those_that_were_counted_by_others) {
  const recording recordings[] = {
      {"ardurover_mission.tlog", 7'219, 2'846, 4'373, 0, {{"1/1", 7'110}, {"255/190", 109}}},
      {"ardurover_signing_serial1.tlog", 557, 277, 280, 387, {{"1/1", 515}, {"255/190", 42}}},
      {"px4_quad_mission.tlog", 28'799, 8'986, 19'813, 0, {{"1/1", 28'684}, {"255/190", 115}}},
      {"mavsdk_client_vs_passive.tlog", 52, 52, 0, 0, {{"245/190", 38}, {"1/1", 14}}}};
  for (const auto& each : recordings) {
    SCOPED_TRACE(each.name);
    const auto stats = stats_of(options_for(capture(each.name)));
    EXPECT_EQ(stats.at("frames"), each.frames);
    EXPECT_EQ(stats.at("known"), each.known);
    EXPECT_EQ(stats.at("other"), each.other);
    EXPECT_EQ(stats.at("signed"), each.signed_frames);
    for (const auto& [cause, count] : stats.at("passed_over").items())
      EXPECT_EQ(count, 0) << cause;
    std::map<std::string, int> by_sender;
    for (const auto& sender : stats.at("senders"))
      by_sender[std::to_string(sender.at("system").get<int>()) + '/' +
                std::to_string(sender.at("component").get<int>())] = sender.at("received").get<int>();
    EXPECT_EQ(by_sender, each.by_sender);
  }
}

TEST(tlog_run, the_messages_of_a_vehicle_are_counted_by_name) {
  auto options = options_for(capture("px4_quad_mission.tlog"));
  const std::vector<std::uint8_t> vehicle{1};
  options.print.filter = message_filter(name_filter(), vehicle, {});
  std::map<std::string, int> counts;
  const auto stats = stats_of(options);
  for (const auto& row : stats.at("messages"))
    counts[row.at("name").get<std::string>()] = row.at("count").get<int>();
  const std::map<std::string, int> some{{"ATTITUDE", 3'824},         {"HEARTBEAT", 77}, {"MISSION_ITEM_REACHED", 47},
                                        {"MISSION_REQUEST_INT", 10}, {"STATUSTEXT", 7}, {"VFR_HUD", 306}};
  for (const auto& [name, count] : some)
    EXPECT_EQ(counts[name], count) << name;
}

TEST(tlog_run, a_line_for_each_message_in_the_order_of_the_log) {
  auto options = options_for(capture("mavsdk_client_vs_passive.tlog"));
  options.print.filter = names("PING,MISSION_COUNT");
  options.time = print_time::since_begin;
  kept_console console;
  EXPECT_EQ(run_tlog(options, console.to), exit_code::ok);
  const auto lines = lines_of(console.out());
  ASSERT_EQ(lines.size(), 6U);
  EXPECT_EQ(lines[0], "    0.507547 245/190 MISSION_COUNT        target_system=1 target_component=1 count=3 "
                      "mission_type=0(MISSION) opaque_id=0");
  EXPECT_EQ(lines[5], "    5.010145 245/190 PING                 time_usec=4658766484 seq=0 target_system=0 "
                      "target_component=0");
  EXPECT_EQ(console.words(), "");
}

TEST(tlog_run, every_line_of_json_reads_back) {
  kept_console console;
  EXPECT_EQ(run_tlog(options_for(capture("ardurover_mission.tlog"), print_form::json), console.to), exit_code::ok);
  std::size_t with_fields = 0;
  const auto lines = lines_of(console.out());
  for (const auto& each : lines)
    with_fields += json::parse(each).contains("fields") ? 1 : 0;
  EXPECT_EQ(lines.size(), 7'219U);
  EXPECT_EQ(with_fields, 2'846U);
}

TEST(tlog_run, a_key_never_reaches_the_output) {
  for (const auto form : {print_form::text, print_form::json}) {
    auto options = options_for(capture("ardurover_signing_serial1.tlog"), form);
    options.print.filter = names("SETUP_SIGNING");
    kept_console console;
    EXPECT_EQ(run_tlog(options, console.to), exit_code::ok);
    const auto lines = lines_of(console.out());
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_LT(lines[0].size(), 230U) << lines[0];
    EXPECT_EQ(lines[0].find("\"secret_key\""), std::string::npos);
  }
}

TEST(tlog_run, a_range_of_time_is_relative_or_utc) {
  auto options = options_for(capture("mavsdk_client_vs_passive.tlog"));
  options.range = {time_mark{true, 2'022'491}, time_mark{true, 2'526'737}};
  const auto part = stats_of(options);
  EXPECT_EQ(part.at("first_us").get<std::uint64_t>() -
                stats_of(options_for(options.file)).at("first_us").get<std::uint64_t>(),
            2'022'491U);
  EXPECT_LT(part.at("duration_s"), 0.504246);
  options.range = {time_mark{false, part.at("first_us").get<std::uint64_t>()},
                   time_mark{false, part.at("last_us").get<std::uint64_t>() + 1}};
  EXPECT_EQ(stats_of(options), part);
}

TEST(tlog_run, broken_records_are_passed_over_and_told_at_the_end) {
  for (const char* name : {"ardurover_probes.tlog", "px4_quad_probes.tlog"}) {
    kept_console console;
    EXPECT_EQ(run_tlog(options_for(capture(name)), console.to), exit_code::ok);
    EXPECT_NE(console.out(), "");
    const auto words = lines_of(console.words());
    ASSERT_EQ(words.size(), 1U);
    EXPECT_NE(words[0].find(std::string(name) + ": passed over: frames with a wrong checksum (CRC): "),
              std::string::npos)
        << words[0];
  }
}

TEST(tlog_run, the_bytes_of_a_link_are_read_with_a_word_of_doubt) {
  kept_console console;
  EXPECT_EQ(run_tlog(options_for(capture("ardurover_mission.rx.bin")), console.to), exit_code::ok);
  EXPECT_EQ(lines_of(console.out()).size(), 7'110U);
  EXPECT_NE(console.words().find("no frame has a time before it"), std::string::npos);
}

TEST(tlog_run, a_file_that_is_no_log_fails_with_a_sentence) {
  const temporary_folder folder;
  std::ofstream(folder / "empty").flush();
  std::ofstream(folder / "text") << "this is not a log\n";
  const std::pair<std::string, std::string> files[] = {
      {folder / "missing", "no such file"},
      {folder / ".", "it is a folder, not a file"},
      {folder / "empty", "it is empty"},
      {folder / "text", "this is no .tlog: there is not one MAVLink 2 frame with a right checksum in 18 bytes"},
      {"/dev/null", "it is not a file on a disk, and a log is not read from anything else; save it first"}};
  for (const auto& [file, sentence] : files) {
    kept_console console;
    EXPECT_EQ(run_tlog(options_for(file), console.to), exit_code::failed) << file;
    EXPECT_EQ(console.words(), std::string("godwit-trace: ").append(file).append(": ").append(sentence).append("\n"));
    EXPECT_EQ(console.out(), "");
  }
}

} // namespace tlog_run_test

namespace tlog_recording_test {

using namespace io::mavlink;

TEST(tlog_recording, what_is_recorded_is_a_log_without_signatures_and_keys) {
  const temporary_folder folder;
  signer key(counting_key(), link_id{1}, signing_time{0});
  auto frame = encode(heartbeat{}, {1, 1}, 0, signing::on);
  ASSERT_TRUE(key.sign(frame, static_cast<std::int64_t>(some_day_us) * 1'000));
  tlog_recording recording;
  ASSERT_TRUE(recording.open(folder / "a.tlog"));
  EXPECT_EQ(recording.write(some_day_us, frame.view()), "");
  EXPECT_EQ(recording.write(some_day_us, frame_of(setup_signing{}).view()), "");
  EXPECT_EQ(recording.flush(), "");
  EXPECT_EQ(recording.close(), folder / "a.tlog" + ": 1 frames recorded, 1 with a key left out");
  io::mcap::file_source source;
  ASSERT_TRUE(source.open(folder / "a.tlog"));
  tlog_reader reader(source);
  const auto record = reader.next();
  ASSERT_TRUE(record && *record);
  EXPECT_EQ((*record)->timestamp_us, some_day_us);
  EXPECT_FALSE((*record)->frame.is_signed());
}

TEST(tlog_recording, without_a_file_nothing_is_recorded_or_said) {
  tlog_recording recording;
  EXPECT_EQ(recording.write(1, frame_of(heartbeat{}).view()), "");
  EXPECT_EQ(recording.flush(), "");
  EXPECT_EQ(recording.close(), "");
}

TEST(tlog_recording, a_place_that_can_not_be_is_refused_at_once) {
  const temporary_folder folder;
  EXPECT_NE(tlog_recording().open(folder / ".").error().find("a folder"), std::string::npos);
  EXPECT_NE(tlog_recording().open(folder / "no/a.tlog").error().find("there is no folder"), std::string::npos);
}

TEST(tlog_recording, what_can_not_be_written_is_said_once_and_counted) {
  tlog_recording recording;
  ASSERT_TRUE(recording.open("/proc/godwit.tlog")) << "a folder in which nobody can make a file";
  std::size_t sentences = 0;
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(recording.write(some_day_us, frame_of(heartbeat{}).view()), "");
    sentences += recording.flush().empty() ? 0 : 1;
  }
  EXPECT_EQ(sentences, 1U);
  EXPECT_TRUE(recording.has_lost());
  EXPECT_NE(recording.close().find("3 lost"), std::string::npos);
}

} // namespace tlog_recording_test

} // namespace godwit::trace_tool::test
