#include "programs/godwit-sim/camera_server/camera_place.hpp"

#include <gtest/gtest.h>

namespace camera_place_test {

using namespace godwit::sim;

TEST(camera_place, a_place_is_read_with_what_is_to_be_seen) {
  const auto place =
      parse_camera_place("rtsp://127.0.0.1:8554/camera?width=1280&height=720&movers=0&north=-20").value();
  EXPECT_EQ(place.host, "127.0.0.1");
  EXPECT_EQ(place.port, 8554);
  EXPECT_EQ(place.path, "/camera");
  EXPECT_EQ(place.width, 1280);
  EXPECT_EQ(place.movers, 0);
  EXPECT_EQ(place.north_m, -20);
  EXPECT_EQ(place.focal_px, 1109) << "60 degrees";
}

TEST(camera_place, what_is_no_place_is_refused_with_what_would_be_one) {
  for (const auto* each :
       {"", "test://ball", "rtsp://", "rtsp://127.0.0.1/camera", "rtsp://127.0.0.1:8554", "rtsp://127.0.0.1:8554/",
        "rtsp://:8554/camera", "rtsp://127.0.0.1:99999/camera", "rtsp://127.0.0.1:8554/camera?fps=0",
        "rtsp://127.0.0.1:8554/camera?colour=red", "rtsp://127.0.0.1:8554/camera?fps"}) {
    const auto read = parse_camera_place(each);
    ASSERT_FALSE(read) << each;
    EXPECT_NE(read.error().find("rtsp://127.0.0.1:8554/camera"), std::string::npos) << read.error();
  }
}

} // namespace camera_place_test
