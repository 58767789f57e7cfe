// The real map without its thread: what is handed over waits until the test lets it happen, one after the other. It
// outlives the incarnations of the actor, as the writer does. Thread: the test's.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "actors/mapobjects_store/map_access.hpp"
#include "runtime/assert.hpp"

namespace godwit::drill {

class stepped_map final : public mapobjects_store::map_access {
public:
  explicit stepped_map(const std::string& file) {
    auto opened = mapobjects_store::map_store::open({.file = {.path = file}, .rules = {}});
    GODWIT_ASSERT(opened.has_value(), "drill: the map opens");
    store_ = std::move(*opened);
  }

  [[nodiscard]] mapobjects_store::map_result<void> push(mapobjects_store::queued_work item) override {
    waiting_.push_back(std::move(item));
    return {};
  }
  [[nodiscard]] mapobjects_store::map_writer_status status() const override { return status_; }

  // False: nothing waits.
  bool step() {
    if (waiting_.empty())
      return false;
    auto item = std::move(waiting_.front());
    waiting_.pop_front();
    ++status_.changes;
    if (auto* change = std::get_if<mapobjects_store::queued_change>(&item))
      change->done(store_->transact(change->work));
    else if (auto job = std::get<mapobjects_store::queued_job>(item).start(*store_))
      static_cast<void>(store_->run(*job)); // it tells its asker itself
    return true;
  }

  void fail(const std::string& reason) {
    status_.failing = !reason.empty();
    status_.reason = reason;
  }

  [[nodiscard]] mapobjects_store::map_store& store() { return *store_; }

private:
  std::unique_ptr<mapobjects_store::map_store> store_;
  std::deque<mapobjects_store::queued_work> waiting_;
  mapobjects_store::map_writer_status status_;
};

} // namespace godwit::drill
