// The doctor on a real UDP line, with an autopilot at its other end that speaks when it hears somebody.
#include "programs/godwitd/doctor/line_listener.hpp"

#include <thread>

#include <gtest/gtest.h>

#include "io/link/link.hpp"
#include "io/mavlink/codec.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages/heartbeat.hpp"

namespace godwit::daemon::doctor {
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
