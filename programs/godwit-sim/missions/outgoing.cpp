#include "programs/godwit-sim/missions/outgoing.hpp"

#include <algorithm>

namespace godwit::sim::missions {
namespace {

constexpr std::size_t space_bytes = 64 * 1024;

std::string head_of(const delivery& from, bool is_last) {
  const auto& what = from.what;
  std::string head = "HTTP/1.1 " + std::to_string(what.status) + " \r\n"; // the reason is for nobody and may be empty
  if (!what.content_type.empty())
    head += "Content-Type: " + what.content_type + "\r\n";
  constexpr unsigned no_content = 204; // has no body, and no length either
  if (what.status != no_content)
    head += "Content-Length: " + std::to_string(what.body.size() + from.padding) + "\r\n";
  for (const auto& [name, value] : what.headers)
    head.append(name).append(": ").append(value).append("\r\n");
  head += is_last ? "Connection: close\r\n\r\n" : "\r\n";
  return head;
}

} // namespace

outgoing::outgoing(const delivery& from, bool is_last) : bytes_(head_of(from, is_last)), padding_(from.padding) {
  const std::string_view body = from.what.body;
  bytes_.append(body.substr(0, from.cut_after.value_or(body.size())));
  if (from.cut_after)
    padding_ = 0;
}

std::string_view outgoing::take(std::size_t max) {
  if (offset_ < bytes_.size()) {
    const auto piece = std::string_view(bytes_).substr(offset_, max);
    offset_ += piece.size();
    return piece;
  }
  static const std::string spaces(space_bytes, ' ');
  const auto size = std::min<std::uint64_t>({max, padding_, space_bytes});
  padding_ -= size;
  return std::string_view(spaces).substr(0, size);
}

} // namespace godwit::sim::missions
