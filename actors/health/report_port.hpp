// Where the health actor leaves what it has seen, for readers outside of the actors: the newest health and the newest
// report.
//
//   health actor ──show, publish──> report_port <──newest_health, newest── thread of the operator's port
//
// It outlives the incarnations of the actor. Thread: any; what on_published was given is called in the actor's thread,
// and must be quick and not come back here.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

#include "actors/health/report.hpp"

namespace godwit::health {

class report_port {
public:
  struct seen_health {
    std::int64_t at_ns = 0; // monotonic; 0: never
    health_status status;
  };

  void show(const health_status& status, std::int64_t at_ns) {
    const std::lock_guard guard(mutex_);
    seen_ = {at_ns, status};
  }

  void publish(report made) {
    auto shared = std::make_shared<const report>(std::move(made));
    std::function<void()> tell;
    {
      const std::lock_guard guard(mutex_);
      newest_ = std::move(shared);
      tell = on_published_;
    }
    if (tell)
      tell();
  }

  [[nodiscard]] seen_health newest_health() const {
    const std::lock_guard guard(mutex_);
    return seen_;
  }
  // Null: there is none yet.
  [[nodiscard]] std::shared_ptr<const report> newest() const {
    const std::lock_guard guard(mutex_);
    return newest_;
  }
  // Empty: nobody is told any more.
  void on_published(std::function<void()> tell) {
    const std::lock_guard guard(mutex_);
    on_published_ = std::move(tell);
  }

private:
  mutable std::mutex mutex_; // over all
  seen_health seen_;
  std::shared_ptr<const report> newest_;
  std::function<void()> on_published_;
};

} // namespace godwit::health
