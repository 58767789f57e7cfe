// Missions from a browser: POST /api/v1/missions and /api/v1/missions/check, with the text of the file as the body
// (application/octet-stream) and ?format=json, plan, waypoints, geojson or kml; &partial=yes takes what can be taken.
//
//   check: {"mission": ..., "losses": [{"item", "what", "why", "instead", "line"}]}, or 422 with all that is wrong
//   else: the same, and then it goes to mission_handler, which says whether it is taken
//
// It may hold the commands that are ALLOWED as well. The file is read by RUN, beside the thread of the port; where too
// many wait, the answer is 503. Errors: problem documents. Thread: the handlers in that of the port, TELL in that of
// RUN.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include <boost/asio/post.hpp>
#include <boost/asio/thread_pool.hpp>

#include "actors/domain/mission/commands/command_policy.hpp"
#include "programs/godwitd/operator_port/mission_handler.hpp"
#include "programs/godwitd/operator_port/router.hpp"

namespace godwit::operator_port {

// A thread for requests that take longer than the port may be away from the others: reading a mission's file.
//
//   port's thread ──run(FROM, WORK)──> at most max_waiting, max_waiting_of_one from one address ──> one at a time
//
// What waits when it is destroyed is dropped, and the connections of its answers are reset. Source of the bound: 20
// clients with files of 1 MB kept a `pause` waiting for seven seconds while the port's own thread read them. Thread:
// run by any; WORK in the worker's own.

// False: too many wait; WORK is not run.
using run_in_background = std::function<bool(const std::string& from, std::function<void()> work)>;

class background_worker {
public:
  static constexpr std::size_t max_waiting = 8; // and under way; each may hold a file of 1 MiB
  static constexpr std::size_t max_waiting_of_one = 2;

  [[nodiscard]] bool run(const std::string& from, std::function<void()> work) {
    {
      const std::lock_guard guard(mutex_);
      const auto its = of_each_.find(from);
      if (waiting_ >= max_waiting || (its != of_each_.end() && its->second >= max_waiting_of_one))
        return false;
      ++waiting_;
      ++of_each_[from];
    }
    boost::asio::post(thread_, [this, from, work = std::move(work)] {
      work();
      leave(from);
    });
    return true;
  }

  ~background_worker() {
    thread_.stop();
    thread_.join();
  }

private:
  void leave(const std::string& from) {
    const std::lock_guard guard(mutex_);
    --waiting_;
    const auto its = of_each_.find(from);
    if (--its->second == 0)
      of_each_.erase(its);
  }

  std::mutex mutex_; // over the next two
  std::size_t waiting_ = 0;
  std::map<std::string, std::size_t> of_each_; // those that have any
  boost::asio::thread_pool thread_{1};
};

inline constexpr std::size_t max_mission_file = 1024 * 1024; // bytes: some thousand items

[[nodiscard]] route_list mission_routes(const std::shared_ptr<waiting_answers>& answers,
                                        const std::function<void(mission_upload asked)>& tell,
                                        const run_in_background& run, const mission::allowed_commands& allowed = {});

} // namespace godwit::operator_port
