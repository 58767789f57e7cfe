// The part of the core that is about commands of operators. What an order means is in word_reading.hpp, what a
// repetition hears in command_dedup.hpp.
#include <optional>
#include <string>
#include <utility>

#include "actors/ground_port/command_reading.hpp"
#include "actors/ground_port/core.hpp"
#include "actors/ground_port/decision_context.hpp"
#include "io/mavlink/frame_meaning.hpp"

namespace godwit::ground_port {

using mavlink::mav_result;

std::optional<double> core::home_altitude_m() const {
  constexpr double mm_per_m = 1'000;
  const auto& home = gate_.newest(mavlink::home_position::message_id);
  if (!home)
    return std::nullopt;
  return std::get<mavlink::home_position>(*home).altitude / mm_per_m;
}

std::optional<mission::position> core::here() const {
  constexpr double mm_per_m = 1'000;
  const auto& newest = gate_.newest(mavlink::global_position_int::message_id);
  if (!newest)
    return std::nullopt;
  const auto& m = std::get<mavlink::global_position_int>(*newest);
  return mission::position{m.lat / mavlink::units_a_degree, m.lon / mavlink::units_a_degree, m.relative_alt / mm_per_m};
}

// An altitude that a station sends when its hold is answered is that at which the vehicle was when it asked for it.
told_by_vehicle core::told_to(mavlink::sender who, std::int64_t now_ns) const {
  constexpr std::int64_t follows_within_ns = 10'000'000'000; // a hold is answered within seconds
  told_by_vehicle result{owner_.autopilot, home_altitude_m(), here()};
  if (held_from_ && held_from_->by == who && now_ns - held_from_->at_ns < follows_within_ns)
    result.held_from_m = held_from_->altitude_m;
  return result;
}

void core::say_word(decision_context& t, const vehicle_role::order& what) {
  const auto now_ns = t.now.monotonic_ns;
  if (const auto heard = words_.heard_before(what, now_ns))
    return answer(t, what, *heard);
  const auto command = read_word(what, told_to(what.from, now_ns));
  if (!command)
    return refuse(t, what, command.error().result, command.error().text);
  if (command->kind == operators::command_kind::resume && noted_start_item_)
    return start_or_resume(t, what, name_for_people(what)); // at the item that was chosen while it was paused
  begin_word(t, what, *command);
}

void core::say_word_of(decision_context& t, const vehicle_role::order& what, operators::command_kind which) {
  if (const auto heard = words_.heard_before(what, t.now.monotonic_ns))
    return answer(t, what, *heard);
  begin_word(t, what, said_by(what, which));
}

void core::begin_word(decision_context& t, const vehicle_role::order& what, const operators::command& command) {
  const auto now_ns = t.now.monotonic_ns;
  const auto reject_for_now = [&](const std::string& why) {
    refuse(t, what, mav_result::temporarily_rejected, name_for_people(what) + ": " + why);
  };
  const bool is_go_to = command.kind == operators::command_kind::go_to;
  if (!operators::is_stop(command.kind) && is_refused(t, what, is_go_to ? "Go to" : "Continue"))
    return;
  if (!has_executor_)
    return reject_for_now("no executor is there");
  if (!words_.may_begin(what.from, now_ns))
    return reject_for_now("another command is under way");
  t.done.emplace_back(word_to_say{words_.begin(what, now_ns), command});
}

effects core::on_word_answer(std::uint64_t request, const operators::answer& m, instant now) {
  decision_context t(*this, now);
  if (m.is_taken)
    end_word(t, request, mav_result::accepted, {});
  else
    end_word(t, request, mav_result::temporarily_rejected, m.reason.empty() ? "refused" : m.reason);
  finish(t);
  return std::move(t.done);
}

effects core::on_word_failed(std::uint64_t request, const std::string& reason, instant now) {
  decision_context t(*this, now);
  end_word(t, request, mav_result::temporarily_rejected, reason);
  finish(t);
  return std::move(t.done);
}

void core::end_word(decision_context& t, std::uint64_t request, mav_result result, const std::string& reason) {
  const auto asked = words_.resolve(request, result, t.now.monotonic_ns);
  if (!asked)
    return;
  tell_audit(t, asked->from, name_for_people(*asked), result == mav_result::accepted ? "taken" : "refused", reason);
  if (result == mav_result::accepted)
    answer(t, *asked, result);
  else
    refuse(t, *asked, result, name_for_people(*asked) + ": " + reason);
}

} // namespace godwit::ground_port
