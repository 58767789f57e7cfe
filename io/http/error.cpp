#include "io/http/error.hpp"

namespace godwit::io::http {

bool is_transient(errc code) {
  switch (code) {
  case errc::too_many:
  case errc::cannot_resolve:
  case errc::refused:
  case errc::unreachable:
  case errc::connect_timeout:
  case errc::read_timeout:
  case errc::total_timeout:
  case errc::connection_lost:
  case errc::truncated:
    return true;
  default:
    return false;
  }
}

} // namespace godwit::io::http
