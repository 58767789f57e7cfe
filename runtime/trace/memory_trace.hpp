// A trace in memory: lines of text, for tests that compare runs or ask what an actor did. Thread: one.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "io/fields/binary.hpp"
#include "runtime/clock.hpp"
#include "runtime/directory.hpp"
#include "runtime/trace/trace_sink.hpp"

namespace godwit::runtime {

class memory_trace final : public trace_sink {
public:
  memory_trace(const directory& names, const time_source& time) : names_(names), time_(time) {}

  [[nodiscard]] std::int64_t ticks() const noexcept override { return time_.monotonic_ns(); }

  // One line: "1200 ns counter/2 <- outside #17 because #3 add{"by":1} crashed"
  void record(const trace_entry& entry, const message_type& type, const void* body) noexcept override {
    std::array<std::byte, 4096> memory{};
    io::byte_sink sink(memory);
    type.encode(sink, body);
    io::byte_source source(std::span<const std::byte>(memory.data(), sink.used()));
    std::string line = std::to_string(entry.began) + " ns " + names_.name(entry.actor) + '/' +
                       std::to_string(entry.incarnation) + " <- " + names_.name(entry.sender) + " #" +
                       std::to_string(entry.id) + " because #" + std::to_string(entry.cause) + ' ' +
                       std::string(type.name);
    type.append_decoded(line, source);
    line += ' ';
    line += io::name_of(entry.how);
    lines_.push_back(std::move(line));
  }

  [[nodiscard]] const std::vector<std::string>& lines() const { return lines_; }

private:
  const directory& names_;
  const time_source& time_;
  std::vector<std::string> lines_;
};

} // namespace godwit::runtime
