// Where a child stands: supervision_core.hpp draws how it goes on from there. Thread: constants.
#pragma once

#include "io/fields/field_table.hpp"

namespace godwit::runtime {

enum class child_phase { absent, starting, running, stopping, waiting, given_up };

GODWIT_ENUM_NAMES(child_phase, absent, starting, running, stopping, waiting, given_up);

} // namespace godwit::runtime
