// Random fences, places and ways for tests: from half a metre to 100 km, across the antimeridian, around poles, dented,
// crossing themselves, with floors and ceilings; the places often on a side or a corner, or some millimetres beside it.
// Thread: pure.
#pragma once

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "actors/domain/geofence/place.hpp"
#include "tests/actors/domain/route/fences.hpp"

namespace godwit::tests {

class fence_world {
public:
  explicit fence_world(std::uint64_t seed, double least_m = 0.5, double most_m = 100'000)
      : random_(seed), origin_(one_of<geo::point>({{47.4, 8.5}, {-17, 179.9999}, {0, 0}, {89.999, 30}, {-89.9, -170}})),
        scale_m_(std::exp(number(std::log(least_m), std::log(most_m)))) {
    for (int count = whole(1, 5); count > 0; --count)
      fences.push_back(some_fence());
  }

  [[nodiscard]] geofence::place some_place() {
    auto at = flat(number(-1.5, 1.5), number(-1.5, 1.5));
    if (whole(0, 2) == 0)
      at = beside_a_side();
    return {at, one_of<double>({0, 20, 50, 100, number(-10, 130)})};
  }

  [[nodiscard]] int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  [[nodiscard]] double number(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  [[nodiscard]] double scale_m() const { return scale_m_; }

  std::vector<mission::geofence> fences;

private:
  template <class T>
  T one_of(std::initializer_list<T> all) {
    return all.begin()[static_cast<std::size_t>(whole(0, static_cast<int>(all.size()) - 1))];
  }

  [[nodiscard]] geo::point flat(double east, double north) const {
    return place(east * scale_m_, north * scale_m_, origin_);
  }

  // On a side or a corner, or up to 3 mm and 30 mm beside it.
  [[nodiscard]] geo::point beside_a_side() {
    const auto& corners = fences[static_cast<std::size_t>(whole(0, static_cast<int>(fences.size()) - 1))].vertices;
    const auto i = static_cast<std::size_t>(whole(0, static_cast<int>(corners.size()) - 1));
    const geo::local_projection around({corners[i].latitude, corners[i].longitude});
    const auto& next = corners[(i + 1) % corners.size()];
    const auto to = around.to_local({next.latitude, next.longitude});
    const double share = one_of<double>({0, number(0, 1), 1});
    const double off_m = one_of<double>({0, 0.003, 0.03});
    return around.to_globe({share * to.east_m + number(-off_m, off_m), share * to.north_m + number(-off_m, off_m)});
  }

  mission::geofence some_fence() {
    const double size = number(0.1, 1);
    const geo::local_point centre{number(-0.7, 0.7) * scale_m_, number(-0.7, 0.7) * scale_m_};
    auto result = fence(one_of({mission::fence_kind::inclusion, mission::fence_kind::exclusion}),
                        star(random_, centre, 0.2 * size * scale_m_, size * scale_m_), origin_);
    if (whole(0, 2) == 0) // crosses itself more often than not
      std::swap(result.vertices.front(), result.vertices[result.vertices.size() / 2]);
    if (whole(0, 1) == 0)
      result.floor_m = one_of<double>({0, 20});
    if (whole(0, 1) == 0)
      result.ceiling_m = one_of<double>({50, 100});
    return result;
  }

  std::mt19937_64 random_;
  geo::point origin_;
  double scale_m_;
};

} // namespace godwit::tests
