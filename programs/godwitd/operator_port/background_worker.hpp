// A thread for requests that take longer than the port may be away from the others: reading a mission's file.
//
//   port's thread ──run(FROM, WORK)──> at most max_waiting, max_waiting_of_one from one address ──> one at a time
//
// What waits when it is destroyed is dropped, and the connections of its answers are reset. Source of the bound: 20
// clients with files of 1 MB kept a `pause` waiting for seven seconds while the port's own thread read them. Thread:
// run by any; WORK in the worker's own.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include <boost/asio/post.hpp>
#include <boost/asio/thread_pool.hpp>

namespace godwit::operator_port {

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

} // namespace godwit::operator_port
