#include "io/video/picture_watch.hpp"

#include <algorithm>
#include <numeric>

namespace godwit::io::video {

picture_fault picture_watch::look(const frame& picture) {
  sample now{};
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column) {
      const auto y = row * static_cast<std::size_t>(picture.height) / rows;
      const auto x = column * static_cast<std::size_t>(picture.width) / columns;
      now.at(row * columns + column) = picture.planes[0].pixels[y * picture.planes[0].stride + x];
    }
  const auto mean = std::accumulate(now.begin(), now.end(), std::uint32_t{0}) / static_cast<std::uint32_t>(now.size());
  const auto at = picture.captured_ns;
  if (!has_last_ || mean >= black_below || std::ranges::max(now) >= light_from)
    sound_ns_ = at;
  if (!has_last_ || now != last_)
    changed_ns_ = at;
  has_last_ = true;
  last_ = now;
  if (at - sound_ns_ >= patience_ns)
    return picture_fault::black;
  return at - changed_ns_ >= patience_ns ? picture_fault::repeated : picture_fault::none;
}

} // namespace godwit::io::video
