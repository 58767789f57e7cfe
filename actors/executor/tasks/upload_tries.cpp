#include "actors/executor/tasks/upload_tries.hpp"

#include <string>
#include <utility>

#include "io/mavlink/enums.hpp"

namespace godwit::executor {
namespace {

namespace transfer = vehicle_link::transfer;
using progress::upload_verdict;

} // namespace

bool has_no_room(const transfer::outcome& outcome) {
  return outcome.verdict == transfer::verdict::refused &&
         outcome.result == io::mavlink::number(io::mavlink::mav_mission_result::no_space);
}

progress::upload_ended end_of(const transfer::outcome& outcome) {
  progress::upload_ended result{upload_verdict::unknown, outcome.plan_id, outcome.reason, has_no_room(outcome)};
  if (outcome.verdict == transfer::verdict::accepted)
    result.verdict = upload_verdict::accepted;
  else if (outcome.holding == transfer::holding::unchanged)
    result.verdict = upload_verdict::unchanged;
  else if (outcome.holding == transfer::holding::other)
    result.verdict = upload_verdict::other;
  return result;
}

void upload_tries::begin(std::int64_t now_ns) {
  *this = {};
  began_ns_ = now_ns;
}

bool upload_tries::go_on(const transfer::outcome& outcome, std::int64_t now_ns) {
  const bool was_begun = outcome.verdict != transfer::verdict::not_begun;
  begun_ += was_begun ? 1 : 0;
  const bool is_unheard = !was_begun || outcome.verdict == transfer::verdict::timed_out;
  if (!is_unheard || begun_ >= max_uploads || now_ns - began_ns_ >= uploads_within_ns)
    return false;
  may_have_come_ = may_have_come_ || outcome.holding != transfer::holding::unchanged;
  return true;
}

progress::upload_ended upload_tries::end(const transfer::outcome& last) const { return after_earlier(end_of(last)); }

progress::upload_ended upload_tries::end_unsent(const std::string& why) const {
  return after_earlier({upload_verdict::unchanged, {}, why});
}

// That the last try has changed nothing says nothing of those before.
progress::upload_ended upload_tries::after_earlier(progress::upload_ended last) const {
  if (may_have_come_ && (last.verdict == upload_verdict::unchanged || last.verdict == upload_verdict::other))
    last.verdict = upload_verdict::unknown;
  return last;
}

} // namespace godwit::executor
