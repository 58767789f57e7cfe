// What vehicles delivered: each row is there once, by its mission, kind and id. Errors: kept by the file. Thread: the
// file's.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "programs/godwit-sim/missions/figures.hpp"
#include "programs/godwit-sim/missions/service_file.hpp"

namespace godwit::sim::missions {

// True: it is new. False: there is one already, which stays as it is; the repetition is counted.
bool put_row(service_file& file, const std::string& mission_id, row_kind kind, const std::string& id,
             const std::string& text);

[[nodiscard]] std::optional<std::string> row_text(service_file& file, const std::string& mission_id, row_kind kind,
                                                  const std::string& id);
[[nodiscard]] std::vector<stored_row> rows_of(service_file& file, const std::string& mission_id, row_kind kind);
[[nodiscard]] std::map<row_kind, row_figures> row_counts(service_file& file);

} // namespace godwit::sim::missions
