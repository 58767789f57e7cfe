// Turns recorded deliveries into JSON messages of MCAP segments. The slow half of the trace; runs on the writer thread.
// Thread: one, except counts().
#pragma once

#include <atomic>
#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>

#include <tl/expected.hpp>

#include "io/mcap/rotating_writer.hpp"
#include "runtime/trace/ring_trace.hpp"

namespace godwit::runtime {

// How records that were not kept appear in the trace: totals since the start of the process.
struct trace_loss {
  std::uint64_t dropped = 0;   // a ring was full
  std::uint64_t unwritten = 0; // the disk refused
  GODWIT_FIELDS(trace_loss, "runtime.trace_loss", dropped, unwritten);
};

class trace_renderer {
public:
  static constexpr std::int64_t removed_shown_ns = 60'000'000'000; // a person has to see it

  // SCALE: of the ticks in the entries.
  [[nodiscard]] static tl::expected<std::unique_ptr<trace_renderer>, std::string>
  open(trace_options options, const directory& names, const time_source& time, health_board& health,
       tick_scale scale = tick_scale());

  void write(const trace_entry& entry, const message_type& type, std::span<const std::byte> payload, bool oversize);
  // The total of records that never reached this place; a change is written into the trace.
  void note_dropped(std::uint64_t total);
  void tick(); // flush, and retry after a failure of the disk
  void close();
  [[nodiscard]] trace_counts counts() const; // written and unwritten only; any thread

private:
  struct channel_key {
    std::uint32_t actor;
    const message_type* type;
    bool operator==(const channel_key&) const = default;
  };
  struct channel_hash {
    std::size_t operator()(const channel_key& key) const {
      return std::hash<const void*>{}(key.type) * 31U + key.actor;
    }
  };
  struct channel {
    io::mcap::channel_id id{};
    std::uint32_t sequence = 0;
  };

  trace_renderer(const directory& names, const time_source& time, health_board& health, tick_scale scale)
      : names_(names), time_(time), health_(health), scale_(scale),
        wall_offset_ns_(time.wall_ns() - time.monotonic_ns()) {}
  channel* channel_for(const trace_entry& entry, const message_type& type);
  void render(const trace_entry& entry, const message_type& type, std::span<const std::byte> payload, bool oversize);
  void append_clocks(const trace_entry& entry);
  [[nodiscard]] const std::string& quoted_name(std::uint32_t actor); // as a JSON text
  void check(const io::mcap::result<void>& result);
  void show_removed();
  void publish_counts();

  const directory& names_;
  const time_source& time_;
  health_board& health_;
  tick_scale scale_;
  const std::int64_t wall_offset_ns_; // fixed for the run: the trace's time never goes back
  io::mcap::rotating_writer writer_;
  std::unordered_map<channel_key, channel, channel_hash> channels_;
  std::deque<std::string> quoted_names_; // by number; names never change once they are given
  std::string text_;                     // of the message being rendered; kept for its capacity
  trace_loss told_;
  bool failing_ = false;
  std::optional<std::int64_t> removed_ns_; // monotonic: that it was removed under way is still shown
  std::uint64_t given_ = 0;                // to the writer, whatever became of them
  std::uint64_t without_channel_ = 0;      // not even that: the file could hold no more channels
  std::atomic<std::uint64_t> written_{0};
  std::atomic<std::uint64_t> unwritten_{0};
};

} // namespace godwit::runtime
