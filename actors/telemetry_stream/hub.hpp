// Who subscribes, and what is on its way to each: a text is made once, and shared by all who want its topic.
//
//   telemetry_stream, log ──publish──> hub ──> subscriber: queue ──take──> its reader (a WebSocket, a test)
//                                       │└──> subscriber: queue ──take──> its reader
//                                   the newest text of each topic, for who comes later
//
// A subscriber hears what the stream is, then the newest text of each of its topics, then all changes, in one order.
// Two bounded queues: of data the oldest are dropped, counted by topic, and the reader is told how many before it hears
// more; of what must not be missed (flight, authority, progress) nothing is dropped: when that queue is full the
// subscriber is ended, and has to begin anew. So a slow reader costs memory up to the bounds and nobody else anything.
//
// A text is a JSON object: {"topic":"position","number":17,"at_ms":...,"data":{...}}. `number` rises by one with each
// text of all topics.
//
// Thread: any. What subscribe() was given is called in the publisher's thread when there is something to take after
// there was nothing; it must be quick and not come back here.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "messages/telemetry_stream/types.hpp"

namespace godwit::telemetry_stream {

using text_ptr = std::shared_ptr<const std::string>;

// Nothing of it may be missed.
[[nodiscard]] constexpr bool must_arrive(topic what) {
  return what == topic::flight || what == topic::authority || what == topic::progress;
}

struct wanted_topic {
  topic what = topic::clock;
  std::int64_t interval_ns = 0; // at the least between two texts of it; of data only
};

struct queue_bounds {
  std::size_t max_data = 64; // texts
  std::size_t max_data_bytes = 256 * 1024;
  std::size_t max_events = 256; // texts that must not be missed
  std::size_t max_event_bytes = 512 * 1024;
};

using topic_counts = std::array<std::uint64_t, topic_count>;

struct hub_counts {
  std::uint64_t subscribers = 0; // now
  std::uint64_t ended = 0;       // because they were too slow
  topic_counts published{};
  topic_counts dropped{}; // of all queues together
};

class hub;

class subscriber {
public:
  // The next text; null: there is none now.
  [[nodiscard]] text_ptr take();
  // It was too slow for what must not be missed: nothing comes any more.
  [[nodiscard]] bool has_ended() const;
  [[nodiscard]] topic_counts dropped() const;
  [[nodiscard]] std::size_t waiting_bytes() const;

private:
  friend class hub;
  struct entry {
    std::uint64_t number = 0;
    topic what = topic::clock;
    text_ptr text;
  };
  struct queue {
    std::deque<entry> texts;
    std::size_t bytes = 0;
  };
  struct interest {
    bool is_wanted = false;
    std::int64_t interval_ns = 0;
    std::int64_t next_ns = 0;
  };

  subscriber(const queue_bounds& bounds, std::function<void()> on_ready);
  // True: the reader has to be told.
  [[nodiscard]] bool put(const entry& each, std::int64_t now_ns, hub_counts& counts);
  [[nodiscard]] static entry pop(queue& from);

  const queue_bounds bounds_;
  const std::function<void()> on_ready_;
  mutable std::mutex mutex_; // over all that follows
  std::array<interest, topic_count> wants_{};
  queue data_;
  queue events_;
  topic_counts dropped_{};
  topic_counts told_{}; // of these
  bool has_drops_ = false;
  bool is_told_ = false; // that there is something to take
  bool has_ended_ = false;
};

class hub {
public:
  static constexpr std::size_t max_subscribers = 1024;

  // SESSION: another one for each process, so that a client sees that it has to forget what it has heard.
  explicit hub(std::uint64_t session = 0) : session_(session) {}

  // DATA: a JSON value. NOW_NS: monotonic. Returns the text.
  text_ptr publish(topic what, const std::string& data, std::int64_t wall_ms, std::int64_t now_ns);

  // The error is a sentence. It stays until it is let go of.
  [[nodiscard]] tl::expected<std::shared_ptr<subscriber>, std::string>
  subscribe(const std::vector<wanted_topic>& wanted, std::function<void()> on_ready, const queue_bounds& bounds = {});

  [[nodiscard]] hub_counts counts() const;

private:
  void greet(subscriber& who);

  const std::uint64_t session_;
  mutable std::mutex mutex_; // over all that follows
  std::vector<std::weak_ptr<subscriber>> subscribers_;
  std::array<subscriber::entry, topic_count> newest_{};
  std::uint64_t number_ = 0;
  hub_counts counts_;
};

} // namespace godwit::telemetry_stream
