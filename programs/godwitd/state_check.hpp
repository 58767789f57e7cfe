// Whether what is on disk is godwit's, and of a version that this godwit reads. Only reads, also beside a running one.
//
// Errors: sentences with the file and the remedy. Thread: any; blocks on the disk.
#pragma once

#include <optional>
#include <string>

namespace godwit::daemon {

// Why FILE can not be taken over: foreign, newer or damaged. Nothing: it can, or is not there yet.
[[nodiscard]] std::optional<std::string> objection_to_journal(const std::string& file);
[[nodiscard]] std::optional<std::string> objection_to_map(const std::string& file);

} // namespace godwit::daemon
