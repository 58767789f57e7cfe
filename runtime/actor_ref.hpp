// A counted reference to an actor: to a stable address where others hold it. The typed handles of seam.hpp are made of
// it, and so nobody outside of runtime/ sees CAF. Thread: a value; copies may go to any thread.
#pragma once

#include <cstddef>
#include <utility>

namespace caf {
class actor_control_block;
}

namespace godwit::runtime {

class actor_ref {
public:
  actor_ref() = default;
  explicit actor_ref(caf::actor_control_block* actor); // takes a share of it
  actor_ref(const actor_ref& other);
  actor_ref(actor_ref&& other) noexcept : actor_(std::exchange(other.actor_, nullptr)) {}
  actor_ref& operator=(actor_ref other) noexcept {
    std::swap(actor_, other.actor_);
    return *this;
  }
  ~actor_ref();

  [[nodiscard]] caf::actor_control_block* get() const { return actor_; }
  explicit operator bool() const { return actor_ != nullptr; }
  friend bool operator==(const actor_ref&, const actor_ref&) = default;

private:
  caf::actor_control_block* actor_ = nullptr;
};

} // namespace godwit::runtime
