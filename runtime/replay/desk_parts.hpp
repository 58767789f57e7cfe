// The private parts of the desk: its time, disk and record. For runtime/replay alone.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "runtime/internal_messages.hpp"
#include "runtime/replay/desk.hpp"

namespace godwit::runtime {

class desk_time final : public time_source {
public:
  void set(const desk_moment& to) { now_ = to; }
  [[nodiscard]] std::int64_t monotonic_ns() const noexcept override { return now_.monotonic_ns; }
  [[nodiscard]] std::int64_t wall_ns() const noexcept override { return now_.wall_ns; }

private:
  desk_moment now_;
};

// Takes every write, keeps none, and never says that one is on the disk: the record does.
class desk_journal final : public journal {
public:
  explicit desk_journal(std::uint64_t run) : run_(run) {}
  [[nodiscard]] tl::expected<void, journal_error> submit(journal_write&& write) override {
    const auto taken = std::exchange(write, {});
    return {};
  }
  void recover(std::string, std::uint64_t, recovered_callback) override {}
  [[nodiscard]] journal_status status() const override {
    journal_status result;
    result.run = run_;
    return result;
  }

private:
  const std::uint64_t run_;
};

// How handlers ended.
class desk_record final : public trace_sink {
public:
  [[nodiscard]] std::int64_t ticks() const noexcept override { return 0; }
  void record(const trace_entry& entry, const message_type& type, const void*) noexcept override {
    if (&type != &type_of<restored>())
      handled_.push_back({entry.id, type.name, entry.how});
  }
  [[nodiscard]] std::vector<desk_handling> take() { return std::exchange(handled_, {}); }

private:
  std::vector<desk_handling> handled_;
};

} // namespace godwit::runtime
