// Reading an actor's snapshot: the version it was written with, migration up to today's, refusal of what is newer.
// Thread: pure.
#pragma once

#include <string>

#include "io/fields/json_value.hpp"
#include "runtime/journal/records.hpp"
#include "runtime/journal_exceptions.hpp"

namespace godwit::runtime {

template <class Core>
[[nodiscard]] typename Core::state read_state(const std::string& actor, const snapshot_record& snapshot) {
  using state = typename Core::state;
  if (snapshot.version > state::version)
    throw state_unreadable(actor, "the snapshot has version " + std::to_string(snapshot.version) +
                                      ", this program knows up to " + std::to_string(state::version));
  auto document = nlohmann::json::parse(snapshot.body, nullptr, false);
  if (document.is_discarded())
    throw state_unreadable(actor, "the snapshot is not JSON");
  if constexpr (state::version > 1) {
    if (snapshot.version < state::version) {
      auto migrated = Core::migrate(std::move(document), snapshot.version);
      if (!migrated)
        throw state_unreadable(actor, migrated.error());
      document = std::move(*migrated);
    }
  }
  state result{};
  if (const auto read = io::read_json(document, result); !read)
    throw state_unreadable(actor, read.error().message());
  return result;
}

} // namespace godwit::runtime
