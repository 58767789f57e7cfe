// All that is said to and by mapobjects_store. Thread: plain values.
#pragma once

#include <cstdint>

#include "io/fields/field_table.hpp"
#include "messages/mapobjects_store/answer.hpp"
#include "messages/mapobjects_store/delivery.hpp"
#include "messages/mapobjects_store/load.hpp"
#include "messages/mapobjects_store/object.hpp"
#include "messages/mapobjects_store/observation.hpp"
#include "messages/mapobjects_store/operator_verdict.hpp"
#include "messages/mapobjects_store/pass.hpp"
#include "messages/mapobjects_store/status.hpp"

namespace godwit::mapobjects_store {

// What the actor is told by its own helpers. Thread: plain values.

// The writer has finished something.
struct wake {
  static constexpr auto fields = io::table("mapobjects_store.wake");
};

// Time to look at how the map is.
struct look {
  std::uint64_t incarnation = 0; // that wanted it; those before have no time to keep any more
  GODWIT_FIELDS(look, "mapobjects_store.look", incarnation);
};

} // namespace godwit::mapobjects_store
