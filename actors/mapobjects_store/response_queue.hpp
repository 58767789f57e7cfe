// Answers on their way from the writer's thread to the actor, in the order in which they became true.
//
// It outlives the incarnations of the actor. An answer that nobody waits for any more is dropped by whoever takes it.
// Thread: any.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

#include "actors/mapobjects_store/error.hpp"
#include "messages/mapobjects_store/types.hpp"

namespace godwit::mapobjects_store {

// From what the map says to what is answered. Thread: pure.

// All that an ask can be answered with.
using any_answer = std::variant<sighting_answer, pass_answer, verdict_answer, map_answer, load_answer, batch,
                                open_batches, moved_rows, owed_list, map_status, shown_objects>;

[[nodiscard]] map_failure failure_of(map_errc code);

// EMPTY with why it was not done.
template <class Answer>
[[nodiscard]] Answer refusal(Answer empty, const map_error& why) {
  empty.failure = failure_of(why.code);
  empty.error = why.message();
  return empty;
}

// FILL(Answer&, value) puts what was found into EMPTY; for a result without a value FILL(Answer&).
template <class Answer, class Value, class Fill>
[[nodiscard]] Answer answer_from(Answer empty, const map_result<Value>& done, const Fill& fill) {
  if (!done)
    return refusal(std::move(empty), done.error());
  if constexpr (std::is_void_v<Value>)
    fill(empty);
  else
    fill(empty, *done);
  return empty;
}

struct ready_answer {
  std::uint64_t request_id = 0; // 0 = the actor's own question
  any_answer what;
};

class response_queue {
public:
  // Asks that were handed over and whose answer was not taken yet. The writer's own queue is as long.
  static constexpr std::size_t max_asks = 10'000;

  // Before an ask is handed over; false: there are max_asks.
  [[nodiscard]] bool reserve();
  // It was not taken after all.
  void give_back();

  // True when the box was empty: whoever takes has to be woken.
  [[nodiscard]] bool put(ready_answer answer);

  [[nodiscard]] std::optional<ready_answer> take();

private:
  std::mutex mutex_;
  std::size_t asks_ = 0;
  std::deque<ready_answer> answers_;
};

} // namespace godwit::mapobjects_store
