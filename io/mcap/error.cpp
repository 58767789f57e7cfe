#include "io/mcap/error.hpp"

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

namespace godwit::io::mcap {

namespace {

struct named_code {
  errc code;
  const char* name;
};

constexpr std::array<named_code, 10> code_names{{
    {errc::io, "i/o error"},
    {errc::disk_full, "disk full"},
    {errc::too_large, "too large"},
    {errc::too_many, "too many"},
    {errc::malformed, "malformed"},
    {errc::crc_mismatch, "CRC mismatch"},
    {errc::unsupported, "not supported"},
    {errc::invalid_argument, "invalid argument"},
    {errc::gone, "gone"},
    {errc::not_open, "not open"},
}};

} // namespace

const char* to_string(errc code) {
  for (const auto& row : code_names) {
    if (row.code == code) {
      return row.name;
    }
  }
  return "unknown error";
}

std::string error::message() const {
  std::string text = file.empty() ? std::string{"MCAP data"} : file;
  text += ": ";
  text += to_string(code);
  if (code == errc::malformed || code == errc::crc_mismatch || code == errc::unsupported) {
    text += " at byte " + std::to_string(offset_bytes);
  }
  return text + ": " + what;
}

error system_error(std::string file, std::string_view operation, int number) {
  const bool full = number == ENOSPC || number == EDQUOT;
  std::string what{operation};
  what += ": " + std::generic_category().message(number);
  return {full ? errc::disk_full : errc::io, std::move(file), std::move(what), 0};
}

} // namespace godwit::io::mcap
