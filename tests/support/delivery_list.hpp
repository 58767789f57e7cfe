// The trace of a simulation as the deliveries that a reader would give, kept in memory. Thread: one.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <string>

#include "io/fields/binary.hpp"
#include "runtime/clock.hpp"
#include "runtime/directory.hpp"
#include "runtime/trace/reading/delivery.hpp"
#include "runtime/trace/trace_sink.hpp"

namespace godwit::tests {

class delivery_list final : public runtime::trace_sink {
public:
  struct kept {
    runtime::delivery what; // without its body
    std::string body;
  };

  // What follows is of this process. Both outlive its deliveries.
  void begin_process(const runtime::directory& directory, const runtime::time_source& time) {
    directory_ = &directory;
    time_ = &time;
    ++run_;
  }

  [[nodiscard]] std::int64_t ticks() const noexcept override { return time_->monotonic_ns(); }

  void record(const runtime::trace_entry& entry, const runtime::message_type& type,
              const void* body) noexcept override {
    kept each;
    each.what.run = run_;
    each.what.id = entry.id;
    each.what.cause = entry.cause;
    each.what.began_ns = entry.began + time_->wall_ns() - time_->monotonic_ns();
    each.what.duration_ns = entry.ended - entry.began;
    if (entry.clock_ns != 0) {
      each.what.clock_offset_ns = entry.clock_ns - entry.began;
      each.what.wall_offset_ns = entry.wall_ns - each.what.began_ns;
    }
    each.what.actor = names.number(directory_->name(entry.actor));
    each.what.sender = names.number(directory_->name(entry.sender));
    each.what.type = names.number(type.name);
    each.what.incarnation = entry.incarnation;
    each.what.how = entry.how;
    io::byte_sink sink(memory_);
    type.encode(sink, body);
    io::byte_source source(std::span<const std::byte>(memory_.data(), sink.used()));
    type.append_decoded(each.body, source);
    all.push_back(std::move(each));
  }

  // Hands those of RUN on, each with its body.
  template <class F>
  void for_each(std::uint64_t run, F take) const {
    for (const auto& each : all) {
      auto whole = each.what;
      whole.body = each.body;
      if (whole.run == run)
        take(whole);
    }
  }

  std::deque<kept> all;
  runtime::name_table names;

private:
  static constexpr std::size_t max_body_bytes = 64 * 1024; // as the trace of the daemon takes them
  const runtime::directory* directory_ = nullptr;
  const runtime::time_source* time_ = nullptr;
  std::uint64_t run_ = 0;
  std::array<std::byte, max_body_bytes> memory_{};
};

} // namespace godwit::tests
