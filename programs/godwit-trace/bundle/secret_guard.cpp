#include "programs/godwit-trace/bundle/secret_guard.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <sstream>

#include "io/mcap/byte_source.hpp"

namespace godwit::trace_tool {

namespace {

constexpr std::size_t key_bytes = 32; // of a link

std::string without_end_of_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r'))
    text.pop_back();
  return text;
}

bool is_hex(std::string_view text) {
  return std::ranges::all_of(text, [](unsigned char c) { return std::isxdigit(c) != 0; });
}

std::string in_case(std::string text, int (*change)(int)) {
  std::ranges::transform(text, text.begin(), [change](unsigned char c) { return static_cast<char>(change(c)); });
  return text;
}

std::string hex_of(std::string_view bytes) {
  static constexpr std::string_view digits = "0123456789abcdef";
  std::string result;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    result.append({digits[byte >> 4U], digits[byte & 15U]});
  }
  return result;
}

std::string bytes_of(std::string_view hex) {
  std::string result;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    result += static_cast<char>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16));
  return result;
}

} // namespace

tl::expected<void, std::string> secret_guard::add_file(const std::filesystem::path& file) {
  std::ifstream from(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(from), {}};
  if (!from || text.size() > longest_file)
    return tl::make_unexpected(file.string() + ": it can not be read, or is too long for a secret");
  const auto name = file.string();
  if (text.find("-----BEGIN") != std::string::npos) {
    std::istringstream lines(text);
    std::size_t taken = 0;
    for (std::string line; taken < max_lines && std::getline(lines, line);)
      if (line.find("-----") == std::string::npos && line.size() >= 2 * shortest) {
        add(name, without_end_of_line(line));
        ++taken;
      }
    return {};
  }
  const auto plain = without_end_of_line(text);
  if (text.size() == key_bytes) {
    add(name, text);
    add(name, hex_of(text));
    add(name, in_case(hex_of(text), std::toupper));
  } else if (plain.size() == 2 * key_bytes && is_hex(plain)) {
    add(name, bytes_of(plain));
    add(name, in_case(plain, std::tolower));
    add(name, in_case(plain, std::toupper));
  } else {
    add(name, plain);
  }
  return {};
}

void secret_guard::add(const std::string& file, std::string text) {
  if (text.size() < shortest)
    return;
  longest_ = std::max(longest_, text.size());
  secrets_.push_back({file, std::move(text)});
}

std::string secret_guard::found_in(std::string_view text) const {
  const auto found =
      std::ranges::find_if(secrets_, [&](const secret& each) { return text.find(each.text) != text.npos; });
  return found == secrets_.end() ? std::string() : found->file;
}

std::string secret_guard::found_in_file(const std::filesystem::path& file, std::uint64_t size_bytes) const {
  if (secrets_.empty())
    return {};
  io::mcap::file_source source;
  if (!source.open(file))
    return file.string();
  std::string window(std::size_t{1} << 20U, '\0');
  const auto overlap = longest_ - 1; // a secret may lie across two windows
  for (std::uint64_t at = 0; at < size_bytes;) {
    const auto wanted = std::min<std::uint64_t>(window.size(), size_bytes - at);
    const auto got = source.read_at(at, std::as_writable_bytes(std::span(window).first(wanted)));
    if (!got)
      return file.string();
    if (auto found = found_in(std::string_view(window).substr(0, *got)); !found.empty())
      return found;
    if (*got < wanted || at + wanted >= size_bytes)
      break;
    at += wanted - std::min<std::uint64_t>(overlap, wanted - 1);
  }
  return {};
}

} // namespace godwit::trace_tool
