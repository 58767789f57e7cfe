// What a thing in a picture is by its look. Thread: plain values.
#pragma once

#include "io/fields/field_table.hpp"

namespace godwit::io::eyes {

enum class object_class { unknown, person, vehicle, animal, boat };

GODWIT_ENUM_NAMES(object_class, unknown, person, vehicle, animal, boat);

} // namespace godwit::io::eyes
