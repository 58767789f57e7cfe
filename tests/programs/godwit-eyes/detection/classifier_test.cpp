#include "programs/godwit-eyes/detection/classifier.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/eyes/small_net.hpp"

namespace classifier_test {

using namespace godwit;
using namespace godwit::eyes;

constexpr pixel_box place{280, 150, 40, 60};

// A picture with one thing in it.
struct picture {
  static constexpr int width = 640;
  static constexpr int height = 360;
  picture(std::uint8_t grey, std::uint8_t blue, std::uint8_t red, const pixel_box& at = place) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        if (x >= at.x_px && x < at.x_px + at.width_px && y >= at.y_px && y < at.y_px + at.height_px) {
          brightness[static_cast<std::size_t>(y * width + x)] = grey;
          const auto half = static_cast<std::size_t>(y / 2 * (width / 2) + x / 2);
          blues[half] = blue;
          reds[half] = red;
        }
  }
  [[nodiscard]] frame_view view(bool has_colours = true) const {
    frame_view result{brightness.data(), width, height, width, 1};
    if (has_colours) {
      result.blue = blues.data();
      result.red = reds.data();
      result.colour_stride = width / 2;
    }
    return result;
  }
  std::vector<std::uint8_t> brightness = std::vector<std::uint8_t>(std::size_t{width} * height, 60);
  std::vector<std::uint8_t> blues = std::vector<std::uint8_t>(std::size_t{width} * height / 4, 128);
  std::vector<std::uint8_t> reds = blues;
};

std::string problem_of_net(const io::eyes::model_files& from) {
  const auto made = classifier::make(from);
  return made ? "" : made.error();
}

TEST(classifier, what_the_net_finds_at_the_place_is_the_class) {
  const auto net = classifier::make(test::small_net());
  ASSERT_TRUE(net) << net.error();
  const auto said = (*net)->ask(picture(220, 100, 160).view(), place);
  EXPECT_EQ(said.what, object_class::person);
  EXPECT_GT(said.score, 0.9);
  EXPECT_NEAR(said.box.x_px + said.box.width_px / 2, 300, 24);
  EXPECT_NEAR(said.box.y_px + said.box.height_px / 2, 180, 24);
  EXPECT_NEAR(said.box.height_px, 48, 1) << "half of what the net was given, which is 1.6 times the length";
  EXPECT_EQ((*net)->ask(picture(90, 128, 128).view(), place).what, object_class::unknown) << "it is not bright";
}

TEST(classifier, onnx_has_its_boxes_in_pixels_and_how_sure_it_is_apart_from_the_class) {
  const auto net = classifier::make(test::small_onnx());
  ASSERT_TRUE(net) << net.error();
  const auto said = (*net)->ask(picture(220, 128, 128).view(), place);
  EXPECT_EQ(said.what, object_class::person);
  EXPECT_NEAR(said.score, 220.0 / 255, 0.02);
  EXPECT_NEAR(said.box.x_px, 300 - 24, 1);
  EXPECT_NEAR(said.box.width_px, 48, 1);
  EXPECT_EQ((*net)->ask(picture(80, 128, 128).view(), place).what, object_class::unknown);
}

TEST(classifier, colours_count_where_the_picture_has_some) {
  const auto net = classifier::make(test::small_net()).value();
  const picture blue(200, 200, 90);
  EXPECT_EQ(net->ask(blue.view(), place).what, object_class::vehicle);
  EXPECT_EQ(net->ask(blue.view(false), place).what, object_class::person);
}

TEST(classifier, what_lies_elsewhere_or_beyond_the_border_is_not_the_thing) {
  const auto net = classifier::make(test::small_net()).value();
  const picture one(220, 128, 128);
  EXPECT_EQ(net->ask(one.view(), {100, 150, 40, 60}).what, object_class::unknown);
  EXPECT_EQ(net->ask(one.view(), {-30, -50, 40, 60}).what, object_class::unknown);
  EXPECT_EQ(net->ask(one.view(), {620, 340, 400, 600}).what, object_class::unknown);
}

TEST(classifier, what_is_no_net_or_one_of_another_shape_is_refused_with_the_reason) {
  const auto good = test::small_net();
  EXPECT_EQ(problem_of_net(good), "");
  EXPECT_NE(problem_of_net(test::small_net(20)).find("rows of 85 numbers"), std::string::npos);
  EXPECT_NE(problem_of_net({"", "this is no ONNX"}).find("OpenCV does not read it"), std::string::npos);
  EXPECT_NE(problem_of_net({"[net]\nwidth=", good.weights}).find("OpenCV does not read it"), std::string::npos);
  EXPECT_NE(problem_of_net({"[net]\nwidth=160\nheight=160\nchannels=3\n", good.weights}), "");
  EXPECT_NE(problem_of_net({good.layers, good.weights.substr(0, 400)}).find("have 400 bytes, and its .cfg needs 1376"),
            std::string::npos)
      << problem_of_net({good.layers, good.weights.substr(0, 400)});
}

TEST(classifier, a_net_cut_off_or_changed_anywhere_is_refused_or_answers) {
  const auto good = test::small_net();
  for (std::size_t n = 0; n < good.layers.size(); n += 3) {
    (void)classifier::make({good.layers.substr(0, n), good.weights});
    auto changed = good;
    changed.layers[n] = static_cast<char>('0' + n % 10);
    if (changed.layers.find("=160") == std::string::npos)
      continue; // a size of thousands
    if (const auto net = classifier::make(changed))
      (void)(*net)->ask(picture(220, 128, 128).view(), place);
  }
}

TEST(classifier, numbers_that_can_not_be_are_no_answer) {
  constexpr std::size_t first_bias = 20;
  for (const float wrong : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e30F})
    for (std::size_t n = 0; n < 5; ++n) {
      auto net = test::small_net();
      std::memcpy(net.weights.data() + first_bias + n * sizeof(float), &wrong, sizeof(float));
      const auto said = classifier::make(net).value()->ask(picture(220, 128, 128).view(), place);
      EXPECT_TRUE(std::isfinite(said.score + said.box.x_px + said.box.y_px + said.box.width_px + said.box.height_px));
      EXPECT_LE(said.score, 1);
    }
}

TEST(classifier, one_that_is_too_slow_is_refused) {
  auto slow = test::small_net();
  slow.layers.insert(slow.layers.find("[maxpool]"),
                     "[convolutional]\nsize=11\nstride=1\npad=1\nactivation=linear\nfilters=200\n"
                     "[convolutional]\nsize=11\nstride=1\npad=1\nactivation=linear\nfilters=3\n");
  constexpr std::size_t more = 200 + 200 * 3 * 121 + 3 + 3 * 200 * 121;
  slow.weights.append(more * sizeof(float), '\0');
  EXPECT_NE(problem_of_net(slow).find("use a smaller net"), std::string::npos) << problem_of_net(slow);
}

} // namespace classifier_test
