#include "io/http/secret_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace godwit::io::http {

namespace {

constexpr mode_t permission_bits = 07777;
constexpr mode_t wanted_mode = 0600;

// O_NONBLOCK: opening a pipe that somebody has put there must not hang.
constexpr int to_read = O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
constexpr int to_make = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;

// Closes the file whatever happens.
class open_file {
public:
  open_file(const std::string& name, int how)
      : descriptor_(::open(name.c_str(), how, wanted_mode)) {} // NOLINT(*-vararg)
  ~open_file() {
    if (descriptor_ >= 0)
      ::close(descriptor_);
  }
  open_file(const open_file&) = delete;
  open_file& operator=(const open_file&) = delete;
  [[nodiscard]] int descriptor() const { return descriptor_; }

private:
  int descriptor_;
};

std::string octal(mode_t mode) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "%04o", static_cast<unsigned>(mode));
  return text.data();
}

std::string system_problem(int number) {
  if (number == ENOENT)
    return "there is no such file";
  if (number == ELOOP)
    return "it is a symbolic link: name the file itself";
  return std::generic_category().message(number);
}

// Empty: nothing is wrong with it.
std::string status_problem(const std::string& file, int descriptor, std::size_t max_bytes, std::size_t& size) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0)
    return system_problem(errno);
  if (!S_ISREG(status.st_mode))
    return "it is not a regular file";
  const auto us = std::to_string(::geteuid());
  if (status.st_uid != ::geteuid())
    return "it belongs to user id " + std::to_string(status.st_uid) + " and must belong to " + us + ": chown " + us +
           " " + file;
  if (const mode_t mode = status.st_mode & permission_bits; mode != wanted_mode)
    return "its mode is " + octal(mode) + " and must be " + octal(wanted_mode) + ": chmod 600 " + file +
           (mode & 077 ? ", and have a new one made if others may have read it" : "");
  size = static_cast<std::size_t>(status.st_size);
  if (size == 0)
    return "it is empty";
  if (size > max_bytes)
    return "it has " + std::to_string(size) + " bytes, and may have " + std::to_string(max_bytes);
  return {};
}

// Empty: all that the file had when it was looked at is in TO.
std::string read_problem(int descriptor, secret_text& to, std::size_t size) {
  std::size_t have = 0;
  while (have < size) {
    const ssize_t got = ::read(descriptor, to.data() + have, size - have);
    if (got < 0 && errno == EINTR)
      continue;
    if (got < 0)
      return system_problem(errno);
    if (got == 0)
      break; // it was cut while we read
    have += static_cast<std::size_t>(got);
  }
  to.cut_to(have);
  return {};
}

bool is_token_character(char c) { return c > ' ' && c < '\x7f' && c != '"' && c != '\\' && c != ','; }

} // namespace

result<secret_text> load_secret_file(const std::string& file, std::size_t max_bytes, errc code) {
  const open_file opened(file, to_read);
  if (opened.descriptor() < 0)
    return failure(code, system_problem(errno), file);
  std::size_t size = 0;
  if (auto wrong = status_problem(file, opened.descriptor(), max_bytes, size); !wrong.empty())
    return failure(code, std::move(wrong), file);
  secret_text content(size);
  if (auto wrong = read_problem(opened.descriptor(), content, size); !wrong.empty())
    return failure(code, std::move(wrong), file);
  return content;
}

result<void> store_secret_file(const std::string& file, std::string_view content, errc code) {
  const auto problem = [&] { return failure(code, "it can not be written: " + system_problem(errno), file); };
  const auto fresh = file + ".new";
  (void)::unlink(fresh.c_str());
  const open_file out(fresh, to_make);
  if (out.descriptor() < 0 || ::fchmod(out.descriptor(), wanted_mode) != 0)
    return problem();
  while (!content.empty()) {
    const auto count = ::write(out.descriptor(), content.data(), content.size());
    if (count < 0 && errno == EINTR)
      continue;
    if (count < 0)
      return problem();
    content.remove_prefix(static_cast<std::size_t>(count));
  }
  if (::fsync(out.descriptor()) != 0 || ::rename(fresh.c_str(), file.c_str()) != 0)
    return problem();
  const auto beside = std::filesystem::path(file).parent_path();
  const open_file folder(beside.empty() ? "." : beside.string(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder.descriptor() < 0 || ::fsync(folder.descriptor()) != 0)
    return problem();
  return {};
}

result<secret_text> load_token(const std::string& file) {
  auto token = load_secret_file(file, max_token_bytes, errc::token_file);
  if (!token)
    return token;
  auto text = token->revealed();
  for (const char end : {'\n', '\r'})
    if (text.ends_with(end))
      text.remove_suffix(1);
  const bool is_token = !text.empty() && std::ranges::all_of(text, is_token_character);
  token->cut_to(text.size());
  if (!is_token)
    return failure(errc::token_file, "it holds no token, which is one line of letters, digits and -._~+/=", file);
  return token;
}

} // namespace godwit::io::http
