#include <thread>

#include <gtest/gtest.h>

#include "io/link/link.hpp"
#include "io/mavlink/codec.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "programs/godwitd/doctor/line_findings.hpp"

namespace godwit::daemon::doctor {

namespace line_findings_test {

using io::mavlink::mav_autopilot;
using io::mavlink::mav_type;
using io::mavlink::number;

const auto serial = io::link::parse_uri("serial:///dev/ttyACM0:115200").value();
const auto network = io::link::parse_uri("udpin://0.0.0.0:14550").value();

heard_sender vehicle(std::uint8_t system, bool is_signed = false) {
  return {system, 1, number(mav_type::quadrotor), number(mav_autopilot::px4), is_signed, 3};
}

heard_line hears(std::vector<heard_sender> who) {
  heard_line result{std::chrono::seconds(5), {}, {}, std::move(who)};
  result.counted.bytes = 9'000;
  result.counted.frames = 100;
  return result;
}

TEST(doctor_line, one_autopilot_on_a_serial_line_is_good) {
  const auto all = judge_line(hears({vehicle(1)}), {serial});
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].how, grade::good);
  EXPECT_EQ(all[0].sentence, "Vehicle 1 (PX4) is heard on serial:///dev/ttyACM0:115200.");
  EXPECT_EQ(all[1].how, grade::good);
}

TEST(doctor_line, silence_noise_and_mavlink_1_have_each_their_remedy) {
  heard_line heard{std::chrono::seconds(5), {}, {}, {}};
  EXPECT_NE(judge_line(heard, {serial}).front().remedy.find("RX and TX"), std::string::npos);
  heard.counted.bytes = 4'000;
  EXPECT_NE(judge_line(heard, {serial}).front().remedy.find("115200 the baud rate"), std::string::npos);
  heard.counted.v1_frames = 9;
  const auto all = judge_line(heard, {serial});
  EXPECT_EQ(all.front().how, grade::problem);
  EXPECT_NE(all.front().remedy.find("MAVLink 2"), std::string::npos);
}

TEST(doctor_line, a_line_that_does_not_open_says_why) {
  const auto all = judge_line({std::chrono::seconds(5), "nobody listens at 10.0.0.9:5760", {}, {}}, {network});
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all.front().sentence, "The line is not open: nobody listens at 10.0.0.9:5760.");
}

TEST(doctor_line, a_station_alone_is_no_autopilot) {
  const auto all =
      judge_line(hears({{255, 190, number(mav_type::gcs), number(mav_autopilot::invalid), false, 5}}), {network});
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all.front().how, grade::problem);
  EXPECT_NE(all.front().sentence.find("255/190"), std::string::npos);
}

TEST(doctor_line, which_of_two_autopilots_is_meant_has_to_be_set) {
  EXPECT_EQ(judge_line(hears({vehicle(1), vehicle(2)}), {serial}).front().how, grade::problem);
  EXPECT_EQ(judge_line(hears({vehicle(1), vehicle(2)}), {serial, 2}).front().how, grade::good);
  EXPECT_EQ(judge_line(hears({vehicle(1)}), {serial, 2}).front().how, grade::problem);
}

TEST(doctor_line, key_and_signatures_have_to_fit) {
  EXPECT_EQ(judge_line(hears({vehicle(1, true)}), {network}).back().how, grade::problem);
  EXPECT_EQ(judge_line(hears({vehicle(1)}), {network, 0, true}).back().how, grade::problem);
  EXPECT_EQ(judge_line(hears({vehicle(1, true)}), {network, 0, true}).back().how, grade::good);
  const auto open = judge_line(hears({vehicle(1)}), {network}).back();
  EXPECT_EQ(open.how, grade::warning);
  EXPECT_EQ(open.subject, "signing");
}

TEST(doctor_line, more_than_one_damaged_frame_of_twenty_is_a_warning) {
  auto heard = hears({vehicle(1)});
  heard.counted.bad_crc = 5;
  EXPECT_NE(judge_line(heard, {serial}).back().subject, "line");
  heard.counted.bad_crc = 6;
  EXPECT_EQ(judge_line(heard, {serial}).back().sentence, "6 of 106 frames arrive damaged.");
}

} // namespace line_findings_test

// The doctor on a real UDP line, with an autopilot at its other end that speaks when it hears somebody.

namespace line_listener_test {

namespace mavlink = io::mavlink;

TEST(doctor_listener, hears_an_autopilot_that_answers_its_heartbeats_and_ends_early) {
  const mavlink::heartbeat beat{.type = mavlink::number(mavlink::mav_type::quadrotor),
                                .autopilot = mavlink::number(mavlink::mav_autopilot::px4)};
  std::unique_ptr<io::link::link> autopilot;
  io::link::link_callbacks callbacks;
  callbacks.received = [&](io::link::peer_id, std::span<const std::byte>, bool) {
    for (std::uint8_t i = 0; i < 3; ++i)
      autopilot->send(mavlink::encode(beat, {7, 1}, i, mavlink::signing::off).span());
  };
  autopilot = io::link::open_link(io::link::parse_uri("udpin://127.0.0.1:0").value(), callbacks).value();
  while (autopilot->description().ends_with(":0")) // it is opened in the thread of the link
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const auto place = autopilot->description();
  const auto line = io::link::parse_uri("udpout://" + place.substr(place.find("127."))).value();
  const auto heard = listen_on(line, std::chrono::seconds(60));
  ASSERT_TRUE(heard) << heard.error();
  ASSERT_EQ(heard->senders.size(), 1U);
  EXPECT_EQ(heard->senders.front().system, 7);
  EXPECT_LT(heard->lasted, std::chrono::seconds(60));
  EXPECT_EQ(judge_line(*heard, {line}).front().how, grade::good);
}

TEST(doctor_listener, hears_nobody_for_as_long_as_it_may) {
  const auto heard = listen_on(io::link::parse_uri("udpin://127.0.0.1:0").value(), std::chrono::seconds(1));
  ASSERT_TRUE(heard) << heard.error();
  EXPECT_TRUE(heard->senders.empty());
  EXPECT_TRUE(heard->why_down.empty()) << heard->why_down;
  EXPECT_EQ(judge_line(*heard, {io::link::parse_uri("udpin://127.0.0.1:14550").value()}).front().how, grade::problem);
}

} // namespace line_listener_test

} // namespace godwit::daemon::doctor
