#include "runtime/journal/sqlite_error.hpp"

#include "runtime/journal/journal_file.hpp"

namespace godwit::runtime {

namespace {

journal_errc code_of(io::sqlite::store_errc code) {
  using io::sqlite::store_errc;
  switch (code) {
  case store_errc::locked:
    return journal_errc::locked;
  case store_errc::missing:
    return journal_errc::missing;
  case store_errc::foreign:
    return journal_errc::foreign;
  case store_errc::newer:
    return journal_errc::newer;
  case store_errc::corrupt:
    return journal_errc::corrupt;
  case store_errc::read_only:
    return journal_errc::read_only;
  case store_errc::disk_full:
    return journal_errc::disk_full;
  case store_errc::io:
  case store_errc::misuse:
    break;
  }
  return journal_errc::io;
}

} // namespace

journal_error from_store(const io::sqlite::store_error& error) {
  return {code_of(error.code), error.file, error.what, error.remedy + "."};
}

journal_error from_sqlite(const io::sqlite::error& error, const std::string& file, const std::string& doing) {
  return from_store(io::sqlite::describe(error, journal_format().kind, file, doing));
}

journal_error closed_journal(const std::string& file) {
  return {journal_errc::closed, file, "the journal is closed", "Nothing to do: the process is ending."};
}

} // namespace godwit::runtime
