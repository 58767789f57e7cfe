// Where a child stands: supervision_core.hpp draws how it goes on from there. Thread: constants.
#pragma once

#include "io/fields/field_table.hpp"

namespace godwit::runtime {

enum class child_phase { absent, starting, running, stopping, waiting, given_up };

constexpr auto enum_names(child_phase) {
  return io::names<child_phase>({{child_phase::absent, "absent"},
                                 {child_phase::starting, "starting"},
                                 {child_phase::running, "running"},
                                 {child_phase::stopping, "stopping"},
                                 {child_phase::waiting, "waiting"},
                                 {child_phase::given_up, "given_up"}});
}

} // namespace godwit::runtime
