#include "runtime/journal/records.hpp"

namespace godwit::runtime {

std::string journal_error::message() const { return "journal " + file + ": " + what + ". " + remedy; }

namespace {

// Memory of a record beside its texts, roughly; only the order of magnitude matters for the bound.
constexpr std::size_t record_overhead_bytes = 128;

std::size_t bytes_of(const row_change& change) {
  std::size_t bytes = record_overhead_bytes + change.sql.size();
  for (const auto& value : change.values)
    bytes += sizeof(value) + (std::holds_alternative<std::string>(value) ? std::get<std::string>(value).size() : 0);
  return bytes;
}

} // namespace

std::size_t bytes_of(const journal_write& write) {
  std::size_t bytes = sizeof(write) + write.actor.size();
  for (const auto& event : write.events)
    bytes += record_overhead_bytes + event.type.size() + event.body.size();
  if (write.snapshot)
    bytes += write.snapshot->body.size();
  for (const auto& effect : write.effects)
    bytes += record_overhead_bytes + effect.type.size() + effect.body.size();
  for (const auto& mark : write.seen)
    bytes += record_overhead_bytes + mark.source.size();
  for (const auto& change : write.rows)
    bytes += bytes_of(change);
  for (const auto& row : write.outbox)
    bytes += record_overhead_bytes + row.idempotency_key.size() + row.destination.size() + row.body.size();
  for (const auto& letter : write.dead_letters)
    bytes += record_overhead_bytes + letter.body.size() + letter.reason.size();
  return bytes + write.released.size() * sizeof(effect_id);
}

} // namespace godwit::runtime
