#include "programs/godwit-trace/actors/dead_letters.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include <nlohmann/json.hpp>

#include "actors/mission_client/core.hpp"
#include "runtime/journal/journal_reader.hpp"
#include "runtime/stored_state.hpp"

namespace godwit::trace_tool {

tl::expected<std::vector<given_up>, std::string> read_dead_letters(const std::string& journal,
                                                                   const std::vector<std::string>& actors) {
  auto reader = runtime::journal_reader::open(journal);
  if (!reader)
    return tl::unexpected(reader.error().message());
  std::vector<given_up> result;
  for (const auto& actor : actors) {
    auto letters = reader->dead_letters(actor);
    if (!letters)
      return tl::unexpected(letters.error().message());
    for (auto& each : *letters)
      result.push_back({actor, std::move(each)});
  }
  std::ranges::stable_sort(result, {}, [](const given_up& each) { return each.letter.at_ns; });
  return result;
}

void append_dead_letter(std::string& out, const given_up& each, const paint& colours) {
  append_utc_ns(out, each.letter.at_ns);
  out.append(" ").append(colours.bad()).append(each.actor).append(" gave up").append(colours.end());
  out += ' ' + each.letter.type + " #" + std::to_string(each.letter.message_id) + " of " + each.letter.sender +
         ", after " + std::to_string(each.letter.attempts) + " crashes: ";
  append_printable(out, each.letter.reason);
  out += "\n  ";
  append_printable(out, each.letter.body);
  out += '\n';
}

void append_dead_letter_json(std::string& out, const given_up& each) {
  out += R"({"dead_letter":)" + std::to_string(each.letter.message_id) + R"(,"cause":)" +
         std::to_string(each.letter.cause_id) + R"(,"time_ns":)" + std::to_string(each.letter.at_ns) +
         R"(,"attempts":)" + std::to_string(each.letter.attempts);
  append_member(out, "actor", each.actor);
  append_member(out, "sender", each.letter.sender);
  append_member(out, "type", each.letter.type);
  append_member(out, "reason", each.letter.reason);
  append_member(out, "message", each.letter.body);
  out += "}\n";
}

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
