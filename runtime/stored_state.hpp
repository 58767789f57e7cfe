// Reading an actor's snapshot: the version it was written with, migration up to today's, refusal of what is newer.
// Thread: pure.
#pragma once

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
