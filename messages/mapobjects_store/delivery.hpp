// What is owed to the missions service, handed over in batches. Thread: plain values.
//
// Who delivers makes a key (a UUID) for a batch and keeps it, asks for the rows with take_batch, tells the service
// under that same key, and says batch_delivered when the service has answered. Whoever crashed in between finds its
// keys with get_batches and asks again: a key that is not delivered has the same rows in the same order for ever,
// because the service refuses a known key with another body. So nothing is lost, and nothing counts twice.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "messages/mapobjects_store/answer.hpp"
#include "messages/mapobjects_store/observation.hpp"

namespace godwit::mapobjects_store {

// Each has an endpoint, and so a queue, of its own.
enum class destination { observations, ignored_items };

GODWIT_ENUM_NAMES(destination, observations, ignored_items);

// Of a row.
//
//               take_batch          batch_delivered
//   [pending] ─────────────> [taken] ─────────────> [delivered]
//     ^  ^ │                 │  │                        ^
//     │  └─────return_batch──┘  │                        │
//     │    └── the mission ─────┤                        │ batch_delivered
//     │        is gone          v                        │
//     └─ requeue_mission ── [orphaned] ──────────────────┘
//        (without a batch), return_batch
enum class delivery_state { pending, taken, delivered, orphaned };

GODWIT_ENUM_NAMES(delivery_state, pending, taken, delivered, orphaned);

// Answered with a batch. A key that is not known yet takes the oldest pending rows of the mission; where there are none
// the batch is empty and the key stays unknown. Busy: max_open_batches are taken.
struct take_batch {
  std::string key; // UUID, made by the asker
  std::string mission_id;
  destination to = destination::observations;
  std::uint32_t limit = 0; // of a new batch, at most 1000; a known one is given whole
  GODWIT_FIELDS(take_batch, "mapobjects_store.take_batch", key, mission_id, to, limit);
};

struct batch {
  std::string key;
  std::string mission_id;
  destination to = destination::observations;
  std::vector<observation> observations; // in the order in which they were made; empty for ignored items
  std::vector<ignored_item> ignored_items;
  std::uint64_t pending_left = 0; // of this mission and destination, after this batch
  map_failure failure = map_failure::none;
  std::string error;
  GODWIT_FIELDS(batch, "mapobjects_store.batch", key, mission_id, to, observations, ignored_items, pending_left,
                failure, error);
};

// Answered with open_batches: what was taken and not delivered, by whichever asker.
struct get_batches {
  static constexpr auto fields = io::table("mapobjects_store.get_batches");
};

struct open_batch {
  std::string key;
  std::string mission_id;
  destination to = destination::observations;
  std::uint64_t rows = 0;
  bool orphaned = false; // the mission is gone; the batch is delivered only when a person says so
  GODWIT_FIELDS(open_batch, "mapobjects_store.open_batch", key, mission_id, to, rows, orphaned);
};

struct open_batches {
  std::vector<open_batch> batches; // oldest first
  map_failure failure = map_failure::none;
  std::string error;
  GODWIT_FIELDS(open_batches, "mapobjects_store.open_batches", batches, failure, error);
};

// Answered with map_answer. The rows of the batch leave the queue, and the orphans too. A key that is not known (any
// more) is a repetition.
struct batch_delivered {
  std::string key;
  GODWIT_FIELDS(batch_delivered, "mapobjects_store.batch_delivered", key);
};

// Answered with map_answer. The service will not have the batch under this key: its rows are pending again, orphans
// too, and can be taken under other keys, in smaller batches. The key counts as delivered. One that is not known (any
// more) is a repetition.
struct return_batch {
  std::string key;
  GODWIT_FIELDS(return_batch, "mapobjects_store.return_batch", key);
};

// Answered with owed_list.
struct get_owed {
  static constexpr auto fields = io::table("mapobjects_store.get_owed");
};

// What waits for one mission: rows that are neither delivered nor orphaned, and the orphans.
struct owed {
  std::string mission_id;
  destination to = destination::observations;
  std::uint64_t pending = 0;
  std::uint64_t taken = 0;
  std::uint64_t orphaned = 0;
  GODWIT_FIELDS(owed, "mapobjects_store.owed", mission_id, to, pending, taken, orphaned);
};

struct owed_list {
  std::vector<owed> missions; // one for each mission and destination that has something
  map_failure failure = map_failure::none;
  std::string error;
  GODWIT_FIELDS(owed_list, "mapobjects_store.owed_list", missions, failure, error);
};

} // namespace godwit::mapobjects_store
