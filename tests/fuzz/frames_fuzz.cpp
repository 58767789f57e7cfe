// Pictures and poses as they come against the detector: each is looked at or refused with a reason, nothing is read
// outside of the picture, and what is said is sound.
//
// An input is a row of pictures of 16 bytes each: size, stride, time, what is in it, and a pose. Pixels are made from
// them: a ground of noise that goes on from picture to picture, so that its motion can be found, with a thing that
// moves over it. They are small, so that some hundred inputs a second are tried.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <span>
#include <vector>

#include "programs/godwit-eyes/detection/detector.hpp"

namespace {

using namespace godwit::eyes;

constexpr std::size_t picture_bytes = 16;
constexpr std::size_t max_pictures = 16;

using recipe = std::span<const std::uint8_t, picture_bytes>;

std::uint32_t scrambled(std::uint32_t x) {
  x ^= x >> 16U;
  x *= 0x7feb352dU;
  x ^= x >> 15U;
  x *= 0x846ca68bU;
  return x ^ x >> 16U;
}

// Sizes around the smallest that is taken, and a few that can not be.
int side_of(std::uint8_t byte) {
  constexpr std::array odd_sides{-1000, 0, 1, 1001, 9000};
  return byte < odd_sides.size() ? odd_sides.at(byte) : 60 + byte % 128;
}

std::size_t stride_of(std::uint8_t byte, int width) {
  if (byte < 8)
    return byte * 13U;
  return static_cast<std::size_t>(std::max(0, width)) + (byte < 128 ? 0U : byte % 17U);
}

std::int64_t step_of(std::uint8_t byte) {
  constexpr std::array steps{33'333'333LL, 33'333'333LL, 1LL, 0LL, -5LL, 400'000'000LL, 700'000'000LL};
  return steps.at(byte % steps.size());
}

std::uint8_t pixel_at(recipe how, int x, int y) {
  const int shift_x = how[4] % 16;
  const int shift_y = how[5] % 16;
  const int thing = how[6];
  if (thing != 0 && std::abs(x - thing) < 5 && std::abs(y - 40) < 4)
    return 250;
  if (how[7] < 16)
    return how[7]; // of one brightness
  const auto block = static_cast<std::uint32_t>((x + shift_x) / 4 * 1024 + (y + shift_y) / 4);
  return static_cast<std::uint8_t>(60 + scrambled(block) % 120);
}

double odd(std::uint8_t byte, double usual) {
  constexpr std::array values{
      0.0,    -1.0, 1e300, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
      1e-300, 100.0};
  return byte < values.size() ? values.at(byte) : usual;
}

std::optional<camera_pose> pose_of(recipe how, std::int64_t at_ns) {
  if (how[8] % 2 == 0)
    return std::nullopt;
  camera_pose result;
  result.at_ns = at_ns - how[9] * 5'000'000LL;
  const double tilt = how[10] * 0.0123; // half of the angle
  result.attitude = {odd(how[11], std::cos(tilt)), std::sin(tilt), 0, 0};
  result.rate.z_rad_s = odd(how[12], how[12] * 0.01);
  result.latitude_deg = odd(how[13], 47);
  result.longitude_deg = odd(how[14], 8 + how[4] * 1e-6);
  result.height_m = odd(how[15], how[15]);
  return result;
}

void must(bool holds) {
  if (!holds)
    std::abort();
}

void check(const verdict& said) {
  must(said.why == unusable::none || said.confirmed.empty());
  must(!name_of(said.why).empty());
  must(std::isfinite(said.figures.residual_px) && std::isfinite(said.figures.corner_shift_px));
  for (const auto& each : said.confirmed) {
    must(std::isfinite(each.box.x_px) && std::isfinite(each.box.y_px));
    must(each.box.width_px > 0 && each.box.height_px > 0);
    must(each.confidence >= 0 && each.confidence <= 1 && std::isfinite(each.speed_px_s));
    if (each.place)
      must(std::abs(each.place->latitude_deg) <= 90 && std::abs(each.place->longitude_deg) <= 180 &&
           each.place->variance_north_m2 >= 0 && each.place->variance_east_m2 >= 0);
  }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const bool is_one_thread = [] {
    use_one_thread();
    return true;
  }();
  must(is_one_thread);
  detector_settings settings;
  settings.camera = camera_from_field_of_view(1280, 720, 60);
  detector eyes(settings);
  std::int64_t at_ns = 1'000'000'000;
  const std::size_t count = std::min(size / picture_bytes, max_pictures);
  for (std::size_t n = 0; n < count; ++n) {
    const recipe how(data + n * picture_bytes, picture_bytes);
    const int width = side_of(how[0]);
    const int height = side_of(how[1]);
    const auto stride = stride_of(how[2], width);
    at_ns += step_of(how[3]);
    const bool is_right =
        width >= 64 && height >= 64 && width <= 8192 && height <= 8192 && stride >= static_cast<std::size_t>(width);
    // Not a byte more than there has to be: the sanitizer sees who reads after it.
    std::vector<std::uint8_t> pixels(
        is_right ? stride * static_cast<std::size_t>(height - 1) + static_cast<std::size_t>(width) : 0);
    for (int y = 0; is_right && y < height; ++y)
      for (int x = 0; x < width; ++x)
        pixels[static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x)] = pixel_at(how, x, y);
    const auto said = eyes.look({pixels.data(), width, height, stride, at_ns}, pose_of(how, at_ns));
    check(said);
    must((said.why == unusable::bad_frame) == !is_right);
  }
  return 0;
}
