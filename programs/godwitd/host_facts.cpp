#include "programs/godwitd/host_facts.hpp"

#include <filesystem>
#include <system_error>

namespace godwit::daemon {

std::optional<std::uint64_t> host_facts::free_bytes() {
  constexpr auto period_ns = std::chrono::nanoseconds(period).count();
  const std::lock_guard guard(mutex_);
  const auto now_ns = time_.monotonic_ns();
  if (!read_ns_ || now_ns - *read_ns_ >= period_ns) {
    read_ns_ = now_ns;
    free_bytes_ = read_free_bytes_();
  }
  return free_bytes_;
}

std::optional<std::uint64_t> free_bytes_beside(const std::string& file) {
  std::error_code failed;
  const auto folder = std::filesystem::absolute(file, failed).parent_path();
  const auto space = std::filesystem::space(folder, failed);
  return failed ? std::nullopt : std::optional<std::uint64_t>(space.available);
}

} // namespace godwit::daemon
