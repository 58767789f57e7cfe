#include "programs/godwit-trace/bundle/tar_writer.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <numeric>
#include <vector>

#include "io/mcap/byte_source.hpp"

namespace godwit::trace_tool {

namespace {

using io::mcap::result;

constexpr std::size_t block_bytes = 512;
constexpr std::array<std::byte, 2 * block_bytes> zeros{};

// One header; all texts are zeros after their end.
struct ustar_header {
  char name[100];
  char mode[8];
  char owner[8];
  char group[8];
  char size[12];
  char time[12];
  char checksum[8];
  char kind;
  char link[100];
  char magic[6];
  char version[2];
  char rest[247];
};
static_assert(sizeof(ustar_header) == block_bytes);

template <std::size_t N>
void set_octal(char (&field)[N], std::uint64_t value) {
  std::array<char, 32> digits{};
  std::snprintf(digits.data(), digits.size(), "%0*llo", static_cast<int>(N - 1), // NOLINT(*-vararg)
                static_cast<unsigned long long>(value));
  std::memcpy(field, digits.data(), N);
}

template <std::size_t N>
void set_text(char (&field)[N], std::string_view text) {
  text.copy(field, N);
}

} // namespace

result<void> tar_writer::create(const std::filesystem::path& file, std::int64_t time_s) {
  time_s_ = time_s;
  return file_.create(file);
}

result<void> tar_writer::add_header(const std::string& name, std::uint64_t size_bytes) {
  if (name.size() > max_name || size_bytes > max_member_bytes)
    return tl::make_unexpected(io::mcap::error{io::mcap::errc::invalid_argument, file_.name(),
                                               "a name or a size that does not fit: " + name, 0});
  ustar_header header{};
  set_text(header.name, name);
  set_octal(header.mode, 0600);
  set_octal(header.owner, 0);
  set_octal(header.group, 0);
  set_octal(header.size, size_bytes);
  set_octal(header.time, static_cast<std::uint64_t>(std::max<std::int64_t>(time_s_, 0)));
  header.kind = '0';
  set_text(header.magic, "ustar");
  set_text(header.version, "00");
  std::memset(header.checksum, ' ', sizeof header.checksum); // as which it counts in its own sum
  std::array<unsigned char, block_bytes> bytes{};
  std::memcpy(bytes.data(), &header, block_bytes);
  const auto sum = std::accumulate(bytes.begin(), bytes.end(), std::uint64_t{0});
  std::array<char, 7> digits{};
  std::snprintf(digits.data(), digits.size(), "%06llo", static_cast<unsigned long long>(sum)); // NOLINT(*-vararg)
  std::memcpy(header.checksum, digits.data(), digits.size()); // six digits, a zero, and the space that is there
  return file_.append(std::as_bytes(std::span(&header, 1)));
}

result<void> tar_writer::fill_block() {
  const auto over = file_.size_bytes() % block_bytes;
  return over == 0 ? result<void>{} : file_.append(std::span(zeros).first(block_bytes - over));
}

result<void> tar_writer::add(const std::string& name, std::string_view text) {
  return add_header(name, text.size())
      .and_then([&] { return file_.append(std::as_bytes(std::span(text))); })
      .and_then([this] { return fill_block(); });
}

result<void> tar_writer::add_file(const std::string& name, const std::filesystem::path& file,
                                  std::uint64_t size_bytes) {
  io::mcap::file_source source;
  if (auto opened = source.open(file); !opened)
    return opened;
  if (auto begun = add_header(name, size_bytes); !begun)
    return begun;
  std::vector<std::byte> piece(std::size_t{1} << 20U);
  for (std::uint64_t at = 0; at < size_bytes;) {
    const auto wanted = std::min<std::uint64_t>(piece.size(), size_bytes - at);
    const auto got = source.read_at(at, std::span(piece).first(wanted));
    if (!got)
      return tl::make_unexpected(got.error());
    std::fill(piece.begin() + static_cast<std::ptrdiff_t>(*got), piece.begin() + static_cast<std::ptrdiff_t>(wanted),
              std::byte{0});
    if (auto written = file_.append(std::span(piece).first(wanted)); !written)
      return written;
    at += wanted;
  }
  return fill_block();
}

result<void> tar_writer::close() {
  return file_.append(zeros).and_then([this] { return file_.close(); });
}

} // namespace godwit::trace_tool
