// Names of actors and message types as numbers, so that millions of deliveries are told apart without comparing text.
// Numbers count from 0 in the order of their first use, and stay. Thread: one at a time.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>

namespace godwit::runtime {

class name_table {
public:
  std::uint32_t number(std::string_view name) {
    if (const auto found = numbers_.find(name); found != numbers_.end())
      return found->second;
    const auto made = static_cast<std::uint32_t>(names_.size());
    numbers_.emplace(names_.emplace_back(name), made);
    return made;
  }
  [[nodiscard]] const std::string& name(std::uint32_t number) const { return names_.at(number); }
  [[nodiscard]] std::size_t size() const { return names_.size(); }

private:
  std::deque<std::string> names_; // by number; the keys below are views of them
  std::unordered_map<std::string_view, std::uint32_t> numbers_;
};

} // namespace godwit::runtime
