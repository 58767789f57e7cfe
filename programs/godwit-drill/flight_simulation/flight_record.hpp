// What the actors of a flight did, over all of its processes: each delivery is held against the promises of invariants/
// as it happens. None is kept but in a trace, where one is asked for. Times are those of the flight. Thread: the
// flight's.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "invariants/checker.hpp"
#include "messages/mission/document.hpp"
#include "programs/godwit-sim/vehicle/vehicle.hpp"
#include "runtime/clock.hpp"
#include "runtime/directory.hpp"
#include "runtime/health_board.hpp"
#include "runtime/trace/trace_renderer.hpp"
#include "runtime/trace/trace_sink.hpp"

namespace godwit::drill {

class flight_record final : public runtime::trace_sink {
public:
  // What follows is of another process, with that seed. Both others outlive it.
  void begin_process(const runtime::directory& names, const runtime::time_source& time, std::uint64_t seed);
  // The second report to mission_client is left out, so that the promises are seen to be looked for.
  void forget_second_report() { reports_until_forgotten_ = 2; }

  // What they do is also written into this folder, as the trace of the daemon; each process is a run. Before the first.
  void keep_trace(std::filesystem::path folder) { trace_folder_ = std::move(folder); }

  // LISTEN hears of each delivery, too; its run counts processes, and its time is since 1970. Before the first.
  using listener = std::function<void(const runtime::delivery& each)>;
  void tell(listener listen) { listen_ = std::move(listen); }
  [[nodiscard]] runtime::name_table& names() { return names_; }

  [[nodiscard]] std::int64_t ticks() const noexcept override { return time_->monotonic_ns(); }
  void record(const runtime::trace_entry& entry, const runtime::message_type& type, const void* body) noexcept override;

  // What is not kept, as sentences; empty: all is.
  [[nodiscard]] std::vector<std::string> broken() const;
  // The newest incarnation of ACTOR that has taken a message in this process; 0: none has.
  [[nodiscard]] std::uint32_t incarnation_of(const std::string& actor) const;
  [[nodiscard]] std::uint64_t deliveries() const { return deliveries_; }
  // Of the process RUN, counted from 1.
  [[nodiscard]] std::uint64_t seed_of(std::uint64_t run) const { return seeds_.at(run - 1); }

private:
  static constexpr std::size_t max_body_bytes = runtime::ring_trace::max_payload;

  void open_trace(const runtime::directory& names, const runtime::time_source& time);

  const runtime::directory* directory_ = nullptr;
  const runtime::time_source* time_ = nullptr;
  std::int64_t wall_offset_ns_ = 0; // fixed for a process, as in the trace of the daemon
  std::uint64_t run_ = 0;
  std::vector<std::uint64_t> seeds_; // of the processes
  std::uint64_t deliveries_ = 0;
  int reports_until_forgotten_ = 0; // 0: none is
  runtime::name_table names_;
  invariants::checker checker_;
  std::array<std::byte, max_body_bytes> memory_{};
  std::string text_;
  std::map<std::string, std::uint32_t> incarnations_;
  listener listen_;
  std::filesystem::path trace_folder_; // empty: none is kept
  runtime::health_board trace_health_;
  std::unique_ptr<runtime::trace_renderer> trace_; // of the process that runs
};

// Where the vehicle of a flight was, ten times a second: what reports are held against. Thread: one.
class flight_track {
public:
  static constexpr std::int64_t look_every_ns = 100'000'000;

  [[nodiscard]] bool is_due(std::int64_t now_ns) const { return now_ns >= next_look_ns_; }
  void look(const sim::vehicle& vehicle, std::int64_t now_ns);
  // It came so near to WHERE, heights apart, by UPTO_NS.
  [[nodiscard]] bool was_near(const mission::position& where, double metres, std::int64_t upto_ns) const;

private:
  struct place {
    std::int64_t at_ns = 0;
    double latitude_deg = 0;
    double longitude_deg = 0;
  };
  std::vector<place> places_;
  std::int64_t next_look_ns_ = 0;
};

} // namespace godwit::drill
