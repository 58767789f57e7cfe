#include <array>

#include "invariants/invariant.hpp"
#include "invariants/rules/rules.hpp"

namespace godwit::invariants {

std::span<const rule> all_rules() {
  static constexpr const char* inside = "docs/architecture.md, The way of a message";
  static constexpr const char* crash = "docs/architecture.md, A crash, step by step";
  static constexpr const char* progress = "docs/progress.md";
  static constexpr const char* executor = "docs/actors/executor.md";
  static constexpr const char* failsafe = "docs/actors/failsafe.md";
  static constexpr const char* scan = "docs/actors/scan_controller.md";
  static constexpr std::array<rule, 18> rules{{
      {"cause_before_effect", "A message is taken after the one that caused it, which its sender took.", inside,
       make_cause_before_effect},
      {"one_handler_at_a_time", "An actor is in one handler at a time.", inside, make_one_handler_at_a_time},
      {"incarnations_rise", "When a new incarnation is there, the one before takes no messages.", crash,
       make_incarnations_rise},
      {"crash_ends_incarnation", "An exception ends the incarnation.", crash, make_crash_ends_incarnation},
      {"handled_once", "An incarnation handles a message once, and no two messages have the same id.", inside,
       make_handled_once},
      {"reports_without_gap", "The reports of a mission are numbered without a gap, and none is two.", progress,
       make_reports_without_gap},
      {"complete_once", "A revision of a mission is complete once, and nothing is reported of it after that.", progress,
       make_complete_once},
      {"generation_never_falls", "Reports are of the newest plan that is flown, never of an older one.", progress,
       make_generation_never_falls},
      {"guarded_by_its_fences", "What is flown of a mission is guarded by the fences of that mission.", failsafe,
       make_guarded_by_its_fences},
      {"pilot_is_left_alone", "While a pilot has the vehicle, godwit does not arm or start it.", executor,
       make_pilot_is_left_alone},
      {"restart_starts_nothing", "Nothing is armed or started because an actor was restarted.", executor,
       make_restart_starts_nothing},
      {"latch_holds", "A rule of the failsafe acts once in a flight, until the vehicle is handed back.", failsafe,
       make_latch_holds},
      {"points_within_rate", "No more points of interest are shown in any minute than are set.", scan,
       make_points_within_rate},
      {"point_closed_once", "A point of interest is confirmed, declined or passed over, and stays so.", scan,
       make_point_closed_once},
      {"reports_are_kept", "A report that was taken is in the journal, or is still pending there.", progress,
       make_reports_are_kept, true},
      {"outbox_numbers_once", "No two reports of a mission in the outbox have the same number.", progress,
       make_outbox_numbers_once, true},
      {"outbox_was_told", "The outbox has no report that nobody made.", progress, make_outbox_was_told, true},
      {"given_up_is_written", "A message that is given up after its crashes is among the dead letters.", crash,
       make_given_up_is_written, true},
  }};
  return rules;
}

} // namespace godwit::invariants
