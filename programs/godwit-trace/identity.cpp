#include "programs/godwit-trace/identity.hpp"

#include <algorithm>
#include <charconv>

namespace godwit::trace_tool {

tl::expected<io::mavlink::sender, std::string> read_identity(const std::string& text) {
  const auto slash = std::min(text.find('/'), text.size());
  const auto part = [&](std::size_t begin, std::size_t end) {
    unsigned value = 0;
    const auto [stopped, failure] = std::from_chars(text.data() + begin, text.data() + end, value);
    return failure == std::errc{} && stopped == text.data() + end && value <= 255 ? value : 0U;
  };
  const auto system = part(0, slash);
  const auto component = slash == text.size() ? 0U : part(slash + 1, text.size());
  if (system == 0 || component == 0)
    return tl::make_unexpected("--as: \"" + text + "\" is not SYSTEM/COMPONENT, such as 1/191, each from 1 to 255");
  return io::mavlink::sender{static_cast<std::uint8_t>(system), static_cast<std::uint8_t>(component)};
}

} // namespace godwit::trace_tool
