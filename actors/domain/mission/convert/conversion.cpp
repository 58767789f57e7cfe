#include "actors/domain/mission/convert/conversion.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <utility>

#include "actors/domain/mission/read.hpp"
#include "actors/domain/mission/version.hpp"
#include "actors/domain/mission/write.hpp"

namespace godwit::mission {

namespace {

// FNV-1a, 64 bits; START makes it two independent ones. Not for protection, only for a name.
std::uint64_t hash_of(std::string_view text, std::uint64_t start) {
  for (const auto each : text)
    start = (start ^ static_cast<unsigned char>(each)) * 0x100000001b3U;
  return start;
}

// The index that POINTER has in the list LIST of a mission, and what comes after it.
std::optional<std::pair<std::size_t, std::string_view>> entry_of(std::string_view pointer, std::string_view list) {
  if (!pointer.starts_with(list))
    return std::nullopt;
  pointer.remove_prefix(list.size());
  std::size_t index = 0;
  const auto [stopped, failure] = std::from_chars(pointer.data(), pointer.data() + pointer.size(), index);
  if (failure != std::errc{})
    return std::nullopt;
  return std::pair{index, pointer.substr(static_cast<std::size_t>(stopped - pointer.data()))};
}

// "/at/latitude" is "latitude" to people.
std::string words_of(std::string_view rest) {
  if (rest.starts_with("/at/"))
    rest.remove_prefix(3);
  std::string result(rest.empty() ? rest : rest.substr(1));
  std::ranges::replace(result, '/', ' ');
  return result;
}

void move_to_source(document_problem& problem, const document& mission, const source_map& source) {
  if (problem.pointer == "/items" && !source.list.empty())
    problem.pointer = source.list;
  else if (problem.pointer == "/items" && source.holds_items)
    problem = {{}, "holds no item that a mission has", {}};
  if (const auto found = entry_of(problem.pointer, "/items/"); found && found->first < source.items.size()) {
    const auto [index, rest] = *found;
    const auto& [place, name] = source.items[index];
    const auto id = index < mission.items.size() ? in_quotes(id_of(mission.items[index])) : std::string();
    const auto words = words_of(rest);
    problem.what =
        '(' + name + (name.empty() ? "" : ", ") + id + "): " + words + (words.empty() ? "" : " ") + problem.what;
    problem.pointer = place;
  } else if (const auto fence = entry_of(problem.pointer, "/geofences/");
             fence && fence->first < source.geofences.size()) {
    const auto words = fence->second == "/vertices" ? std::string() : words_of(fence->second) + ' ';
    problem.what = words + problem.what;
    problem.pointer = source.geofences[fence->first].place;
  }
}

// A mission needs an item, a file of a fence alone has none: its fences are checked with one in front of them.
document with_an_item(document mission) {
  mission.items.emplace_back(takeoff{"none", 1});
  return mission;
}

} // namespace

document_error in_source(document_error error, const document& mission, const source_map& source) {
  for (auto& each : error.problems)
    move_to_source(each, mission, source);
  return error;
}

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

std::string why_no_mission(const document& without_items) {
  return without_items.geofences.empty() ? "holds rally points alone, which are no mission"
                                         : "holds a fence alone, which is no mission";
}

import_result finished(const document& given, loss_list losses, const import_options& options, std::string_view source,
                       const source_map& places) {
  const bool is_fence_alone = given.items.empty() && !places.holds_items &&
                              (!given.geofences.empty() || given.rally_points || given.breach_return_point);
  if (is_fence_alone && !options.fence_alone) {
    document_problem no_items{{}, why_no_mission(given), {}};
    return tl::unexpected(
        conversion_error{bounded({document_errc::wrong_form, {std::move(no_items)}}, source), std::move(losses)});
  }
  auto mission = given;
  // What is for any vehicle or for the usual one stays in version 1, which more readers know.
  if (const auto vehicle = std::exchange(mission.vehicle, std::nullopt);
      vehicle != vehicle_profile::px4_multicopter || needs_version_2(mission))
    mission.vehicle = vehicle;
  raise_version(mission);
  // By way of its text: what an importer gives away has passed the same checks as what the service sends.
  auto checked = read<document>(to_text(is_fence_alone ? with_an_item(mission) : mission));
  if (!checked) {
    auto error = in_source(std::move(checked.error()), mission, places);
    error.sample = source.substr(0, max_document_sample);
    return tl::unexpected(conversion_error{std::move(error), std::move(losses)});
  }
  if (!losses.empty() && !options.allow_partial)
    return tl::unexpected(lossy(std::move(losses), source));
  if (is_fence_alone)
    checked->items.clear();
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
