// Takes away what nobody sees any more, in turns: rows of replaced and abandoned loads, rows seen here that a load now
// contains, and old delivered observations.
//
// Thread: the writer's.
#pragma once

#include <cstdint>
#include <vector>

#include "actors/mapobjects_store/staged_work.hpp"

namespace godwit::mapobjects_store {

// Delivered observations that are kept: as long as one is there, a sighting that comes again is recognised. At 30
// sightings a second these are 55 minutes.
inline constexpr std::int64_t max_delivered_observations = 100'000;

// Some neighbours in a table.
struct garbage_rows {
  std::vector<std::int64_t> garbage;
  std::int64_t last = 0; // highest number looked at; 0 = there was none
};

class garbage_collection final : public staged_work {
public:
  explicit garbage_collection(std::int64_t keep_delivered = max_delivered_observations)
      : keep_delivered_(keep_delivered) {}

  [[nodiscard]] map_result<bool> stage(map_tables& t, decision_context& now) override;
  void committed() override { next_ = staged_; }
  [[nodiscard]] bool must_be_synced() const override { return false; }
  void finish(const map_result<void>&) override {} // what is left is found by the next one

private:
  struct place {
    int table = 0;           // of those to be looked through
    std::int64_t number = 0; // looked through up to here
  };

  map_result<bool> loaded_objects(map_tables& t, decision_context& now);
  map_result<bool> loaded_places(map_tables& t, decision_context& now);
  map_result<bool> seen_objects(map_tables& t, decision_context& now);
  map_result<bool> ignored_items(map_tables& t, decision_context& now);
  map_result<bool> observations(map_tables& t, decision_context& now);
  template <class Delete>
  map_result<bool> go_on(const map_result<garbage_rows>& found, decision_context& now, const Delete& remove);

  std::int64_t keep_delivered_;
  place next_;
  place staged_;
};

} // namespace godwit::mapobjects_store
