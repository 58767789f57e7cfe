#include "actors/executor/state_token.hpp"

#include "io/fields/field_table.hpp"

namespace godwit::executor {

std::string state_token(const state& s) {
  const bool waits = s.preflight.now == preflight::phase::awaiting_ack && s.preflight.report;
  std::string result(io::name_of(s.status.now));
  result += '/' + std::string(io::name_of(s.status.cause));
  result += '/' + (s.mission ? s.mission->mission_id : std::string());
  result += '/' + std::to_string(s.mission ? s.mission->revision : 0);
  result += '/' + std::to_string(s.progress.last_generation);
  result += '/' + std::to_string(waits ? s.preflight.report->id : 0);
  return result;
}

} // namespace godwit::executor
