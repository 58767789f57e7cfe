#include "runtime/stored_state.hpp"

#include <nlohmann/json.hpp>

#include "runtime/journal_exceptions.hpp"

namespace godwit::runtime {

void read_snapshot(const std::string& actor, const snapshot_record& snapshot, int version, state_migration migrate,
                   const message_type& type, void* state) {
  if (snapshot.version > version)
    throw state_unreadable(actor, "the snapshot has version " + std::to_string(snapshot.version) +
                                      ", this program knows up to " + std::to_string(version));
  auto document = nlohmann::json::parse(snapshot.body, nullptr, false);
  if (document.is_discarded())
    throw state_unreadable(actor, "the snapshot is not JSON");
  if (snapshot.version < version && migrate != nullptr) {
    auto migrated = migrate(std::move(document), snapshot.version);
    if (!migrated)
      throw state_unreadable(actor, migrated.error());
    document = std::move(*migrated);
  }
  if (const auto wrong = type.read_json(document, state); !wrong.empty())
    throw state_unreadable(actor, wrong);
}

} // namespace godwit::runtime
