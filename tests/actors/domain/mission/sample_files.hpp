// The files of tests/data/missions.
#pragma once

#include <string>

namespace godwit::mission {

/// Whole text of tests/data/missions/`name`.
std::string sample_file(const std::string& name);

} // namespace godwit::mission
