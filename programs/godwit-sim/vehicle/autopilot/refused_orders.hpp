// A fault on demand: commands that the vehicle refuses, whatever it would have done. Thread: one at a time.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

namespace godwit::sim {

class refused_orders {
public:
  // TIMES below 0: from now on; 0: no longer. Bounded by the number of commands there are.
  void refuse(std::uint16_t command, std::uint8_t result, int times) {
    if (times == 0)
      refused_.erase(command);
    else
      refused_[command] = {result, times};
  }

  // The answer to COMMAND if it is refused this time.
  [[nodiscard]] std::optional<std::uint8_t> take(std::uint16_t command) {
    const auto found = refused_.find(command);
    if (found == refused_.end())
      return std::nullopt;
    const auto result = found->second.result;
    if (found->second.times > 0 && --found->second.times == 0)
      refused_.erase(found);
    return result;
  }

private:
  struct entry {
    std::uint8_t result = 0;
    int times = 0;
  };
  std::map<std::uint16_t, entry> refused_;
};

} // namespace godwit::sim
