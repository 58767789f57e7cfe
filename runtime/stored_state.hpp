// Reading an actor's snapshot: the version it was written with, migration up to today's, refusal of what is newer. And
// the form in which the trace has what an incarnation was restored from.
// Thread: pure.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>
#include <tl/expected.hpp>

#include "runtime/journal/records.hpp"
#include "runtime/message_type.hpp"

namespace godwit::runtime {

// Brings a state of an older version to today's, or says why not.
using state_migration = tl::expected<nlohmann::json, std::string> (*)(nlohmann::json old, int from_version);

// Reads SNAPSHOT into STATE, a value of TYPE whose version is VERSION. Throws state_unreadable. MIGRATE may be null
// when there has been one version only.
void read_snapshot(const std::string& actor, const snapshot_record& snapshot, int version, state_migration migrate,
                   const message_type& type, void* state);

// What an incarnation begins with, as one JSON text for the trace: STATE is the snapshot of FROM with the later events
// applied; bodies that are JSON stand in it as such.
[[nodiscard]] std::string restored_json(const recovered& from, const snapshot_record& state);
// Read back: nothing when it is no such text. What was seen of others is not in it.
[[nodiscard]] std::optional<recovered> read_restored(const nlohmann::json& document);

template <class Core>
[[nodiscard]] typename Core::state read_state(const std::string& actor, const snapshot_record& snapshot) {
  using state = typename Core::state;
  state_migration migrate = nullptr;
  if constexpr (state::version > 1)
    migrate = &Core::migrate;
  state result{};
  read_snapshot(actor, snapshot, state::version, migrate, type_of<state>(), &result);
  return result;
}

} // namespace godwit::runtime
