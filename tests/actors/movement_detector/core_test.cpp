#include "actors/movement_detector/core.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "actors/domain/uuid/uuid.hpp"
#include "io/eyes/codec.hpp"
#include "tests/support/time_units.hpp"

namespace core_test {

using namespace godwit;
using namespace godwit::movement_detector;
using io::eyes::source_state;

using godwit::tests::ms;
using godwit::tests::s;
constexpr const char* mission = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";

template <class T>
std::vector<T> only(const effects& all) {
  std::vector<T> result;
  for (const auto& each : all)
    if (const auto* one = std::get_if<T>(&each))
      result.push_back(*one);
  return result;
}

// A core whose time is moved by hand.
struct eyes {
  explicit eyes(settings configured = a_camera()) : all(std::move(configured), 5, 0) {
    run = only<start_helper>(all.on_time(now)).at(0).run;
  }
  static settings a_camera() {
    settings result;
    result.uri = "test://ball";
    result.width_px = 640;
    result.height_px = 360;
    result.focal_px = 500;
    return result;
  }
  void pass(std::int64_t ns) {
    now.monotonic_ns += ns;
    now.wall_ns += ns;
  }
  effects status(source_state source = source_state::playing, const std::string& reason = {}) {
    helper_status said{run, {}};
    said.what.source = source;
    said.what.reason = reason;
    said.what.usable_at_ns = source == source_state::playing ? now.monotonic_ns : 0;
    return all.on_status(said, now);
  }
  effects telemetry() {
    io::mavlink::global_position_int where;
    where.lat = 473977000;
    where.lon = 85456000;
    where.relative_alt = 40'000;
    all.on_position(where, now);
    return all.on_attitude({}, now);
  }
  // Of a gimbal that looks so far down, along the vehicle's heading or along north.
  effects gimbal(double pitch_deg, std::uint16_t flags = io::mavlink::gimbal_device_flags::yaw_in_vehicle_frame) {
    const auto level = from_angles(0, pitch_deg * std::numbers::pi / 180, 0);
    io::mavlink::gimbal_device_attitude_status said;
    said.flags = flags;
    said.q = {static_cast<float>(level.w), static_cast<float>(level.x), static_cast<float>(level.y),
              static_cast<float>(level.z)};
    return all.on_gimbal(said, now);
  }
  void survey(bool is_flying = true) {
    scan_controller::survey_progress seen;
    seen.mission_id = mission;
    seen.item_id = "a survey";
    seen.is_flying = is_flying;
    all.on_survey(seen);
  }
  // A mover with each of these numbers.
  effects candidates(const std::vector<std::uint32_t>& tracks, bool with_place = true) {
    helper_candidates said{run, {}};
    said.what.captured_ns = now.monotonic_ns - 50 * ms;
    for (const auto track : tracks) {
      io::eyes::candidate each;
      each.track = track;
      each.confidence = 0.9;
      if (with_place)
        each.place = io::eyes::ground_place{47.4, 8.5, 4, 4, 0, 2};
      said.what.seen.push_back(each);
    }
    return all.on_candidates(said, now);
  }
  // Moves on to what is due, and does it.
  effects due() {
    pass(std::max<std::int64_t>(0, all.next_due_ns() - now.monotonic_ns));
    auto result = all.on_time(now);
    for (const auto& each : only<start_helper>(result))
      run = each.run;
    return result;
  }
  core all;
  instant now{100 * s, 1'000'000 * s};
  std::uint32_t run = 0;
};

TEST(movement_detector_core, who_says_nothing_for_two_seconds_is_ended_and_started_again) {
  eyes e;
  (void)e.status();
  effects said;
  const auto silent_since = e.now.monotonic_ns;
  while (only<end_helper>(said).empty())
    said = e.due();
  EXPECT_EQ(e.now.monotonic_ns - silent_since, core::silence_ns);
  EXPECT_FALSE(only<announce>(said).empty());
  while (only<start_helper>(said).empty())
    said = e.due();
  EXPECT_EQ(e.run, 2U);
}

TEST(movement_detector_core, one_that_ends_again_and_again_is_started_ever_more_seldom_and_never_given_up) {
  eyes e;
  std::int64_t wait_ns = 0;
  for (int i = 0; i < 50; ++i) {
    EXPECT_TRUE(only<end_helper>(e.all.on_ended({e.run, "it ended with code 1"}, e.now)).empty());
    const auto ended = e.now.monotonic_ns;
    while (only<start_helper>(e.due()).empty()) {
    }
    EXPECT_GE(e.now.monotonic_ns - ended, wait_ns);
    wait_ns = e.now.monotonic_ns - ended;
    EXPECT_LE(wait_ns, core::longest_wait_ns);
  }
  EXPECT_EQ(wait_ns, core::longest_wait_ns);
  for (int i = 0; i < 100; ++i, e.pass(s)) // it works for a while
    (void)e.status();
  (void)e.all.on_ended({e.run, "killed"}, e.now);
  const auto ended = e.now.monotonic_ns;
  while (only<start_helper>(e.due()).empty()) {
  }
  EXPECT_EQ(e.now.monotonic_ns - ended, core::first_wait_ns);
}

TEST(movement_detector_core, what_an_older_run_says_changes_nothing) {
  eyes e;
  (void)e.all.on_ended({e.run, "gone"}, e.now);
  while (only<start_helper>(e.due()).empty()) {
  }
  EXPECT_TRUE(e.all.on_ended({1, "gone again"}, e.now).empty());
  (void)e.all.on_status({1, {}}, e.now);
  EXPECT_NE(e.all.view_of(e.now).sentence, "");
  e.survey();
  e.run = 1;
  EXPECT_TRUE(e.candidates({1}).empty());
}

TEST(movement_detector_core, a_pose_is_that_of_the_camera_and_goes_out_only_with_a_fresh_position) {
  eyes e;
  EXPECT_TRUE(e.telemetry().empty()) << "nobody listens yet";
  (void)e.status();
  const auto said = only<io::eyes::pose>(e.telemetry());
  ASSERT_EQ(said.size(), 1U);
  EXPECT_NEAR(said[0].latitude_deg, 47.3977, 1e-9);
  EXPECT_NEAR(said[0].height_m, 40, 1e-9);
  const auto into_picture = turned({said[0].w, said[0].x, said[0].y, said[0].z}, {0, 0, 1});
  EXPECT_NEAR(into_picture[2], 1, 1e-12) << "it looks down";
  EXPECT_TRUE(io::eyes::problem_of(said[0]).empty());
  e.pass(core::telemetry_lasts_ns + 1);
  EXPECT_TRUE(e.all.on_attitude({}, e.now).empty());
  io::mavlink::global_position_int nowhere;
  nowhere.lat = 2'000'000'000;
  e.all.on_position(nowhere, e.now);
  EXPECT_TRUE(e.all.on_attitude({}, e.now).empty());
}

settings on_a_gimbal() {
  auto configured = eyes::a_camera();
  configured.is_on_gimbal = true;
  return configured;
}

std::array<double, 3> look_of(const io::eyes::pose& said) {
  return turned({said.w, said.x, said.y, said.z}, {0, 0, 1});
}

TEST(movement_detector_core, a_camera_on_a_gimbal_looks_where_that_points_and_turns_as_that_does) {
  eyes e(on_a_gimbal());
  (void)e.status();
  EXPECT_TRUE(e.telemetry().empty()) << "the attitude of the vehicle is not that of the camera";
  EXPECT_TRUE(e.gimbal(-44).empty()) << "how fast it turns is not known yet";
  e.pass(100 * ms);
  const auto said = only<io::eyes::pose>(e.gimbal(-45));
  ASSERT_EQ(said.size(), 1U);
  EXPECT_NEAR(look_of(said[0])[0], std::sqrt(0.5), 1e-6) << "to the north";
  EXPECT_NEAR(look_of(said[0])[2], std::sqrt(0.5), 1e-6) << "and down";
  EXPECT_NEAR(said[0].rate_x_rad_s, -10 * std::numbers::pi / 180, 1e-4) << "one degree down in 0.1 s";
  EXPECT_TRUE(io::eyes::problem_of(said[0]).empty());
}

TEST(movement_detector_core, a_gimbal_that_follows_the_heading_needs_one_that_is_fresh) {
  eyes e(on_a_gimbal());
  (void)e.status();
  (void)e.telemetry();
  (void)e.gimbal(-45);
  e.pass(core::heading_lasts_ns + 1);
  EXPECT_TRUE(e.gimbal(-45).empty());
  EXPECT_FALSE(only<io::eyes::pose>(e.gimbal(-45, io::mavlink::gimbal_device_flags::yaw_in_earth_frame)).empty())
      << "against north it needs none";
}

TEST(movement_detector_core, without_the_attitude_of_its_gimbal_it_does_not_see) {
  eyes e(on_a_gimbal());
  (void)e.status();
  (void)e.telemetry();
  EXPECT_FALSE(e.all.view_of(e.now).is_seeing);
  EXPECT_EQ(e.all.health(e.now).reason.substr(0, 10), "the gimbal");
  (void)e.gimbal(-45);
  EXPECT_TRUE(e.all.view_of(e.now).is_seeing);
  EXPECT_EQ(e.all.health(e.now).reason, "");
}

TEST(movement_detector_core, a_fixed_camera_heeds_no_gimbal) {
  eyes e;
  (void)e.status();
  (void)e.telemetry();
  (void)e.gimbal(-45);
  e.pass(100 * ms);
  EXPECT_TRUE(e.gimbal(-45).empty());
}

TEST(movement_detector_core, a_track_is_said_to_the_map_once_in_two_seconds_and_only_of_a_survey_that_is_flown) {
  eyes e;
  (void)e.status();
  EXPECT_TRUE(e.candidates({1}).empty()) << "no survey";
  e.survey(false);
  EXPECT_TRUE(e.candidates({1}).empty()) << "somebody else has the vehicle";
  e.survey();
  EXPECT_TRUE(e.candidates({1}, false).empty()) << "nobody knows where it is";
  std::set<std::string> ids;
  for (int i = 0; i < 40; ++i, e.pass(100 * ms))
    for (const auto& each : only<mapobjects_store::sighting>(e.candidates({1, 2}))) {
      EXPECT_TRUE(ids.insert(each.id).second);
      EXPECT_TRUE(ids::is_uuid(each.id));
      EXPECT_EQ(each.mission_id, mission);
      EXPECT_EQ(each.at_ns, e.now.wall_ns - 50 * ms) << "when it was seen";
    }
  EXPECT_EQ(ids.size(), 4U);
  EXPECT_EQ(e.all.view_of(e.now).without_place, 1U);
}

TEST(movement_detector_core, a_track_keeps_the_class_under_which_it_was_first_said) {
  eyes e;
  (void)e.status();
  e.survey();
  const auto group_of = [&e](std::uint32_t track, io::eyes::object_class what) {
    helper_candidates said{e.run, {}};
    io::eyes::candidate one;
    one.track = track;
    one.confidence = 1;
    one.place = io::eyes::ground_place{};
    one.looks_like = what;
    said.what.seen = {one};
    said.what.captured_ns = e.now.monotonic_ns;
    e.pass(core::same_track_ns);
    said.what.captured_ns = e.now.monotonic_ns;
    return only<mapobjects_store::sighting>(e.all.on_candidates(said, e.now)).at(0).class_group;
  };
  EXPECT_EQ(group_of(1, io::eyes::object_class::person), "person");
  EXPECT_EQ(group_of(1, io::eyes::object_class::unknown), "person");
  EXPECT_EQ(group_of(2, io::eyes::object_class::unknown), "moving");
  EXPECT_EQ(group_of(2, io::eyes::object_class::boat), "moving");
}

TEST(movement_detector_core, a_model_that_can_not_be_used_is_named_and_it_goes_on_seeing) {
  settings configured = eyes::a_camera();
  configured.model = "/models/net.onnx";
  core all(configured, 5, 0);
  instant now;
  const auto begun = only<start_helper>(all.on_time(now)).at(0);
  EXPECT_EQ(begun.how.model, "/models/net.onnx");
  eyes e;
  helper_status said{e.run, {}};
  said.what.source = source_state::playing;
  said.what.usable_at_ns = e.now.monotonic_ns;
  said.what.model_error = "the model is not used: it is no net";
  (void)e.all.on_status(said, e.now);
  (void)e.telemetry();
  EXPECT_TRUE(e.all.view_of(e.now).is_seeing);
  EXPECT_EQ(e.all.health(e.now).reason, said.what.model_error);
}

TEST(movement_detector_core, with_each_sighting_its_picture_is_kept_under_its_id) {
  eyes e;
  (void)e.status();
  e.survey();
  const auto all = e.candidates({3});
  const auto pictures = only<keep_picture>(all);
  ASSERT_EQ(pictures.size(), 1U);
  EXPECT_EQ(pictures[0].track, 3U);
  EXPECT_EQ(pictures[0].sighting_id, only<mapobjects_store::sighting>(all).at(0).id);
  EXPECT_EQ(pictures[0].captured_ns, e.now.monotonic_ns - 50 * ms);
}

TEST(movement_detector_core, sightings_are_bounded_whatever_the_helper_says) {
  eyes e;
  (void)e.status();
  e.survey();
  std::size_t said = 0;
  std::uint32_t track = 0;
  for (int i = 0; i < 100; ++i, e.pass(100 * ms)) {
    std::vector<std::uint32_t> all;
    for (std::size_t n = 0; n < io::eyes::max_candidates; ++n)
      all.push_back(++track);
    said += only<mapobjects_store::sighting>(e.candidates(all)).size();
  }
  EXPECT_LE(said, 10 * core::max_sightings_a_second + core::max_sightings_a_second);
}

TEST(movement_detector_core, candidates_of_the_future_or_long_ago_are_left_out) {
  eyes e;
  (void)e.status();
  e.survey();
  helper_candidates said{e.run, {}};
  io::eyes::candidate one;
  one.confidence = 1;
  one.place = io::eyes::ground_place{};
  said.what.seen = {one};
  said.what.captured_ns = e.now.monotonic_ns + 1;
  EXPECT_TRUE(e.all.on_candidates(said, e.now).empty());
  said.what.captured_ns = e.now.monotonic_ns - 3 * s;
  EXPECT_TRUE(e.all.on_candidates(said, e.now).empty());
}

TEST(movement_detector_core, it_sees_only_with_fresh_pictures_that_say_something_and_with_telemetry) {
  eyes e;
  (void)e.telemetry();
  (void)e.status();
  EXPECT_TRUE(e.all.view_of(e.now).is_seeing);
  const auto seeing = [&] {
    for (;;)
      if (const auto said = only<scan_controller::view>(e.due()); !said.empty())
        return said[0].is_seeing;
  };
  EXPECT_TRUE(seeing());
  (void)e.all.on_ended({e.run, "killed"}, e.now);
  EXPECT_FALSE(seeing());
  while (e.run == 1)
    (void)e.due();
  (void)e.status();
  EXPECT_FALSE(e.all.view_of(e.now).is_seeing && e.now.monotonic_ns > 102 * s) << "the telemetry is old";
  (void)e.telemetry();
  EXPECT_TRUE(e.all.view_of(e.now).is_seeing);
  helper_status blind{e.run, {}};
  blind.what.source = source_state::playing;
  blind.what.usable_at_ns = e.now.monotonic_ns - core::view_lasts_ns - 1;
  (void)e.all.on_status(blind, e.now);
  EXPECT_FALSE(e.all.view_of(e.now).is_seeing);
}

TEST(movement_detector_core, health_names_what_is_wrong_with_the_remedy) {
  using runtime::health_colour;
  eyes e;
  EXPECT_EQ(e.all.health(e.now).how, health_colour::green) << "it starts";
  (void)e.telemetry();
  (void)e.status(source_state::failed, "there is no /dev/video0: connect the camera");
  EXPECT_EQ(e.all.health(e.now).how, health_colour::yellow);
  EXPECT_EQ(e.all.health(e.now).reason, "there is no /dev/video0: connect the camera");
  (void)e.status();
  EXPECT_EQ(e.all.health(e.now).how, health_colour::green);
  helper_status black{e.run, {}};
  black.what.source = source_state::playing;
  black.what.fault = io::eyes::picture_fault::black;
  (void)e.all.on_status(black, e.now);
  EXPECT_NE(e.all.health(e.now).reason.find("lens"), std::string::npos);
  black.what.fault = io::eyes::picture_fault::repeated;
  (void)e.all.on_status(black, e.now);
  EXPECT_NE(e.all.health(e.now).reason.find("switch it off and on"), std::string::npos);
  (void)e.all.on_ended({e.run, "it was ended by signal 9"}, e.now);
  EXPECT_NE(e.all.health(e.now).reason.find("signal 9"), std::string::npos);
}

TEST(movement_detector_core, pictures_that_say_nothing_are_told_after_five_seconds) {
  eyes e;
  (void)e.telemetry();
  (void)e.status();
  helper_status blurred{e.run, {}};
  blurred.what.source = source_state::playing;
  blurred.what.unusable = "the picture is blurred";
  (void)e.all.on_status(blurred, e.now);
  EXPECT_EQ(e.all.health(e.now).reason, "");
  for (int i = 0; i < 6; ++i) {
    e.pass(s);
    (void)e.telemetry();
    (void)e.all.on_status(blurred, e.now);
  }
  EXPECT_EQ(e.all.health(e.now).reason, "the pictures are of no use: the picture is blurred");
}

} // namespace core_test
