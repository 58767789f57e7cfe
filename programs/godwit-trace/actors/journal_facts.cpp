#include "programs/godwit-trace/actors/journal_facts.hpp"

#include <exception>
#include <utility>

#include "actors/mission_client/core.hpp"
#include "programs/godwit-trace/actors/dead_letters.hpp"
#include "runtime/journal/journal_reader.hpp"
#include "runtime/stored_state.hpp"
#include "runtime/variant_json.hpp"

namespace godwit::trace_tool {

namespace {

using mission_client::durable_core;
using runtime::journal_reader;

constexpr const char* client_name = "mission_client";
constexpr const char* executor_name = "executor";

// Throws state_unreadable: the journal is of another version.
mission_client::state state_of(const std::optional<runtime::snapshot_record>& snapshot,
                               const std::vector<runtime::event_record>& events) {
  mission_client::state result;
  if (snapshot)
    result = runtime::read_state<durable_core>(client_name, *snapshot);
  for (const auto& each : events)
    (void)durable_core::apply(result, runtime::read_alternative<durable_core::event>(client_name, each.type, each.body),
                              each.at_ns);
  return result;
}

// Read again where a snapshot has taken the place of events in between.
tl::expected<mission_client::state, std::string> read_client(journal_reader& reader) {
  constexpr int tries = 3;
  for (int n = 0; n < tries; ++n) {
    const auto snapshot = reader.snapshot(client_name);
    if (!snapshot)
      return tl::unexpected(snapshot.error().message());
    const auto from = *snapshot ? (*snapshot)->number : 0;
    const auto events = reader.events(client_name, from);
    if (!events)
      return tl::unexpected(events.error().message());
    if (!events->empty() && events->front().number != from + 1)
      continue;
    try {
      return state_of(*snapshot, *events);
    } catch (const std::exception& why) {
      return tl::unexpected(std::string(why.what()));
    }
  }
  return tl::unexpected(std::string("the journal is written too fast to be read; try again"));
}

} // namespace

tl::expected<invariants::journal_record, std::string> read_journal_record(const std::string& journal,
                                                                          const std::vector<std::string>& actors) {
  auto reader = journal_reader::open(journal);
  if (!reader)
    return tl::unexpected(reader.error().message());
  auto outbox = reader->outbox(client_name);
  auto owed = reader->effects(executor_name); // before what mission_client has: what it takes meanwhile is in both
  if (!outbox || !owed)
    return tl::unexpected((!outbox ? outbox.error() : owed.error()).message());
  const auto state = read_client(*reader);
  if (!state)
    return tl::unexpected(state.error());
  auto letters = read_dead_letters(journal, actors);
  if (!letters)
    return tl::unexpected(std::move(letters.error()));
  invariants::journal_record result{*std::move(outbox), {}, *std::move(owed), {}};
  for (const auto& each : state->missions)
    result.last_reports[each.mission_id] = each.last_report_no;
  for (auto& each : *letters)
    result.given_up.push_back({std::move(each.actor), std::move(each.letter)});
  return result;
}

} // namespace godwit::trace_tool
