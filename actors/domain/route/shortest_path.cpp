#include "actors/domain/route/shortest_path.hpp"

#include <algorithm>
#include <limits>
#include <optional>

namespace godwit::route {

namespace {

constexpr double unreached = std::numeric_limits<double>::infinity();

struct visit {
  double way_m = unreached; // from the first place
  std::size_t from = 0;
  bool is_done = false;
};

std::vector<std::size_t> way_to(const std::vector<visit>& visits, std::size_t first, std::size_t last) {
  std::vector<std::size_t> way{last};
  while (way.back() != first)
    way.push_back(visits[way.back()].from);
  std::reverse(way.begin(), way.end());
  return way;
}

} // namespace

std::vector<std::size_t> shortest_path(const std::vector<local_point>& places, std::size_t first, std::size_t last,
                                       const sees& can_see) {
  std::vector<visit> visits(places.size());
  visits[first].way_m = 0;
  const auto at_least_m = [&](std::size_t i) { return visits[i].way_m + length_m(places[last] - places[i]); };
  const auto next = [&]() -> std::optional<std::size_t> {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < places.size(); ++i)
      if (!visits[i].is_done && visits[i].way_m < unreached && (!best || at_least_m(i) < at_least_m(*best)))
        best = i;
    return best;
  };
  while (const auto here = next()) {
    if (*here == last)
      return way_to(visits, first, last);
    visits[*here].is_done = true;
    for (std::size_t to = 0; to < places.size(); ++to) {
      const double way_m = visits[*here].way_m + length_m(places[to] - places[*here]);
      if (!visits[to].is_done && way_m < visits[to].way_m && can_see(*here, to))
        visits[to] = {way_m, *here, false};
    }
  }
  return {};
}

} // namespace godwit::route
