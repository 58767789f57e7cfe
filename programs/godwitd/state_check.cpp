#include "programs/godwitd/state_check.hpp"

#include "actors/mapobjects_store/map_reader.hpp"
#include "runtime/journal/journal_reader.hpp"

namespace godwit::daemon {
namespace {

bool is_beyond_us(runtime::journal_errc code) {
  return code == runtime::journal_errc::foreign || code == runtime::journal_errc::newer ||
         code == runtime::journal_errc::corrupt;
}

bool is_beyond_us(mapobjects_store::map_errc code) {
  return code == mapobjects_store::map_errc::foreign || code == mapobjects_store::map_errc::newer ||
         code == mapobjects_store::map_errc::corrupt;
}

} // namespace

std::optional<std::string> objection_to_journal(const std::string& file) {
  auto opened = runtime::journal_reader::open(file);
  const auto whole = opened ? opened->check(runtime::integrity_check::quick)
                            : tl::expected<void, runtime::journal_error>(tl::make_unexpected(opened.error()));
  return whole || !is_beyond_us(whole.error().code) ? std::nullopt : std::optional(whole.error().message());
}

std::optional<std::string> objection_to_map(const std::string& file) {
  const auto opened = mapobjects_store::map_reader::open(file);
  return opened || !is_beyond_us(opened.error().code) ? std::nullopt : std::optional(opened.error().message());
}

} // namespace godwit::daemon
