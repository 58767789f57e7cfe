#include "actors/executor/flight/vehicle_messages.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace godwit::executor {
namespace vehicle_messages_test {

constexpr std::int64_t second_ns = 1'000'000'000;

io::mavlink::statustext saying(std::string_view what, std::uint8_t severity = 6) {
  io::mavlink::statustext result{.severity = severity};
  std::copy_n(what.begin(), std::min(what.size(), result.text.size()), result.text.begin());
  return result;
}

// What people are told, as "line" or "! warning".
std::vector<std::string> told_of(const effects& what) {
  std::vector<std::string> result;
  for (const auto& each : what) {
    const auto& said = std::get<announce>(each);
    result.push_back((said.is_warning ? "! " : "") + said.sentence);
  }
  return result;
}

std::vector<std::string> take(vehicle_messages& messages, const io::mavlink::statustext& what, std::int64_t now_ns) {
  effects out;
  (void)messages.take(out, what, now_ns);
  return told_of(out);
}

std::vector<std::string> look(vehicle_messages& messages, std::int64_t now_ns) {
  effects out;
  (void)messages.look(out, now_ns);
  return told_of(out);
}

using lines = std::vector<std::string>;

TEST(vehicle_messages, what_the_vehicle_says_is_a_line_and_from_warning_up_a_warning) {
  vehicle_messages messages;
  EXPECT_EQ(take(messages, saying("Arming motors", 6), 0), lines{"the vehicle reports: Arming motors"});
  EXPECT_EQ(take(messages, saying("Takeoff detected", 5), 0), lines{"the vehicle reports: Takeoff detected"});
  EXPECT_EQ(take(messages, saying("PreArm: Compass not healthy", 4), 0),
            lines{"! the vehicle reports: PreArm: Compass not healthy"});
  EXPECT_EQ(take(messages, saying("Crash: Disarming", 0), 0), lines{"! the vehicle reports: Crash: Disarming"});
  EXPECT_EQ(take(messages, saying("for developers", 7), 0), lines{});
}

TEST(vehicle_messages, the_same_text_is_told_once_a_minute) {
  vehicle_messages messages;
  EXPECT_EQ(take(messages, saying("PreArm: GPS"), 0).size(), 1U);
  EXPECT_EQ(take(messages, saying("PreArm: GPS"), 30 * second_ns), lines{});
  EXPECT_EQ(take(messages, saying("PreArm: Gyros"), 30 * second_ns).size(), 1U);
  EXPECT_EQ(take(messages, saying("PreArm: GPS"), 60 * second_ns).size(), 1U);
}

TEST(vehicle_messages, of_a_flood_so_many_are_told_in_ten_seconds_and_how_many_were_left_out) {
  vehicle_messages messages;
  std::size_t told = 0;
  for (int i = 0; i < 1'000; ++i)
    told += take(messages, saying("text " + std::to_string(i)), 0).size();
  EXPECT_EQ(told, vehicle_messages::max_lines);
  EXPECT_EQ(look(messages, 9 * second_ns), lines{});
  EXPECT_EQ(look(messages, 10 * second_ns), lines{"! the vehicle has sent 980 more texts, which are left out"});
  EXPECT_EQ(take(messages, saying("text 999"), 11 * second_ns).size(), 1U) << "it was left out before";
  EXPECT_EQ(look(messages, 20 * second_ns), lines{});
}

// Also what no line is made of, and with each piece in its place.
TEST(vehicle_messages, a_text_in_pieces_is_given_on_as_one) {
  vehicle_messages messages;
  effects out;
  const std::string whole(70, 'x');
  auto piece = saying(whole.substr(0, 50), 4);
  piece.id = 3;
  EXPECT_TRUE(messages.take(out, piece, 0).empty());
  piece = saying(whole.substr(50), 4);
  piece.id = 3;
  piece.chunk_seq = 1;
  EXPECT_EQ(messages.take(out, piece, 0), (std::vector<flight::vehicle_message>{{4, whole}}));
}

TEST(vehicle_messages, a_text_whose_last_piece_was_lost_is_told_when_it_is_late) {
  vehicle_messages messages;
  auto first = saying(std::string(50, 'x'));
  first.id = 3;
  EXPECT_EQ(take(messages, first, 0), lines{});
  EXPECT_EQ(look(messages, second_ns), lines{"the vehicle reports: " + std::string(50, 'x') + "..."});
}

} // namespace vehicle_messages_test
} // namespace godwit::executor
