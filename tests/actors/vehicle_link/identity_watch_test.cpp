#include "actors/vehicle_link/identity_watch.hpp"

#include <gtest/gtest.h>

#include "tests/support/time_units.hpp"

namespace identity_watch_test {

using namespace godwit;
using godwit::tests::ms;
using godwit::tests::s;
using vehicle_link::identity_watch;

constexpr io::mavlink::sender name{1, 1};

TEST(identity_watch, two_clocks_that_go_on_in_turn_are_two_vehicles) {
  identity_watch watch;
  for (std::uint32_t i = 0; i < 10; ++i) {
    watch.on_boot_time(500'000 + i * 200, i * 200 * ms);
    watch.on_boot_time(20'000 + i * 200, i * 200 * ms + 50 * ms);
  }
  const auto sentence = watch.twin(name, 2 * s);
  for (const char* part : {"Two vehicles speak as 1/1", "480 s apart", "system id of its own"})
    EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
  EXPECT_EQ(watch.twin(name, 20 * s), "") << "one of them is gone";
}

TEST(identity_watch, a_restart_frames_that_come_late_and_a_clock_that_runs_faster_are_one_vehicle) {
  identity_watch restarts;
  identity_watch late;
  identity_watch fast; // a simulated one, at any speed
  identity_watch very_fast;
  for (std::uint32_t i = 0; i < 100; ++i) {
    restarts.on_boot_time((i < 50 ? 500'000 : 0) + i * 200, i * 200 * ms);
    late.on_boot_time(500'000 + i * 200, i * 200 * ms);
    late.on_boot_time(496'000 + i * 200, i * 200 * ms + ms);
    fast.on_boot_time(i * 2'000, i * 200 * ms);
    very_fast.on_boot_time(i * 20'000, i * 200 * ms);
    EXPECT_EQ(restarts.twin(name, i * 200 * ms) + late.twin(name, i * 200 * ms) + fast.twin(name, i * 200 * ms) +
                  very_fast.twin(name, i * 200 * ms),
              "")
        << i;
  }
}

TEST(identity_watch, two_places_in_turn_are_two_vehicles_and_a_jump_of_the_gps_is_none) {
  const geo::point here{47.397742, 8.545594};
  const geo::point there{47.45, 8.545594};
  identity_watch watch;
  identity_watch jumps;
  for (int i = 0; i < 10; ++i) {
    watch.on_place(here, i * 200 * ms);
    watch.on_place(there, i * 200 * ms + ms);
    jumps.on_place(i == 5 ? there : here, i * 200 * ms);
  }
  EXPECT_NE(watch.twin(name, 2 * s).find("m apart"), std::string::npos) << watch.twin(name, 2 * s);
  EXPECT_EQ(jumps.twin(name, 2 * s), "");
}

TEST(identity_watch, two_counts_in_turn_are_two_senders_and_losses_and_copies_are_none) {
  identity_watch watch;
  identity_watch loses;
  identity_watch doubles;
  for (int i = 0; i < 60; ++i) {
    const auto at = i * 50 * ms;
    watch.on_sequence(static_cast<std::uint8_t>(i), at);
    watch.on_sequence(static_cast<std::uint8_t>(i + 100), at);
    loses.on_sequence(static_cast<std::uint8_t>(i * 23), at);
    doubles.on_sequence(static_cast<std::uint8_t>(i), at);
    doubles.on_sequence(static_cast<std::uint8_t>(i - i % 4), at); // again, and late
  }
  EXPECT_NE(watch.other_sender(name, 3 * s).find("two senders"), std::string::npos);
  EXPECT_EQ(watch.twin(name, 3 * s), "") << "it may be two ways of one";
  EXPECT_EQ(loses.other_sender(name, 3 * s), "");
  EXPECT_EQ(doubles.other_sender(name, 3 * s), "");
}

TEST(identity_watch, a_program_that_is_no_autopilot_is_named_for_as_long_as_it_speaks) {
  identity_watch watch;
  watch.on_other_program(s);
  EXPECT_NE(watch.other_sender(name, 2 * s).find("another program speaks as 1/1"), std::string::npos);
  EXPECT_EQ(watch.other_sender(name, 12 * s), "");
}

} // namespace identity_watch_test
