#include "tests/programs/godwit-trace/tool_fixture.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <numeric>
#include <sstream>
#include <system_error>

#include <sys/mman.h>
#include <unistd.h>

#include "io/mavlink/ids.hpp"

namespace godwit::trace_tool::test {

memory_file::memory_file() : descriptor_(::memfd_create("godwit-test", MFD_CLOEXEC)) {
  if (descriptor_ < 0)
    throw std::system_error(errno, std::generic_category(), "memfd_create");
}

memory_file::~memory_file() { ::close(descriptor_); }

std::string memory_file::text() const {
  std::string result(static_cast<std::size_t>(::lseek(descriptor_, 0, SEEK_CUR)), '\0');
  const auto got = ::pread(descriptor_, result.data(), result.size(), 0);
  result.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  return result;
}

std::string kept_console::out() {
  out_.flush();
  return out_file_.text();
}

std::string kept_console::words() {
  words_.flush();
  return words_file_.text();
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);)
    lines.push_back(line);
  return lines;
}

std::string capture(const std::string& name) { return std::string(GODWIT_TEST_DATA) + "/captures/" + name; }

temporary_folder::temporary_folder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "godwit-tool-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr)
    throw std::system_error(errno, std::generic_category(), "mkdtemp");
  path_ = pattern;
}

temporary_folder::~temporary_folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

io::mavlink::secret_key counting_key(std::uint8_t first) {
  std::array<std::uint8_t, io::mavlink::secret_key_size> bytes{};
  std::iota(bytes.begin(), bytes.end(), first);
  return io::mavlink::secret_key(std::as_bytes(std::span(bytes)));
}

io::mavlink::frame_buffer raw_frame(std::uint32_t id, const std::vector<std::uint8_t>& payload) {
  const auto* const info = io::mavlink::find_message(id);
  const std::uint8_t crc_extra = info != nullptr ? info->crc_extra : 0;
  return {id, crc_extra, std::as_bytes(std::span(payload)), {1, 1}, 0, false};
}

} // namespace godwit::trace_tool::test
