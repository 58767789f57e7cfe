// A wire that is a real link: what comes in is queued, and whoever takes it is woken when there was nothing before.
//
// It outlives the incarnations of the actor that uses it, so that a crash of the actor closes no line. Close it before
// what WAKE reaches is gone. Errors: open, as open_link. Thread: set_tap, open and close by the owner; the rest from
// any; WAKE is called in the link's own thread.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include <tl/expected.hpp>

#include "io/link/wire.hpp"

namespace godwit::io::link {

class line : public wire {
public:
  // From the next open on, all that goes in and out is shown to this, too.
  void set_tap(std::shared_ptr<tap> recording) { tap_ = std::move(recording); }
  [[nodiscard]] tl::expected<void, std::string> open(const uri& where, const link_options& options,
                                                     const std::function<void()>& wake);
  void close();

  bool send(std::span<const std::byte> frame, peer_id to) override;
  [[nodiscard]] link_counters counters() const;
  [[nodiscard]] std::string description() const;

private:
  [[nodiscard]] std::shared_ptr<link> current() const;

  std::shared_ptr<tap> tap_; // none: nobody listens
  mutable std::mutex mutex_; // guards the pointer to the link only
  std::shared_ptr<link> link_;
};

} // namespace godwit::io::link
