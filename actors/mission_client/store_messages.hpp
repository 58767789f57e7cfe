// What mission_client asks of the map store, and what it hears. Thread: plain values.
#pragma once

#include <string>
#include <variant>

#include "messages/mapobjects_store/types.hpp"

namespace godwit::mission_client {

namespace store = mapobjects_store;

using store_question = std::variant<store::choose_mission, store::begin_load, store::load_page, store::finish_load,
                                    store::pull_failed, store::acknowledge_fallback, store::get_map, store::take_batch,
                                    store::batch_delivered, store::return_batch, store::get_batches, store::get_owed,
                                    store::delete_mission, store::orphan_mission, store::requeue_mission>;

// It did not answer, or nobody knows what it did: the same is asked again.
struct store_silent {
  std::string why; // sentence for people
};

using store_answer = std::variant<store_silent, store::map_answer, store::load_answer, store::batch,
                                  store::open_batches, store::owed_list, store::moved_rows, store::map_status>;

// Why it was not done; none: it was. An answer that does not come is `busy`: the same may go well later.
[[nodiscard]] inline store::map_failure failure_of(const store_answer& answer) {
  return std::visit(
      []<class T>(const T& each) {
        if constexpr (std::is_same_v<T, store_silent>)
          return store::map_failure::busy;
        else
          return each.failure;
      },
      answer);
}

[[nodiscard]] inline std::string sentence_of(const store_answer& answer) {
  return "the map store: " + std::visit(
                                 []<class T>(const T& each) {
                                   if constexpr (std::is_same_v<T, store_silent>)
                                     return each.why;
                                   else
                                     return each.error;
                                 },
                                 answer);
}

} // namespace godwit::mission_client
