#include "programs/godwitd/checks/start_checks.hpp"

#include <ctime>
#include <limits>

#include <sys/resource.h>

#include "actors/mapobjects_store/map_reader.hpp"
#include "actors/operator_bridge/audit_table.hpp"
#include "io/time_units.hpp"
#include "runtime/journal/journal_reader.hpp"
#include "runtime/journal/sqlite_error.hpp"

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

std::vector<runtime::table_definition> journal_tables() { return {operator_bridge::audit_table()}; }

std::optional<std::string> objection_to_journal(const std::string& file) {
  auto opened = runtime::journal_reader::open(file);
  const auto whole = opened ? opened->check(runtime::integrity_check::quick)
                            : tl::expected<void, runtime::journal_error>(tl::make_unexpected(opened.error()));
  if (!whole)
    return is_beyond_us(whole.error().code) ? std::optional(whole.error().message()) : std::nullopt;
  const auto known = runtime::check_tables(opened->database(), file, journal_tables());
  if (known || known.error().code != io::sqlite::store_errc::newer)
    return std::nullopt;
  return runtime::from_store(known.error()).message();
}

std::optional<std::string> objection_to_map(const std::string& file) {
  const auto opened = mapobjects_store::map_reader::open(file);
  return opened || !is_beyond_us(opened.error().code) ? std::nullopt : std::optional(opened.error().message());
}

namespace {

constexpr std::int64_t century_s = 3'155'760'000;
constexpr std::int64_t last_s = std::numeric_limits<std::int64_t>::max() / ns_per_s - century_s;

std::int64_t seconds_of(clockid_t which) {
  timespec now{};
  ::clock_gettime(which, &now);
  return now.tv_sec;
}

} // namespace

clock_reading clock_now() { return {seconds_of(CLOCK_REALTIME), seconds_of(CLOCK_MONOTONIC)}; }

std::optional<std::string> objection_to_clock(const clock_reading& now) {
  if (now.wall_s < last_s && now.wall_s >= -last_s && now.monotonic_s < last_s)
    return std::nullopt;
  return "the clock of this computer is " + std::to_string(now.wall_s) +
         " s from 1970, centuries from now; set it (timedatectl set-time) and start godwitd again";
}

process_limits limits_now() {
  rlimit space{RLIM_INFINITY, RLIM_INFINITY};
  rlimit files{RLIM_INFINITY, RLIM_INFINITY};
  (void)::getrlimit(RLIMIT_AS, &space);
  (void)::getrlimit(RLIMIT_NOFILE, &files);
  return {space.rlim_cur, files.rlim_cur};
}

std::optional<std::string> objection_to_limits(const process_limits& now) {
  if (now.address_space < least_address_space)
    return "the limit of address space is " + std::to_string(now.address_space) + " bytes, and godwitd needs " +
           std::to_string(least_address_space) + ": raise it (ulimit -v), or bound the memory itself (MemoryMax)";
  if (now.descriptors < least_descriptors)
    return "the limit of open files is " + std::to_string(now.descriptors) + ", and godwitd needs " +
           std::to_string(least_descriptors) + ": raise it (ulimit -n, LimitNOFILE)";
  return std::nullopt;
}

} // namespace godwit::daemon
