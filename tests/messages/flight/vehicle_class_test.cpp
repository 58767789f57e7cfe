#include <gtest/gtest.h>

#include "messages/flight/vehicle_class.hpp"

namespace vehicle_class_test {

using namespace godwit::flight;
using godwit::io::mavlink::mav_type;

TEST(vehicle_class, whatever_hovers_is_a_multirotor_and_whatever_has_wings_an_aeroplane) {
  for (const auto type : {mav_type::quadrotor, mav_type::coaxial, mav_type::helicopter, mav_type::hexarotor,
                          mav_type::octorotor, mav_type::tricopter})
    EXPECT_EQ(class_of(type), vehicle_class::multirotor);
  for (const auto type : {mav_type::fixed_wing, mav_type::vtol_tailsitter_duorotor, mav_type::vtol_fixedrotor})
    EXPECT_EQ(class_of(type), vehicle_class::fixed_wing);
}

TEST(vehicle_class, boats_are_rovers_and_the_rest_is_unknown) {
  EXPECT_EQ(class_of(mav_type::ground_rover), vehicle_class::rover);
  EXPECT_EQ(class_of(mav_type::surface_boat), vehicle_class::rover);
  for (const auto type : {mav_type::generic, mav_type::gcs, mav_type::submarine, mav_type::antenna_tracker})
    EXPECT_EQ(class_of(type), vehicle_class::unknown);
  EXPECT_EQ(class_of(static_cast<mav_type>(250)), vehicle_class::unknown);
}

} // namespace vehicle_class_test
