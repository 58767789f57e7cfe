#include "io/video/jpeg_encoder.hpp"

#include <gtest/gtest.h>

#include "tests/io/video/painted_frame.hpp"

namespace jpeg_encoder_test {

using namespace godwit::io::video;

TEST(jpeg_encoder, a_frame_becomes_a_jpeg_also_of_odd_sizes_and_again) {
  jpeg_encoder encoder(60);
  for (const auto& [width, height] : {std::pair{640, 360}, std::pair{63, 47}, std::pair{1280, 720}}) {
    const auto made = encoder.encode(painted_frame(width, height, 90, 1));
    ASSERT_TRUE(made) << made.error();
    ASSERT_GT(made->size(), 100U);
    EXPECT_EQ((*made)[0], std::byte{0xFF});
    EXPECT_EQ((*made)[1], std::byte{0xD8});
    EXPECT_EQ((*made)[made->size() - 1], std::byte{0xD9});
  }
}

} // namespace jpeg_encoder_test
