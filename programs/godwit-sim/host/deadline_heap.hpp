// Who is due next, of a fixed number of members that each have one deadline which moves all the time.
//
// A binary heap that knows where each member stands, so that moving a deadline costs a few steps and leaves nothing
// behind. Thread: one at a time. Source: any textbook (indexed priority queue).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace godwit::sim {

class deadline_heap {
public:
  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

  // All are due never. At least one member.
  explicit deadline_heap(std::size_t members) : deadlines_(members, never), order_(members), places_(members) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::iota(places_.begin(), places_.end(), std::size_t{0});
  }

  void set(std::size_t member, std::int64_t deadline) {
    deadlines_[member] = deadline;
    sink(rise(places_[member]));
  }
  [[nodiscard]] std::size_t first() const { return order_.front(); }
  [[nodiscard]] std::int64_t first_deadline() const { return deadlines_[order_.front()]; }

private:
  [[nodiscard]] std::int64_t at(std::size_t place) const { return deadlines_[order_[place]]; }
  void exchange(std::size_t a, std::size_t b) {
    std::swap(order_[a], order_[b]);
    places_[order_[a]] = a;
    places_[order_[b]] = b;
  }
  std::size_t rise(std::size_t place) {
    while (place > 0 && at(place) < at((place - 1) / 2)) {
      exchange(place, (place - 1) / 2);
      place = (place - 1) / 2;
    }
    return place;
  }
  void sink(std::size_t place) {
    for (;;) {
      auto least = place;
      for (const auto child : {2 * place + 1, 2 * place + 2})
        if (child < order_.size() && at(child) < at(least))
          least = child;
      if (least == place)
        return;
      exchange(place, least);
      place = least;
    }
  }

  std::vector<std::int64_t> deadlines_; // by member
  std::vector<std::size_t> order_;      // the heap: members
  std::vector<std::size_t> places_;     // by member: where it stands in the heap
};

} // namespace godwit::sim
