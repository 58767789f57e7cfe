// The recorded transfers: what a ground station said to a real vehicle is said to a server with the habits of that
// vehicle, at the recorded times, and what it answers is compared with what the vehicle answered: each message in its
// order, with its type, result, sequence, content, and whether it has a plan id; and each sentence about transfers.
//
// Not compared: the times of answers, the value of plan ids, and how often an item is asked for again while nothing
// comes, which depends on milliseconds. What stays different is a
// `deviation` with its reason.
#include "actors/ground_port/mission_server/server.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <sstream>

#include <gtest/gtest.h>

#include "io/mavlink/codec.hpp"
#include "io/mavlink/messages.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "io/mavlink/tlog/tlog_reader.hpp"
#include "tests/actors/ground_port/mission_server/server_fixture.hpp"

namespace godwit::ground_port::mission_server::test {
namespace server_recordings_test {

using words = dialogue::words;

using from_stations =
    mavlink::message_list<mavlink::mission_count, mavlink::mission_item_int, mavlink::mission_item,
                          mavlink::mission_request, mavlink::mission_request_int, mavlink::mission_request_list,
                          mavlink::mission_ack, mavlink::mission_clear_all, mavlink::mission_write_partial_list>;
using from_vehicles =
    mavlink::message_list<mavlink::mission_request, mavlink::mission_request_int, mavlink::mission_ack,
                          mavlink::mission_count, mavlink::mission_item_int, mavlink::mission_item>;

struct answers {
  words messages;
  words texts;
};

template <class Item>
std::string content_of(const Item& item) {
  std::ostringstream out;
  out << " command " << item.command << " frame " << int{item.frame} << " current " << int{item.current} << " params "
      << item.param1 << ' ' << item.param2 << ' ' << item.param3 << ' ' << item.param4 << " at " << item.x << ' '
      << item.y << ' ' << item.z;
  return out.str();
}

// ArduPilot's item 0 is where it stands, which is not said by the station.
std::string line_for(const outgoing& message, bool has_home) {
  auto result = in_words(message);
  if (const auto* ack = std::get_if<mavlink::mission_ack>(&message))
    result += ack->opaque_id != 0 ? " with an id" : "";
  if (const auto* count = std::get_if<mavlink::mission_count>(&message))
    result += count->opaque_id != 0 ? " with an id" : "";
  if (const auto* item = std::get_if<mavlink::mission_item_int>(&message);
      item != nullptr && !(has_home && item->seq == 0))
    result += content_of(*item);
  if (const auto* item = std::get_if<mavlink::mission_item>(&message); item != nullptr && !(has_home && item->seq == 0))
    result += content_of(*item);
  return result;
}

void append(words& lines, const std::string& line) {
  const bool is_asked_again = !lines.empty() && lines.back() == line && line.find("REQUEST") != std::string::npos;
  if (!is_asked_again)
    lines.push_back(line);
}

// With a line each the difference is shown as such.
std::string in_lines(const words& all) {
  std::string result;
  for (const auto& each : all)
    result += each + '\n';
  return result;
}

// One recording, walked through.
class walk {
public:
  walk(const std::string& name, const server_profile& vehicle) : vehicle_(vehicle), server_(vehicle, vehicle_id) {
    io::mcap::file_source file;
    EXPECT_TRUE(file.open(std::filesystem::path(GODWIT_TEST_DATA) / "captures" / name));
    mavlink::tlog_reader reader(file);
    for (auto record = reader.next(); record && *record; record = reader.next())
      take(**record);
    wait_until(now_ns_ + 10 * s);
  }

  [[nodiscard]] const answers& recorded() const { return recorded_; }
  [[nodiscard]] const answers& ours() const { return ours_; }
  [[nodiscard]] int questions() const { return questions_; }

private:
  void take(const mavlink::tlog_record& record) {
    wait_until(static_cast<std::int64_t>(record.timestamp_us) * 1'000);
    const auto& frame = record.frame;
    if (frame.from() == vehicle_id) {
      from_vehicles::visit(frame, [&](const auto& m) { append(recorded_.messages, line_for(m, has_home())); });
      mavlink::message_list<mavlink::statustext>::visit(frame, [&](const auto& m) { take_text(m); });
    } else {
      from_stations::visit(frame, [&](const auto& m) {
        ++questions_;
        hear(server_.on(frame.from(), m, now_ns_));
      });
    }
  }

  // Of all that a vehicle says, what the table has.
  void take_text(const mavlink::statustext& m) {
    const std::string text(m.text.data(), strnlen(m.text.data(), m.text.size()));
    for (const auto& row : vehicle_.texts)
      if (text_facts facts; filled(row.text, (facts.room = vehicle_.capacity, facts)) == text) {
        recorded_.texts.push_back(text);
        return;
      }
  }

  void wait_until(std::int64_t until_ns) {
    while (server_.next_deadline_ns() <= until_ns) {
      now_ns_ = server_.next_deadline_ns();
      hear(server_.on_time(now_ns_));
    }
    now_ns_ = std::max(now_ns_, until_ns);
  }

  void hear(const reaction& what) {
    for (const auto& each : what.messages)
      append(ours_.messages, line_for(each, has_home()));
    for (const auto& each : what.texts)
      ours_.texts.push_back(each.text);
  }

  [[nodiscard]] bool has_home() const { return vehicle_.home.has_value(); }

  server_profile vehicle_;
  server server_;
  std::int64_t now_ns_ = 0;
  int questions_ = 0;
  answers recorded_;
  answers ours_;
};

// What a vehicle answered and ours does not, and why that stays.
struct deviation {
  std::string recorded;
  std::string ours;
  std::string reason;
};

void expect_as_recorded(const walk& seen, const std::vector<deviation>& deviations = {}) {
  auto expected = seen.recorded().messages;
  for (const auto& each : deviations) {
    const auto found = std::find(expected.begin(), expected.end(), each.recorded);
    ASSERT_NE(found, expected.end()) << "no longer needed: " << each.reason;
    *found = each.ours;
  }
  EXPECT_EQ(in_lines(seen.ours().messages), in_lines(expected));
  EXPECT_EQ(in_lines(seen.ours().texts), in_lines(seen.recorded().texts));
}

TEST(server_recordings, px4_answers_as_it_did_to_a_mission_and_a_fence) {
  const walk seen("px4_quad_mission.tlog", px4_profile());
  EXPECT_EQ(seen.questions(), 27);
  expect_as_recorded(seen);
}

TEST(server_recordings, px4_answers_as_it_did_to_everything_that_is_wrong) {
  const walk seen("px4_quad_probes.tlog", px4_profile());
  EXPECT_EQ(seen.questions(), 55);
  expect_as_recorded(seen, {{"ITEM 0 command 16 frame 3 current 0 params 0 0 0 0 at 47.3977 8.54564 0",
                             "ITEM 0 command 16 frame 3 current 1 params 0 0 0 0 at 47.3977 8.54564 0",
                             "it was asked 0.2 ms after the upload, before its navigator was at any item"}});
}

TEST(server_recordings, rover_answers_as_it_did_to_a_mission_and_a_fence) {
  const walk seen("ardurover_mission.tlog", ardupilot_rover_profile());
  EXPECT_EQ(seen.questions(), 25);
  expect_as_recorded(seen);
}

TEST(server_recordings, rover_answers_as_it_did_to_everything_that_is_wrong) {
  const walk seen("ardurover_probes.tlog", ardupilot_rover_profile());
  EXPECT_EQ(seen.questions(), 55);
  expect_as_recorded(seen);
}

// The peer of that client did not know the protocol, so there is nothing to compare. Each of its tries is answered.
TEST(server_recordings, a_client_whose_peer_was_silent_is_answered_each_time) {
  const walk seen("mavsdk_client_vs_passive.tlog", plain_profile());
  EXPECT_TRUE(seen.recorded().messages.empty());
  EXPECT_EQ(seen.questions(), 10) << "5 times the count, 5 times the list";
  const auto& said = seen.ours().messages;
  ASSERT_FALSE(said.empty());
  EXPECT_EQ(said.front(), "245/190 REQUEST_INT 0");
  EXPECT_EQ(std::count(said.begin(), said.end(), "245/190 ACK denied"), 5) << "its own upload is still open";
}

} // namespace server_recordings_test
} // namespace godwit::ground_port::mission_server::test
