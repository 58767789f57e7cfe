#include "io/mavlink/signing/signer.hpp"

#include <algorithm>

namespace godwit::io::mavlink {

tl::expected<signing_time, sign_error> signer::sign(frame_buffer& frame, std::int64_t wall_ns) {
  const auto time = clock_.next(wall_ns);
  if (!time)
    return tl::make_unexpected(sign_error::timestamps_used_up);
  frame.append_signature(store({link_, *time, hasher_.hash_of(frame.span(), link_, *time)}));
  return *time;
}

signing_clock::signing_clock(signing_time ceiling) : free_(units(ceiling)), own_(free_), ceiling_(free_) {}

std::uint64_t signing_clock::next_free(std::int64_t wall_ns) const {
  return std::max({free_, followed_, units(signing_time_at(wall_ns))});
}

std::optional<signing_time> signing_clock::next(std::int64_t wall_ns) {
  const std::uint64_t value = next_free(wall_ns);
  if (value > units(max_signing_time))
    return std::nullopt;
  free_ = value + 1;
  own_ = units(now(wall_ns)) + 1;
  return signing_time{value};
}

signing_time signing_clock::now(std::int64_t wall_ns) const {
  return signing_time{std::min(std::max(own_, units(signing_time_at(wall_ns))), units(max_signing_time))};
}

std::optional<signing_time> signing_clock::wanted_reservation(std::int64_t wall_ns) {
  const signing_time from{std::min(next_free(wall_ns), units(max_signing_time))};
  if (under_way_ || units(from) + ask_when_left < ceiling_ || ceiling_ == units(max_signing_time))
    return std::nullopt;
  under_way_ = true;
  return later(from, reserve_ahead);
}

void signing_clock::reserved(signing_time ceiling) {
  under_way_ = false;
  ceiling_ = std::max(ceiling_, units(ceiling));
}

} // namespace godwit::io::mavlink
