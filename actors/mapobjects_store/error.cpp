#include "actors/mapobjects_store/error.hpp"

#include "actors/mapobjects_store/map_file.hpp"

namespace godwit::mapobjects_store {

bool is_refusal(map_errc code) {
  return code == map_errc::refused || code == map_errc::load_given_up || code == map_errc::delivered ||
         code == map_errc::full;
}

std::string map_error::message() const { return "map: " + what + "." + (remedy.empty() ? "" : " " + remedy + "."); }

namespace {

map_errc code_of(io::sqlite::store_errc code) {
  using io::sqlite::store_errc;
  switch (code) {
  case store_errc::locked:
    return map_errc::locked;
  case store_errc::missing:
    return map_errc::missing;
  case store_errc::foreign:
    return map_errc::foreign;
  case store_errc::newer:
    return map_errc::newer;
  case store_errc::corrupt:
    return map_errc::corrupt;
  case store_errc::misuse:
    return map_errc::internal;
  case store_errc::read_only:
  case store_errc::disk_full:
  case store_errc::io:
    break;
  }
  return map_errc::disk;
}

} // namespace

map_error from_store(const io::sqlite::store_error& error) {
  return {code_of(error.code), error.file.empty() ? error.what : error.file + ": " + error.what, error.remedy};
}

map_error from_sqlite(const io::sqlite::error& error, const std::string& doing) {
  return from_store(io::sqlite::describe(error, map_format().kind, {}, doing));
}

} // namespace godwit::mapobjects_store
