#include "actors/executor/announced_modes.hpp"

#include <gtest/gtest.h>

#include "actors/domain/control_authority/mode_tables.hpp"
#include "io/mavlink/enums.hpp"

namespace godwit::executor {
namespace announced_modes_test {

using flight::mode_kind;
using io::mavlink::mav_autopilot;

const flight::mode_owner px4{mav_autopilot::px4, flight::vehicle_class::multirotor};

std::vector<std::uint32_t> mission_modes() { return flight::modes_obeying(px4, mode_kind::mission); }

TEST(announced_modes, of_a_resume_are_those_of_the_mission) {
  EXPECT_EQ(announced_modes(task_kind::resume, {guard{}, change_mode{mode_kind::mission}}, 0, px4), mission_modes());
  EXPECT_EQ(announced_modes(task_kind::resume, {guard{}, set_current_item{3}, change_mode{mode_kind::mission}}, 0, px4),
            mission_modes());
  EXPECT_EQ(announced_modes(task_kind::resume, {guard{}, start_plan{1}}, 0, px4), flight::modes_of_start(px4));
}

TEST(announced_modes, of_a_replan_are_those_after_its_guard) {
  const steps way{change_mode{mode_kind::hold}, upload_plan{}, guard{}, change_mode{mode_kind::mission}};
  EXPECT_EQ(announced_modes(task_kind::deploy, way, 2, px4), mission_modes());
  EXPECT_TRUE(announced_modes(task_kind::deploy, {upload_plan{}, guard{}}, 1, px4).empty()) << "it stays held";
}

TEST(announced_modes, of_a_start_there_are_none) {
  EXPECT_TRUE(announced_modes(task_kind::start, {guard{}, arm{}, start_plan{1}}, 0, px4).empty());
}

TEST(announced_modes, of_what_holds_first_are_those_of_the_hold) {
  const steps way{guard{}, change_mode{mode_kind::hold}, guard{}, change_mode{mode_kind::mission}};
  EXPECT_EQ(announced_modes(task_kind::deploy, way, 0, px4), flight::modes_obeying(px4, mode_kind::hold));
  EXPECT_EQ(announced_modes(task_kind::deploy, way, 2, px4), mission_modes());
}

} // namespace announced_modes_test
} // namespace godwit::executor
