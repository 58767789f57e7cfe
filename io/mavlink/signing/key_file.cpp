#include "io/mavlink/signing/key_file.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <optional>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace godwit::io::mavlink {

namespace {

constexpr std::size_t hex_digits = 2 * secret_key_size;
constexpr std::size_t longest_content = hex_digits + 2; // the digits, CR and LF
constexpr mode_t permission_bits = 07777;
constexpr mode_t wanted_mode = 0600;

// Closes the file whatever happens.
class open_file {
public:
  // O_NONBLOCK: opening a pipe that somebody has put there must not hang.
  explicit open_file(const std::string& name)
      : descriptor_(::open(name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC)) {} // NOLINT(*-vararg)
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

// What was read, wiped when it is no longer needed. One byte more than a key may have shows that there is more.
struct content {
  std::array<std::byte, longest_content + 1> bytes{};
  std::size_t size = 0;
  content() = default;
  content(const content&) = delete;
  content& operator=(const content&) = delete;
  ~content() { wipe(bytes); }
};

using problem = std::optional<key_file_error>;

std::string octal(mode_t mode) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "%04o", static_cast<unsigned>(mode));
  return text.data();
}

key_file_error system_problem(const std::string& file, int number) {
  if (number == ENOENT)
    return {key_file_errc::missing, file, "there is no such file: make one with openssl rand -hex 32, mode 0600"};
  if (number == ELOOP)
    return {key_file_errc::symbolic_link, file, "it is a symbolic link: name the file itself"};
  return {key_file_errc::not_readable, file, std::generic_category().message(number)};
}

problem check_status(const std::string& file, int descriptor) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0)
    return system_problem(file, errno);
  if (!S_ISREG(status.st_mode))
    return key_file_error{key_file_errc::not_a_file, file, "it is not a regular file: name a file that holds the key"};
  if (status.st_uid != ::geteuid())
    return key_file_error{key_file_errc::other_owner, file,
                          "it belongs to user id " + std::to_string(status.st_uid) + " and must belong to " +
                              std::to_string(::geteuid()) + ": chown " + std::to_string(::geteuid()) + " " + file};
  if (const mode_t mode = status.st_mode & permission_bits; mode != wanted_mode)
    return key_file_error{key_file_errc::wrong_mode, file,
                          "its mode is " + octal(mode) + " and must be " + octal(wanted_mode) + ": chmod 600 " + file +
                              (mode & 077 ? ", and make a new key if others may have read it" : "")};
  return std::nullopt;
}

problem read_content(const std::string& file, int descriptor, content& to) {
  while (to.size < to.bytes.size()) {
    const ssize_t got = ::read(descriptor, to.bytes.data() + to.size, to.bytes.size() - to.size);
    if (got < 0 && errno == EINTR)
      continue;
    if (got < 0)
      return system_problem(file, errno);
    if (got == 0)
      break;
    to.size += static_cast<std::size_t>(got);
  }
  return std::nullopt;
}

std::optional<unsigned> digit(std::byte character) {
  const auto c = static_cast<char>(character);
  if (c >= '0' && c <= '9')
    return static_cast<unsigned>(c - '0');
  if (c >= 'a' && c <= 'f')
    return static_cast<unsigned>(c - 'a') + 10U;
  if (c >= 'A' && c <= 'F')
    return static_cast<unsigned>(c - 'A') + 10U;
  return std::nullopt;
}

std::optional<secret_key> key_from_hex(std::span<const std::byte> text) {
  std::array<std::byte, secret_key_size> bytes{};
  bool is_hex = true;
  for (std::size_t i = 0; i < secret_key_size; ++i) {
    const auto high = digit(text[2 * i]);
    const auto low = digit(text[2 * i + 1]);
    is_hex = is_hex && high && low;
    bytes[i] = static_cast<std::byte>(high.value_or(0) << 4U | low.value_or(0));
  }
  auto key = is_hex ? std::make_optional<secret_key>(bytes) : std::nullopt;
  wipe(bytes);
  return key;
}

std::optional<secret_key> key_from(const content& file) {
  std::span<const std::byte> text(file.bytes.data(), file.size);
  if (text.size() == secret_key_size)
    return secret_key(text.first<secret_key_size>());
  if (!text.empty() && text.back() == std::byte{'\n'})
    text = text.first(text.size() - 1);
  if (!text.empty() && text.back() == std::byte{'\r'})
    text = text.first(text.size() - 1);
  return text.size() == hex_digits ? key_from_hex(text) : std::nullopt;
}

} // namespace

tl::expected<secret_key, key_file_error> load_key_file(const std::filesystem::path& path) {
  const std::string file = path.string();
  const open_file opened(file);
  if (opened.descriptor() < 0)
    return tl::make_unexpected(system_problem(file, errno));
  if (const auto refused = check_status(file, opened.descriptor()))
    return tl::make_unexpected(*refused);
  content read;
  if (const auto failed = read_content(file, opened.descriptor(), read))
    return tl::make_unexpected(*failed);
  auto key = key_from(read);
  if (!key)
    return tl::make_unexpected(
        key_file_error{key_file_errc::not_a_key, file,
                       "it holds no key, which is 64 hexadecimal digits or 32 bytes: openssl rand -hex 32 makes one"});
  if (key->is_all_zero())
    return tl::make_unexpected(key_file_error{key_file_errc::all_zero, file,
                                              "a key of zeros switches signing off: openssl rand -hex 32 makes one"});
  return std::move(*key);
}

} // namespace godwit::io::mavlink
