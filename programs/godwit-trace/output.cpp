#include "programs/godwit-trace/output.hpp"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
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

namespace {

// For a shell; empty: none.
std::string line_of_pager() {
  const char* const chosen = std::getenv("PAGER");
  if (chosen == nullptr)
    return "if command -v less >/dev/null; then exec less; else exec cat; fi";
  const std::string_view name = chosen;
  return name.empty() || name == "cat" ? std::string() : "exec " + std::string(name);
}

// Reads from INPUT.
pid_t start(std::string line, int input) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
  std::string shell = "sh";
  std::string option = "-c";
  char* const words[] = {shell.data(), option.data(), line.data(), nullptr};
  pid_t process = -1;
  const bool is_started = ::posix_spawn(&process, "/bin/sh", &files, nullptr, words, environ) == 0;
  posix_spawn_file_actions_destroy(&files);
  return is_started ? process : -1;
}

} // namespace

pager::pager(int descriptor) : descriptor_(descriptor) {
  auto line = line_of_pager();
  int ends[2] = {-1, -1};
  if (line.empty() || ::pipe2(ends, O_CLOEXEC) != 0)
    return;
  ::setenv("LESS", "FRX", 0); // end when all fits, colours as they are, leave the screen as it is
  process_ = start(std::move(line), ends[0]);
  if (process_ != -1) {
    std::signal(SIGINT, SIG_IGN);
    ::dup2(ends[1], descriptor_);
  }
  ::close(ends[0]);
  ::close(ends[1]);
}

pager::~pager() {
  if (process_ == -1)
    return;
  ::close(descriptor_);
  ::waitpid(process_, nullptr, 0);
}

} // namespace godwit::trace_tool
