#include "runtime/dead_letter.hpp"

#include <vector>

#include "io/fields/binary.hpp"

namespace godwit::runtime {

namespace {

constexpr std::size_t max_dead_letter_bytes = 64 * 1024; // of the encoded message

std::string body_of(const envelope& m) {
  std::vector<std::byte> memory(max_dead_letter_bytes);
  io::byte_sink sink(memory);
  m.type->encode(sink, m.body.data());
  if (sink.overflow())
    return R"({"too_long":true})";
  std::string text;
  io::byte_source source(std::span<const std::byte>(memory.data(), sink.used()));
  m.type->append_decoded(text, source);
  return text;
}

} // namespace

dead_letter make_dead_letter(const envelope& m, std::int64_t at_ns, std::string sender, int crashes,
                             std::string reason) {
  return {m.head.id, m.head.cause,     at_ns, std::move(sender), std::string(m.type->name), body_of(m),
          crashes,   std::move(reason)};
}

} // namespace godwit::runtime
