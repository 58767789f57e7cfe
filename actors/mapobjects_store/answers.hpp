// From what the map says to what is answered. Thread: pure.
#pragma once

#include <type_traits>
#include <utility>
#include <variant>

#include "actors/mapobjects_store/error.hpp"
#include "messages/mapobjects_store/types.hpp"

namespace godwit::mapobjects_store {

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

} // namespace godwit::mapobjects_store
