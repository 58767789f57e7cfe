// What the actor is told by its own helpers. Thread: plain values.
#pragma once

#include "io/fields/field_table.hpp"

namespace godwit::mapobjects_store {

// The writer has finished something.
struct wake {
  static constexpr auto fields = io::table("mapobjects_store.wake");
};

// Time to look at how the map is.
struct look {
  static constexpr auto fields = io::table("mapobjects_store.look");
};

} // namespace godwit::mapobjects_store
