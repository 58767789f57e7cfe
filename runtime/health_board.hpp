// Worst-of health: each component posts its colour and a sentence, the board tells the worst. Green components may be
// absent. Thread: any.
#pragma once

#include <algorithm>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "runtime/condition.hpp"

namespace godwit::runtime {

struct health_entry {
  std::string component;
  health_colour colour = health_colour::green;
  std::string reason;
};

class health_board {
public:
  void post(const std::string& component, health_colour colour, std::string reason) {
    const std::lock_guard guard(mutex_);
    entries_[component] = {component, colour, std::move(reason)};
  }

  [[nodiscard]] health_colour worst() const {
    const std::lock_guard guard(mutex_);
    auto result = health_colour::green;
    for (const auto& [name, entry] : entries_)
      result = std::max(result, entry.colour);
    return result;
  }

  [[nodiscard]] std::vector<health_entry> entries() const {
    const std::lock_guard guard(mutex_);
    std::vector<health_entry> result;
    for (const auto& [name, entry] : entries_)
      result.push_back(entry);
    return result;
  }

private:
  mutable std::mutex mutex_;
  std::map<std::string, health_entry> entries_;
};

} // namespace godwit::runtime
