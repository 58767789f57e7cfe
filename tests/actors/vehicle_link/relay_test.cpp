// What is passed between the vehicle's line and the ground stations', and what never is.
#include <gtest/gtest.h>

#include "actors/vehicle_link/relay_gate.hpp"
#include "io/mavlink/ids.hpp"
#include "tests/actors/vehicle_link/vehicle_frames.hpp"

namespace godwit::vehicle_link {
namespace relay_test {

using namespace test;

class vehicle_relay : public testing::Test {
protected:
  vehicle_relay() {
    (void)it.on_link({io::link::link_phase::up, {}, 0}, at(0));
    (void)vehicle.beat(it, 0);
  }

  static settings relaying() {
    settings result;
    result.streams.clear();
    result.relays = true;
    return result;
  }
  effects say(std::uint32_t id, const std::vector<std::uint8_t>& payload, mavlink::sender from = {1, 1}) {
    const mavlink::frame_buffer frame(id, mavlink::find_message(id)->crc_extra, std::as_bytes(std::span(payload)), from,
                                      sequence_++, false);
    return it.on_bytes(io::link::only_peer, true, frame.span(), at(ms));
  }
  bool is_relayed(std::uint32_t id, const std::vector<std::uint8_t>& payload, mavlink::sender from = {1, 1}) {
    return !announced<relayed_frame>(say(id, payload, from)).empty();
  }

  core it{relaying(), {}, {}};
  vehicle_voice vehicle;

private:
  std::uint8_t sequence_ = 100;
};

TEST_F(vehicle_relay, what_is_not_read_here_goes_to_the_stations_as_it_came) {
  const auto told = announced<relayed_frame>(say(22, {0, 0, 128, 63, 1, 0, 0, 0, 'P'}));
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0], (relayed_frame{22, 1, 1, {0, 0, 128, 63, 1, 0, 0, 0, 'P'}}));
  EXPECT_EQ(it.describe(at(s)).relayed_to_stations, 1U);
  EXPECT_EQ(it.describe(at(s)).not_accepted, 0U);
}

TEST_F(vehicle_relay, other_components_of_the_vehicle_are_heard_and_other_systems_are_not) {
  EXPECT_TRUE(is_relayed(0, {0, 0, 0, 0, 26, 8, 0, 4, 3}, {1, 154}));
  EXPECT_FALSE(is_relayed(22, {0, 0, 128, 63, 1}, {2, 1}));
}

TEST_F(vehicle_relay, what_listeners_hear_anyway_is_not_told_twice) {
  EXPECT_FALSE(is_relayed(30, std::vector<std::uint8_t>(28, 1))); // ATTITUDE
  EXPECT_TRUE(is_relayed(193, std::vector<std::uint8_t>(22, 1))) << "EKF_STATUS_REPORT";
}

TEST_F(vehicle_relay, stations_hear_of_other_aircraft_whoever_reports_them) {
  for (const std::uint8_t component : {1, 156})
    EXPECT_TRUE(is_relayed(246, std::vector<std::uint8_t>(38, 1), {1, component})) << int{component};
  EXPECT_TRUE(is_relayed(247, std::vector<std::uint8_t>(19, 1))) << "COLLISION";
}

TEST_F(vehicle_relay, plans_clocks_keys_and_commands_of_the_vehicle_stay_here) {
  for (const std::uint32_t each : {4, 40, 44, 47, 51, 73, 75, 76, 111, 256})
    EXPECT_FALSE(is_relayed(each, std::vector<std::uint8_t>(12, 1))) << each;
}

TEST_F(vehicle_relay, an_answer_goes_to_the_stations_only_where_it_is_for_one) {
  EXPECT_TRUE(is_relayed(77, {0x90, 1, 0, 0, 0, 0, 0, 0, 255, 190}));
  EXPECT_FALSE(is_relayed(77, {0x90, 1, 0, 0, 0, 0, 0, 0, 1, 191}));
  EXPECT_FALSE(is_relayed(77, {0x90, 1})) << "of an older sender: for us";
}

TEST_F(vehicle_relay, a_stations_message_goes_to_the_vehicle_with_the_stations_ids) {
  const auto done = it.on_relayed({21, 255, 190, {1, 1}}, at(s));
  ASSERT_EQ(done.size(), 1U);
  const auto frame = std::get<transmission>(done[0]).frame.view();
  EXPECT_EQ(frame.id(), 21U);
  EXPECT_EQ(frame.from(), (mavlink::sender{255, 190}));
  EXPECT_TRUE(mavlink::crc_matches(frame, mavlink::find_message(21)->crc_extra));
}

TEST_F(vehicle_relay, nobody_speaks_to_the_vehicle_with_its_own_system_id_or_an_unknown_message) {
  EXPECT_TRUE(it.on_relayed({21, 1, 190, {1, 1}}, at(s)).empty());
  EXPECT_TRUE(it.on_relayed({99'999, 255, 190, {1, 1}}, at(s)).empty());
  EXPECT_EQ(it.describe(at(s)).relays_dropped, 2U);
}

TEST_F(vehicle_relay, nothing_is_relayed_where_nobody_wants_it) {
  core deaf(quiet(), {}, {});
  (void)deaf.on_link({io::link::link_phase::up, {}, 0}, at(0));
  vehicle_voice other;
  (void)other.beat(deaf, 0);
  EXPECT_TRUE(announced<relayed_frame>(other.say(deaf, mavlink::param_value{}, ms)).empty());
}

} // namespace relay_test
} // namespace godwit::vehicle_link
