// What a group_writer writes to, and what its items are: writes, which share a transaction, and barriers, which stand
// between groups and run when all that came before them is durable.
//
// Thread: the writer's.
#pragma once

#include <cstddef>
#include <functional>

#include "io/sqlite/store_error.hpp"
#include "io/sqlite/work_queue.hpp"

namespace godwit::io::sqlite {

template <class Item>
class group_target {
public:
  using backlog = typename work_queue<Item>::backlog;

  group_target() = default;
  group_target(const group_target&) = delete;
  group_target& operator=(const group_target&) = delete;
  virtual ~group_target() = default;

  [[nodiscard]] virtual bool is_write(const Item& item) const = 0;
  // It has just come into the backlog. Setting `failed` lets it share the fate of an earlier one.
  virtual void arrived(queued<Item>&) {}

  // One transaction. It may be rolled back and run again, with fewer items in it. An error of `apply` that may not pass
  // says that this item can never commit; an item that refuses itself before it has written anything returns success
  // and keeps its refusal.
  [[nodiscard]] virtual store_result<void> begin() = 0;
  [[nodiscard]] virtual store_result<void> apply(Item& item) = 0;
  [[nodiscard]] virtual store_result<void> commit() = 0;
  virtual void roll_back() = 0;

  // Whether the same may work later: then it is tried again for ever.
  [[nodiscard]] virtual bool may_pass(const store_error& error) const { return sqlite::may_pass(error.code); }
  // The item at AT has failed for ever; what builds on it fails with it by setting its `failed`.
  virtual void failed(backlog&, std::size_t /*at*/) {}

  // Once for each write: it is durable, or never will be.
  virtual void finish(Item& write, const store_result<void>& result) = 0;

  virtual void run(Item& barrier) = 0;
  // While the disk fails. True: the barrier at AT did not need what stands before it to be durable, and has run.
  virtual bool run_early(backlog&, std::size_t /*at*/) { return false; }

  // The writer closes with this undone; the error is the last one of the disk, if it fails.
  virtual void give_up(Item& item, const std::optional<store_error>& why) = 0;

  // Long work of the target's own, one transaction at a time, when no item waits (and now and then when one always
  // does). URGENT turns true when an item arrives. True: committed; an error: the disk failed, the same turn comes
  // again.
  [[nodiscard]] virtual bool has_turn() { return false; }
  [[nodiscard]] virtual store_result<bool> take_turn(const std::function<bool()>& /*urgent*/) { return false; }

  // Between transactions, while the disk works. BUSY: items wait.
  virtual void look_after_log(bool busy) = 0;

  // At most once a look_period: is the file still what it was? An error lasts until the target itself has mended it,
  // and begin() fails with it meanwhile.
  [[nodiscard]] virtual store_result<void> look_at_file() { return {}; }

  // The last call.
  virtual void close() = 0;
};

} // namespace godwit::io::sqlite
