#include "actors/domain/mission/convert/conversion.hpp"

#include <array>
#include <cstdint>
#include <cstdio>
#include <utility>

#include "actors/domain/mission/read.hpp"
#include "actors/domain/mission/write.hpp"

namespace godwit::mission {

namespace {

// FNV-1a, 64 bits; START makes it two independent ones. Not for protection, only for a name.
std::uint64_t hash_of(std::string_view text, std::uint64_t start) {
  for (const auto each : text)
    start = (start ^ static_cast<unsigned char>(each)) * 0x100000001b3U;
  return start;
}

} // namespace

std::string conversion_error::message() const {
  auto result = error.message();
  if (!losses.empty())
    result += '\n' + losses.message();
  return result;
}

conversion_error lossy(loss_list losses, std::string_view source) {
  const auto count = losses.all.size() + losses.omitted;
  document_problem summary{{}, "can only be taken over in part: " + std::to_string(count) + " losses", {}};
  return {bounded({document_errc::lossy, {std::move(summary)}}, source), std::move(losses)};
}

import_result finished(const document& mission, loss_list losses, const import_options& options,
                       std::string_view source) {
  // By way of its text: what an importer gives away has passed the same checks as what the service sends.
  auto checked = read<document>(to_text(mission));
  if (!checked) {
    auto error = std::move(checked.error());
    error.sample = source.substr(0, max_document_sample);
    return tl::unexpected(conversion_error{std::move(error), std::move(losses)});
  }
  if (!losses.empty() && !options.allow_partial)
    return tl::unexpected(lossy(std::move(losses), source));
  return imported{std::move(*checked), std::move(losses)};
}

std::string uuid_of_text(std::string_view text) {
  constexpr std::uint64_t basis = 0xcbf29ce484222325U;
  const auto high = (hash_of(text, basis) & ~0xF000ULL) | 0x8000U;
  const auto low = (hash_of(text, ~basis) & ~(3ULL << 62U)) | (2ULL << 62U);
  std::array<char, 40> out{};
  std::snprintf(out.data(), out.size(), "%08x-%04x-%04x-%04x-%012llx", static_cast<unsigned>(high >> 32U),
                static_cast<unsigned>(high >> 16U & 0xFFFFU), static_cast<unsigned>(high & 0xFFFFU),
                static_cast<unsigned>(low >> 48U), static_cast<unsigned long long>(low & 0xFFFFFFFFFFFFULL));
  return out.data();
}

} // namespace godwit::mission
