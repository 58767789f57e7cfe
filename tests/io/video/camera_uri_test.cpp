#include "io/video/camera_uri.hpp"

#include <gtest/gtest.h>

namespace camera_uri_test {

using namespace godwit::io::video;

TEST(camera_uri, each_kind_is_read) {
  const auto device = parse_camera_uri("v4l2:///dev/video0?width=1280&height=720&fps=30").value();
  EXPECT_EQ(device.kind, camera_kind::device);
  EXPECT_EQ(device.where, "/dev/video0");
  EXPECT_EQ(device.width_px, 1280);
  EXPECT_EQ(device.height_px, 720);
  EXPECT_EQ(device.frames_per_s, 30);
  EXPECT_EQ(parse_camera_uri("v4l2:///dev/video2").value().width_px, 0);
  const auto network = parse_camera_uri("rtsp://me:secret@10.0.0.2:8554/a?b=c").value();
  EXPECT_EQ(network.kind, camera_kind::network);
  EXPECT_EQ(network.where, "rtsp://me:secret@10.0.0.2:8554/a?b=c");
  EXPECT_EQ(parse_camera_uri("file:///tmp/a.mkv").value().kind, camera_kind::file);
  const auto test = parse_camera_uri("test://ball?hang_after=5").value();
  EXPECT_EQ(test.where, "ball");
  EXPECT_EQ(test.hang_after, 5);
  EXPECT_EQ(test.width_px, 640);
}

TEST(camera_uri, what_means_nothing_is_refused_with_what_is_allowed) {
  for (const auto* each :
       {"", "video0", "/dev/video0", "v4l2://", "v4l2://video0", "http://a/b", "file://a.mkv", "rtsp://", "test://",
        "test://unknown", "test://ball?width=10&height=10", "v4l2:///dev/video0?width=640", "test://ball?speed=3",
        "test://ball?fps=x", "test://ball?fps=", "v4l2:///dev/video0?hang_after=3", "rtsp://a b", "rtsp://a\n"})
    EXPECT_FALSE(parse_camera_uri(each)) << each;
  EXPECT_FALSE(parse_camera_uri("rtsp://" + std::string(600, 'a')));
}

TEST(camera_uri, a_password_is_not_shown) {
  EXPECT_EQ(without_password("rtsp://me:secret@host/a"), "rtsp://me:***@host/a");
  EXPECT_EQ(without_password("rtsp://host:8554/a@b"), "rtsp://host:8554/a@b");
  EXPECT_EQ(without_password("test://ball"), "test://ball");
}

TEST(camera_uri, a_file_of_any_name_has_an_address) {
  EXPECT_EQ(recording_at("/films/a.mkv").where, "file:///films/a.mkv");
  const auto odd = recording_at("/films/50% of \xC3\xA4?.mkv");
  EXPECT_EQ(odd.kind, camera_kind::file);
  EXPECT_EQ(odd.where, "file:///films/50%25%20of%20%C3%A4%3F.mkv");
}

} // namespace camera_uri_test
