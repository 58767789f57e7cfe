#include "programs/godwit-eyes/detection/shadow_ratio.hpp"

#include <gtest/gtest.h>

#include "programs/godwit-sim/camera/random.hpp"

namespace godwit::eyes {
namespace shadow_ratio_test {

// Pictures with dark things of any brightness, and a part of them in shadows of this ratio.
shadow_ratio seen(double shadows, float ratio, int pictures = 20) {
  sim::camera::random_source random(3);
  shadow_ratio of;
  for (int n = 0; n < pictures; ++n) {
    for (int pixel = 0; pixel < 500; ++pixel) {
      const bool is_shadow = random.uniform() < shadows;
      of.add(static_cast<float>(is_shadow ? ratio + 0.01 * random.gaussian() : random.between(0.2, 1.0)));
    }
    of.end_picture();
  }
  return of;
}

TEST(shadow_ratio, what_many_dark_pixels_have_in_common_is_the_shadow) {
  for (const float ratio : {0.45F, 0.6F, 0.75F}) {
    const auto found = seen(0.5, ratio).get();
    ASSERT_TRUE(found);
    EXPECT_NEAR(*found, ratio, 0.02);
  }
}

TEST(shadow_ratio, where_dark_things_are_of_any_brightness_there_is_none) { EXPECT_FALSE(seen(0, 0.6F).get()); }

TEST(shadow_ratio, a_few_pixels_are_not_enough) {
  shadow_ratio of;
  for (int n = 0; n < 50; ++n)
    of.add(0.6F);
  of.end_picture();
  EXPECT_FALSE(of.get());
}

TEST(shadow_ratio, when_the_shadows_are_gone_it_is_forgotten) {
  auto of = seen(0.5, 0.6F);
  for (int n = 0; n < 300; ++n)
    of.end_picture();
  EXPECT_FALSE(of.get());
}

} // namespace shadow_ratio_test
} // namespace godwit::eyes
