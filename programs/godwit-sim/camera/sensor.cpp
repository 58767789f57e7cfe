#include "programs/godwit-sim/camera/sensor.hpp"

#include <array>
#include <numbers>

#include "programs/godwit-sim/camera/random.hpp"

namespace godwit::sim::camera {

namespace {

constexpr double settling_s = 0.4; // time constant of the automatic exposure
constexpr std::size_t noise_bits = 16;
constexpr std::size_t noise_count = 1U << noise_bits;

// Standard deviation 32 in each; the same in each process.
const std::vector<std::int8_t>& noise_table() {
  static const std::vector<std::int8_t> table = [] {
    std::vector<std::int8_t> made(noise_count);
    random_source random(0x6e6f697365);
    for (auto& each : made)
      each = static_cast<std::int8_t>(std::clamp(std::lround(random.gaussian() * 32), -127L, 127L));
    return made;
  }();
  return table;
}

double exposure_at(const sensor_settings& settings, double time_s) {
  double logarithm = 0;
  for (const auto& each : settings.steps)
    if (time_s >= each.at_s)
      logarithm += std::log(each.factor) * std::exp(-(time_s - each.at_s) / settling_s);
  return settings.brightness * std::exp(logarithm);
}

void blur_lines(std::uint8_t* first, int count, std::ptrdiff_t step, int radius, std::vector<std::uint8_t>& line) {
  line.resize(static_cast<std::size_t>(count));
  for (int n = 0; n < count; ++n)
    line[static_cast<std::size_t>(n)] = first[n * step];
  const auto at = [&](int n) { return static_cast<int>(line[static_cast<std::size_t>(std::clamp(n, 0, count - 1))]); };
  int sum = 0;
  for (int n = -radius; n <= radius; ++n)
    sum += at(n);
  const int width = 2 * radius + 1;
  for (int n = 0; n < count; ++n) {
    first[n * step] = static_cast<std::uint8_t>(sum / width);
    sum += at(n + radius + 1) - at(n - radius);
  }
}

void defocus(canvas& picture, int radius) {
  std::vector<std::uint8_t> line;
  for (int pass = 0; pass < 2; ++pass) {
    for (int y = 0; y < picture.height; ++y)
      blur_lines(&picture.pixels[picture.index(0, y)], picture.width, 1, radius, line);
    for (int x = 0; x < picture.width; ++x)
      blur_lines(&picture.pixels[picture.index(x, 0)], picture.height, picture.width, radius, line);
  }
}

// JPEG, Annex K.1: luminance.
constexpr std::array<int, 64> annex_k{16, 11, 10, 16, 24,  40,  51,  61,  12, 12, 14, 19, 26,  58,  60,  55,
                                      14, 13, 16, 24, 40,  57,  69,  56,  14, 17, 22, 29, 51,  87,  80,  62,
                                      18, 22, 37, 56, 68,  109, 103, 77,  24, 35, 55, 64, 81,  104, 113, 92,
                                      49, 64, 78, 87, 103, 121, 120, 101, 72, 92, 95, 98, 112, 100, 103, 99};

using matrix8 = std::array<float, 64>;

matrix8 cosines() {
  matrix8 made;
  for (std::size_t k = 0; k < 8; ++k)
    for (std::size_t n = 0; n < 8; ++n)
      made[k * 8 + n] = static_cast<float>(
          (k == 0 ? std::sqrt(0.125) : 0.5) *
          std::cos((2.0 * static_cast<double>(n) + 1) * static_cast<double>(k) * std::numbers::pi / 16));
  return made;
}

// A * B; TO is neither of them.
void multiply(const matrix8& a, const matrix8& b, matrix8& to) {
  for (std::size_t row = 0; row < 8; ++row) {
    float line[8] = {};
    for (std::size_t k = 0; k < 8; ++k)
      for (std::size_t column = 0; column < 8; ++column)
        line[column] += a[row * 8 + k] * b[k * 8 + column];
    std::copy_n(line, 8, &to[row * 8]);
  }
}

matrix8 transposed(const matrix8& a) {
  matrix8 made;
  for (std::size_t row = 0; row < 8; ++row)
    for (std::size_t column = 0; column < 8; ++column)
      made[row * 8 + column] = a[column * 8 + row];
  return made;
}

} // namespace

void expose(canvas& picture, const sensor_settings& settings, std::uint64_t seed, double time_s) {
  if (settings.defocus_px > 0)
    defocus(picture, settings.defocus_px);
  const int gain = static_cast<int>(std::lround(exposure_at(settings, time_s) * 256));
  const int noise = static_cast<int>(std::lround(settings.noise / 32 * 1024));
  const auto& table = noise_table();
  random_source random(seed_for(seed, static_cast<std::uint64_t>(std::llround(time_s * 1e6))));
  for (int y = 0; y < picture.height; ++y) {
    std::uint8_t* const row = &picture.pixels[picture.index(0, y)];
    auto at = static_cast<std::size_t>(random.next());
    for (int x = 0; x < picture.width;) {
      const int run = std::min(picture.width - x, 256); // of the table, before another place in it
      const std::int8_t* const values = &table[at % (noise_count - 256)];
      for (int n = 0; n < run; ++n)
        row[x + n] =
            static_cast<std::uint8_t>(std::clamp((row[x + n] * gain + 128 + ((values[n] * noise) >> 2)) >> 8, 0, 255));
      x += run;
      at = scrambled(at);
    }
  }
}

void compress(canvas& picture, int quality) {
  const int scale = quality < 50 ? 5000 / std::max(quality, 1) : 200 - 2 * quality;
  matrix8 steps;
  for (std::size_t n = 0; n < 64; ++n)
    steps[n] = static_cast<float>(std::clamp((annex_k[n] * scale + 50) / 100, 1, 255));
  static const matrix8 forward = cosines();
  static const matrix8 back = transposed(forward);
  matrix8 block;
  matrix8 half; // transformed in one direction
  for (int top = 0; top + 8 <= picture.height; top += 8)
    for (int left = 0; left + 8 <= picture.width; left += 8) {
      for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
          block[static_cast<std::size_t>(y * 8 + x)] =
              static_cast<float>(picture.pixels[picture.index(left + x, top + y)]) - 128;
      multiply(forward, block, half);
      multiply(half, back, block);
      for (std::size_t n = 0; n < 64; ++n) {
        const float value = block[n] / steps[n];
        block[n] = static_cast<float>(static_cast<int>(value + (value < 0 ? -0.5F : 0.5F))) * steps[n];
      }
      multiply(block, forward, half);
      multiply(back, half, block);
      for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
          picture.pixels[picture.index(left + x, top + y)] =
              static_cast<std::uint8_t>(std::clamp(block[static_cast<std::size_t>(y * 8 + x)] + 128.5F, 0.0F, 255.0F));
    }
}

} // namespace godwit::sim::camera
