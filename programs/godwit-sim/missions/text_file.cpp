#include "programs/godwit-sim/missions/text_file.hpp"

#include <cerrno>
#include <fstream>
#include <system_error>

namespace godwit::sim::missions {

tl::expected<std::string, std::string> read_text_file(const std::string& name, std::size_t max_bytes) {
  errno = 0;
  std::ifstream file(name, std::ios::binary);
  if (!file)
    return tl::unexpected(name + " can not be read: " + std::generic_category().message(errno));
  std::string text(max_bytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (file.bad())
    return tl::unexpected(name + " can not be read: " + std::generic_category().message(errno));
  if (text.size() > max_bytes)
    return tl::unexpected(name + " has more than " + std::to_string(max_bytes) + " bytes");
  return text;
}

} // namespace godwit::sim::missions
