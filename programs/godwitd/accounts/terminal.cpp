#include "programs/godwitd/accounts/terminal.hpp"

#include <array>
#include <cstdio>
#include <cstring>

#include <termios.h>
#include <unistd.h>

#include "programs/godwitd/accounts/password.hpp"

namespace godwit::accounts {
namespace {

using io::http::secret_text;
using asked = tl::expected<secret_text, std::string>;

// The terminal shows what is typed again, whatever happens.
class silence {
public:
  silence() {
    is_terminal_ = ::tcgetattr(STDIN_FILENO, &before_) == 0;
    auto quiet = before_;
    quiet.c_lflag &= ~static_cast<tcflag_t>(ECHO);
    if (is_terminal_)
      (void)::tcsetattr(STDIN_FILENO, TCSAFLUSH, &quiet);
  }
  ~silence() {
    if (is_terminal_)
      (void)::tcsetattr(STDIN_FILENO, TCSAFLUSH, &before_);
  }
  silence(const silence&) = delete;
  silence& operator=(const silence&) = delete;

private:
  termios before_{};
  bool is_terminal_ = false;
};

asked read_line() {
  secret_text result(max_password + 2);
  std::size_t size = 0;
  char each = 0;
  while (size < max_password + 2 && ::read(STDIN_FILENO, &each, 1) == 1 && each != '\n')
    result.data()[size++] = each;
  if (size > 0 && result.data()[size - 1] == '\r')
    --size;
  result.cut_to(size);
  if (size < min_password || size > max_password)
    return tl::make_unexpected("a password has " + std::to_string(min_password) + " to " +
                               std::to_string(max_password) + " bytes");
  return result;
}

asked ask(const std::string& question) {
  (void)std::fputs(question.c_str(), stderr);
  auto result = [] {
    const silence while_typing;
    return read_line();
  }();
  (void)std::fputs("\n", stderr);
  return result;
}

} // namespace

asked ask_new_password(const std::string& name) {
  if (::isatty(STDIN_FILENO) == 0)
    return read_line();
  auto first = ask("New password of " + name + ": ");
  if (!first)
    return first;
  const auto second = ask("Once more: ");
  if (!second || second->revealed() != first->revealed())
    return tl::make_unexpected(std::string("that was not the same twice; nothing was changed"));
  return first;
}

} // namespace godwit::accounts
