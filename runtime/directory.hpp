// Names of the stable addresses by their number, for the trace and for the journal. Number 0 is "outside".
// Grows while addresses are made, never shrinks. Thread: any.
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>

namespace godwit::runtime {

class directory {
public:
  static constexpr std::uint32_t max_addresses = 4096; // bounded by the bits that a message id has for it

  std::uint32_t add(std::string name) {
    const std::lock_guard guard(mutex_);
    names_.push_back(std::move(name));
    return static_cast<std::uint32_t>(names_.size() - 1);
  }

  // The reference stays good for ever. Unknown numbers are "unknown".
  [[nodiscard]] const std::string& name(std::uint32_t number) const {
    static const std::string unknown = "unknown";
    const std::lock_guard guard(mutex_);
    return number < names_.size() ? names_[number] : unknown;
  }

  // The address of that name; nothing when there is none in this process.
  [[nodiscard]] std::optional<std::uint32_t> number(const std::string& name) const {
    const std::lock_guard guard(mutex_);
    for (std::uint32_t i = 0; i < names_.size(); ++i)
      if (names_[i] == name)
        return i;
    return std::nullopt;
  }

private:
  mutable std::mutex mutex_;
  std::deque<std::string> names_{"outside"};
};

} // namespace godwit::runtime
