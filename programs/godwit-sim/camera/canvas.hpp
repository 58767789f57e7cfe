// The picture while it is painted, and who owns each pixel: 0 for what stands still, else the number of a mover.
// Thread: one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "programs/godwit-sim/camera/view.hpp"

namespace godwit::sim::camera {

struct canvas {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;
  std::vector<std::uint8_t> owner;

  canvas(int w, int h)
      : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)), owner(pixels.size()) {}

  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

struct pixel_range {
  int left = 0;
  int top = 0;
  int right = -1; // inclusive
  int bottom = -1;
};

// The pixels of the canvas that the polygon may touch.
[[nodiscard]] pixel_range range_of(const canvas& on, std::span<const point2> polygon);

// Convex, in either direction; edges are smooth. PAINT(x, y, pixel, coverage 0..1) changes the pixel.
template <class Paint>
void fill_convex(canvas& on, std::span<const point2> polygon, const Paint& paint) {
  struct edge {
    double a, b, c; // distance inwards = a x + b y + c
  };
  constexpr std::size_t most_corners = 16;
  edge edges[most_corners];
  std::size_t count = 0;
  double area = 0;
  const std::size_t corners = std::min(polygon.size(), most_corners);
  for (std::size_t n = 0; n < corners; ++n) {
    const point2& p = polygon[n];
    const point2& q = polygon[(n + 1) % corners];
    area += p.x * q.y - q.x * p.y;
  }
  const double sign = area > 0 ? 1 : -1;
  for (std::size_t n = 0; n < corners; ++n) {
    const point2& p = polygon[n];
    const point2& q = polygon[(n + 1) % corners];
    const double length = std::hypot(q.x - p.x, q.y - p.y);
    if (length < 1e-6)
      continue;
    const double a = -sign * (q.y - p.y) / length;
    const double b = sign * (q.x - p.x) / length;
    edges[count++] = {a, b, -(a * p.x + b * p.y)};
  }
  const pixel_range range = range_of(on, polygon);
  for (int y = range.top; y <= range.bottom; ++y)
    for (int x = range.left; x <= range.right; ++x) {
      double inside = 1;
      for (std::size_t n = 0; n < count && inside > 0; ++n)
        inside = std::min(inside, edges[n].a * x + edges[n].b * y + edges[n].c + 0.5);
      if (inside > 0)
        paint(x, y, on.pixels[on.index(x, y)], inside);
    }
}

inline void blend(std::uint8_t& pixel, double value, double share) {
  pixel = static_cast<std::uint8_t>(std::clamp(pixel + (value - pixel) * share + 0.5, 0.0, 255.0));
}

} // namespace godwit::sim::camera
