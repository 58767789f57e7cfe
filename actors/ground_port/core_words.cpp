// The part of the core that is about words of operators. What an order means is in word_reading.hpp, what a repetition
// hears in word_ledger.hpp.
#include <optional>
#include <string>
#include <utility>

#include "actors/ground_port/core.hpp"
#include "actors/ground_port/turn.hpp"
#include "actors/ground_port/word_reading.hpp"

namespace godwit::ground_port {

using mavlink::mav_result;

std::optional<double> core::home_altitude_m() const {
  constexpr double mm_per_m = 1'000;
  const auto& home = gate_.newest(mavlink::home_position::message_id);
  if (!home)
    return std::nullopt;
  return std::get<mavlink::home_position>(*home).altitude / mm_per_m;
}

void core::say_word(turn& t, const vehicle_role::order& what) {
  const auto now_ns = t.now.monotonic_ns;
  if (const auto heard = words_.heard_before(what, now_ns))
    return answer(t, what, *heard);
  const auto word = read_word(what, home_altitude_m());
  if (!word)
    return refuse(t, what, word.error().result, word.error().text);
  const auto reject_for_now = [&](const std::string& why) {
    refuse(t, what, mav_result::temporarily_rejected, name_for_people(what) + ": " + why);
  };
  if (!has_executor_)
    return reject_for_now("no executor is there");
  if (!words_.may_begin(what.from, now_ns))
    return reject_for_now("another command is under way");
  t.done.emplace_back(word_to_say{words_.begin(what, now_ns), *word});
}

effects core::on_word_answer(std::uint64_t request, const operator_words::answer& m, instant now) {
  turn t(*this, now);
  if (m.is_taken)
    end_word(t, request, mav_result::accepted, {});
  else
    end_word(t, request, mav_result::temporarily_rejected, m.reason.empty() ? "refused" : m.reason);
  finish(t);
  return std::move(t.done);
}

effects core::on_word_failed(std::uint64_t request, const std::string& reason, instant now) {
  turn t(*this, now);
  end_word(t, request, mav_result::temporarily_rejected, reason);
  finish(t);
  return std::move(t.done);
}

void core::end_word(turn& t, std::uint64_t request, mav_result result, const std::string& reason) {
  const auto asked = words_.settle(request, result, t.now.monotonic_ns);
  if (!asked)
    return;
  if (result == mav_result::accepted)
    answer(t, *asked, result);
  else
    refuse(t, *asked, result, name_for_people(*asked) + ": " + reason);
}

} // namespace godwit::ground_port
