// What waits for the writer of the map: changes, which share a transaction, and long jobs, which are begun when all
// that came before them is durable.
//
// Thread: plain values; the writer runs them.
#pragma once

#include <functional>
#include <memory>
#include <variant>

#include "actors/mapobjects_store/map_store.hpp"

namespace godwit::mapobjects_store {

// A change of the map, tried again from its beginning when the disk refuses it.
struct queued_change {
  map_store::change work;
  std::function<void(const map_result<void>&)> done;
};

// Makes a long job; tells its asker itself when that fails.
struct queued_job {
  std::function<std::unique_ptr<staged_work>(map_store&)> start;
  std::function<void(const map_error&)> dropped; // instead of being started
};

using queued_work = std::variant<queued_change, queued_job>;

} // namespace godwit::mapobjects_store
