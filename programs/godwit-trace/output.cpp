#include "programs/godwit-trace/output.hpp"

#include <cerrno>
#include <system_error>

#include <unistd.h>

namespace godwit::trace_tool {

bool output::flush() {
  std::string_view left = text_;
  while (!left.empty() && error_ == 0) {
    const auto written = ::write(descriptor_, left.data(), left.size());
    if (written >= 0)
      left.remove_prefix(static_cast<std::size_t>(written));
    else if (errno != EINTR)
      error_ = errno;
  }
  text_.clear();
  return error_ == 0;
}

std::string output::failure() const {
  return error_ == 0 || error_ == EPIPE ? std::string() : std::generic_category().message(error_);
}

void console::say(std::string_view sentence) {
  words.text().append("godwit-trace: ").append(sentence).append("\n");
  words.flush();
}

} // namespace godwit::trace_tool
