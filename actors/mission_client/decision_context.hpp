// Collects what one event leads to. Used by the durable core's own files only.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "actors/mission_client/events.hpp"

namespace godwit::mission_client {

// Why rows of a mission are kept and not tried any more.
inline constexpr std::string_view mission_is_deleted = "the service has deleted this mission";

// After so many batches of one kind that the service would not have, the rest is kept in the store for a person to look
// at, who sees the reason.
inline constexpr std::ptrdiff_t max_refused_batches = 8;

// Rows of a batch, above which the setting counts alone (settings::batch_limit, the contract's bound).
inline constexpr std::uint32_t largest_batch = 500;

struct decision_context {
  state& s;
  std::int64_t now_ns;
  std::vector<effect> done = {};

  void tell(effect what) { done.push_back(std::move(what)); }
};

// -- core_notes.cpp -------------------------------------------------------------------------------

// Never invalid before the next call of this function.
[[nodiscard]] mission_note& note_of(state& s, const std::string& mission_id);
void add_store_operation(state& s, store_operation_kind kind, const std::string& mission_id, const std::string& reason);
// mission_resolved for each mission that is pushed and has nothing pending any more.
void resolve(decision_context& t);

// -- core_reports.cpp ------------------------------------------------------------------------------

// The service has reports of the mission up to this one, and this journal has fewer: numbers go on after it. What
// waits and was numbered since the journal was taken up is numbered anew, and left out where the service has it.
void continue_after(decision_context& t, mission_note& note, const earlier_reports& told);
void take(decision_context& t, const report_progress& m);
void take(decision_context& t, const begun_anew& m);
void take(decision_context& t, const progress_told& m);
// At the service, of a report that was taken.
[[nodiscard]] std::uint32_t number_at_service(const mission_note& note, std::uint32_t report_no);

// The service will not have these items of a change that the vehicle flies, the row of which stood at ORDER: reports of
// them are not sent, and the later ones follow without a gap. None of them was sent before: they waited for the change.
void leave_items_out(decision_context& t, const std::string& mission_id, const std::vector<mission::item>& items,
                     std::uint64_t order);
// As a service takes it that sends missions of this version.
[[nodiscard]] mission::progress_report as_known(mission::progress_report report, std::string_view schema_version);
[[nodiscard]] bool is_left_out(const mission_note& note, const mission::progress_report& report);
// It has these.
void note_known_items(decision_context& t, const mission::document& mission);

// -- core_outbox.cpp ------------------------------------------------------------------------------

// Whether this key is known already, delivered or not.
[[nodiscard]] bool is_repetition(const state& s, const std::string& key);
// One of the last that were resolved.
void remember(state& s, const std::string& key);
// ROW's identity and content; the rest is filled in. False: there is no room, which is counted.
[[nodiscard]] bool add_row(decision_context& t, outbox_row row, std::size_t reserve);
// The row leaves the outbox.
void remove_row(decision_context& t, const std::string& key, noted_as how);
// Kept, and not tried any more. A change fails instead. ROW is then gone.
void give_up(decision_context& t, const std::string& key, row_state as, const std::string& reason);
void give_up_all(decision_context& t, const std::vector<std::string>& keys, row_state as, const std::string& reason);
// Keys of the rows for which MATCHES(row).
template <class Matches>
[[nodiscard]] std::vector<std::string> keys_where(const state& s, Matches matches) {
  std::vector<std::string> result;
  for (const auto& each : s.rows)
    if (matches(each))
      result.push_back(each.key);
  return result;
}

void take(decision_context& t, const respond_to_assignment& m);
void take(decision_context& t, const retry_outbox& m);
void take(decision_context& t, const deliver_picture& m);
void take(decision_context& t, const rows_delivered& m);
void take(decision_context& t, const rows_failed& m);
void take(decision_context& t, const rows_refused& m);
void take(decision_context& t, const batch_planned& m);
void take(decision_context& t, const batch_empty& m);
void take(decision_context& t, const batch_returned& m);
void take(decision_context& t, const clock_jumped& m);

// -- core_changes.cpp ------------------------------------------------------------------------------

// Under which one that is flown is remembered as resolved: it may have failed before as one that was waited for.
[[nodiscard]] std::string flown_key(const std::string& key);
void take(decision_context& t, const insert_waypoint& m);
void take(decision_context& t, const replace_tail& m);
void take(decision_context& t, const change_done& m);
void take(decision_context& t, const change_failed& m);

} // namespace godwit::mission_client
