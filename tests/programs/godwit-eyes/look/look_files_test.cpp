#include "programs/godwit-eyes/look/look_files.hpp"

#include <string_view>

#include <gtest/gtest.h>
#include <zlib.h>

namespace png_test {

using namespace godwit::eyes;

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t result = 0;
  for (std::size_t n = at; n < at + 4; ++n)
    result = result << 8U | static_cast<unsigned char>(bytes.at(n));
  return result;
}

TEST(png, a_reader_of_the_format_finds_each_pixel_and_each_checksum) {
  cv::Mat picture(5, 7, CV_8UC3);
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x)
      picture.at<cv::Vec3b>(y, x) = {static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y), 200};
  const auto bytes = png_of(picture);
  ASSERT_EQ(bytes.substr(0, 8), std::string_view("\x89PNG\r\n\x1A\n", 8));
  std::string found;
  for (std::size_t at = 8; at < bytes.size();) {
    const auto length = number_at(bytes, at);
    const auto type = bytes.substr(at + 4, 4);
    const auto* const covered = reinterpret_cast<const Bytef*>(bytes.data() + at + 4);
    EXPECT_EQ(number_at(bytes, at + 8 + length), ::crc32(0, covered, length + 4)) << type;
    found += type + ' ';
    if (type == "IHDR") {
      EXPECT_EQ(number_at(bytes, at + 8), 7U);
      EXPECT_EQ(number_at(bytes, at + 12), 5U);
      EXPECT_EQ(bytes.substr(at + 16, 5), std::string_view("\x08\x02\x00\x00\x00", 5));
    }
    if (type == "IDAT") {
      std::string rows(5 * (1 + 7 * 3), '?');
      uLongf size = rows.size();
      ASSERT_EQ(::uncompress(reinterpret_cast<Bytef*>(rows.data()), &size, covered + 4, length), Z_OK);
      ASSERT_EQ(size, rows.size());
      for (std::size_t y = 0; y < 5; ++y) {
        EXPECT_EQ(rows.at(y * 22), 0) << "filter";
        for (std::size_t x = 0; x < 7; ++x)
          EXPECT_EQ(rows.substr(y * 22 + 1 + x * 3, 3),
                    (std::string{static_cast<char>(x), static_cast<char>(y), static_cast<char>(200)}));
      }
    }
    at += 12 + length;
  }
  EXPECT_EQ(found, "IHDR IDAT IEND ");
}

TEST(png, a_file_that_can_not_be_written_is_named) {
  const auto written = write_png("/nowhere/at/all.png", cv::Mat::zeros(4, 4, CV_8UC3));
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().find("/nowhere/at/all.png"), std::string::npos);
}

} // namespace png_test
