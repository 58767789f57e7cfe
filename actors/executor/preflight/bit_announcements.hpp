// What others hear of the state of the preflight checks. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "actors/executor/preflight/bit_state.hpp"
#include "actors/executor/preflight/report.hpp"
#include "io/fields/field_table.hpp"
#include "runtime/effect_kind.hpp"

namespace godwit::executor::preflight {

// At each change of phase or sentence.
struct phase_changed {
  static constexpr auto goes_out = runtime::effect_kind::after_commit;
  phase now = phase::idle;
  std::string sentence; // for people, see sentence_of
  GODWIT_FIELDS(phase_changed, "executor.preflight_phase_changed", now, sentence);
};

// For operators: this report waits for an acknowledgement that names its number. It replaces the one before.
struct report_opened {
  static constexpr auto goes_out = runtime::effect_kind::after_commit;
  report what;
  std::int64_t acknowledge_until_ns = 0; // wall clock
  GODWIT_FIELDS(report_opened, "executor.preflight_report_opened", what, acknowledge_until_ns);
};

// The answer to `acknowledged`. Repeated, it is taken again.
struct acknowledgement_answered {
  static constexpr auto goes_out = runtime::effect_kind::after_commit;
  std::uint32_t report_id = 0;
  bool is_taken = false;
  std::string reason; // sentence for people; empty when taken
  GODWIT_FIELDS(acknowledgement_answered, "executor.preflight_acknowledgement_answered", report_id, is_taken, reason);
};

using announcement = std::variant<report_opened, acknowledgement_answered, phase_changed>;
using announcements = std::vector<announcement>;

} // namespace godwit::executor::preflight
