#include "programs/godwitd/link_log/link_log.hpp"

#include <atomic>
#include <utility>

#include "io/time_units.hpp"

namespace godwit::daemon {

class link_log::link_tap final : public io::link::tap {
public:
  explicit link_tap(const runtime::time_source& time) : time_(time) {}

  void received(io::link::peer_id from, std::span<const std::byte> bytes, bool is_datagram) override {
    put({0, from, false, is_datagram}, bytes);
  }
  void sent(std::span<const std::byte> frame) override { put({0, 0, true, true}, frame); }

  void end() { is_open_.store(false); }
  [[nodiscard]] chunk_buffer& buffer() { return buffer_; }

private:
  void put(link_chunk chunk, std::span<const std::byte> bytes) {
    if (!is_open_.load(std::memory_order_relaxed))
      return;
    chunk.time_us = static_cast<std::uint64_t>(time_.wall_ns() / ns_per_us);
    (void)buffer_.put(chunk, bytes); // it counts what it drops
  }

  const runtime::time_source& time_;
  std::atomic<bool> is_open_{true};
  chunk_buffer buffer_;
};

link_log::link_log(const link_log_options& options, const runtime::time_source& time, runtime::health_board& health)
    : flush_(options.flush), time_(time), health_(health) {
  links_[0].name = "vehicle";
  links_[1].name = "ground";
  for (auto& each : links_)
    each.tap = std::make_shared<link_tap>(time);
}

tl::expected<std::unique_ptr<link_log>, std::string> link_log::open(const link_log_options& options, std::uint64_t run,
                                                                    const runtime::time_source& time,
                                                                    runtime::health_board& health) {
  std::unique_ptr<link_log> result(new link_log(options, time, health));
  for (auto& each : result->links_)
    if (const auto opened = each.recording.open(options, each.name, run); !opened)
      return tl::make_unexpected("the links can not be recorded: " + opened.error().message());
  return result;
}

std::shared_ptr<io::link::tap> link_log::tap(recorded_link which) {
  return links_.at(static_cast<std::size_t>(which)).tap;
}

void link_log::drain() {
  for (auto& each : links_) {
    each.tap->buffer().take(batch_);
    each.recording.take(batch_);
    each.recording.flush(time_.monotonic_ns());
  }
  tell_health();
}

void link_log::tell_health() {
  const auto now_ns = time_.monotonic_ns();
  std::string problem;
  for (auto& each : links_) {
    const auto dropped = each.tap->buffer().dropped();
    const auto unwritten = each.recording.counts().frames_lost;
    if (const auto lost = dropped + unwritten; std::exchange(each.lost, lost) != lost)
      lost_at_ns_ = now_ns;
    if (each.lost == 0 && each.recording.problem().empty())
      continue;
    problem += problem.empty() ? "" : "; ";
    problem += "the .tlog of the " + each.name + " link has lost " + std::to_string(unwritten) +
               " frames that the disk refused and " + std::to_string(dropped) + " pieces that came too fast for it";
    problem += each.recording.problem().empty() ? "" : ": " + each.recording.problem();
  }
  const bool is_quiet = links_[0].recording.problem().empty() && links_[1].recording.problem().empty() &&
                        now_ns - lost_at_ns_ >= quiet_ns;
  if (is_quiet)
    problem.clear();
  if (problem == told_)
    return;
  health_.post("link_log", problem.empty() ? runtime::health_colour::green : runtime::health_colour::yellow, problem);
  told_ = std::move(problem);
}

void link_log::start() {
  thread_ = std::thread([this] { run(); });
}

void link_log::run() {
  for (bool stopping = false; !stopping;) {
    {
      std::unique_lock guard(mutex_);
      stopping = wake_.wait_for(guard, flush_, [this] { return stopping_; });
    }
    drain();
  }
}

void link_log::close() {
  if (thread_.joinable()) {
    {
      const std::lock_guard guard(mutex_);
      stopping_ = true;
    }
    wake_.notify_one();
    thread_.join();
  }
  for (auto& each : links_) {
    each.tap->end();
    each.recording.close();
  }
}

} // namespace godwit::daemon
