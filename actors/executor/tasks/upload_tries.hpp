// How often one plan is brought to the vehicle before it has not come.
//
//   asked ──the vehicle says no, or takes it──> that is its end
//     ^  └──no answer, no vehicle on the link──┐
//     └────────at most max_uploads that began, within uploads_within_ns
//
// vehicle_link may crash in the middle of a transfer, or just have begun anew and not hear the vehicle yet. Neither
// says anything about the plan: it goes up again, and the intent that is on the disk stays open meanwhile, so that a
// restart in between looks at the vehicle. A try whose end nobody has seen may have come through; when a later one ends
// without the plan, what the vehicle holds has to be looked at. Monotonic nanoseconds. Thread: pure.
#pragma once

#include <cstdint>
#include <string>

#include "actors/executor/progress/events.hpp"
#include "messages/vehicle_link/transfer.hpp"

namespace godwit::executor {

inline constexpr int max_uploads = 3; // of one plan; those that were not begun do not count
// A link that was restarted hears the vehicle within some seconds; a vehicle that is not heard for longer has more to
// be told than this plan.
inline constexpr std::int64_t uploads_within_ns = 30'000'000'000;

// The vehicle has refused so long a plan.
[[nodiscard]] bool has_no_room(const vehicle_link::transfer::outcome& outcome);
// What the outcome of a single try means to the progress.
[[nodiscard]] progress::upload_ended end_of(const vehicle_link::transfer::outcome& outcome);

class upload_tries {
public:
  // A plan is asked for, for the first time.
  void begin(std::int64_t now_ns);
  // True: it is to be asked for again. False: that was its end.
  [[nodiscard]] bool go_on(const vehicle_link::transfer::outcome& outcome, std::int64_t now_ns);
  // Of all tries, when this was the outcome of the last one.
  [[nodiscard]] progress::upload_ended end(const vehicle_link::transfer::outcome& last) const;
  // The same, when nothing of the last one has gone out.
  [[nodiscard]] progress::upload_ended end_unsent(const std::string& why) const;

private:
  [[nodiscard]] progress::upload_ended after_earlier(progress::upload_ended last) const;

  std::int64_t began_ns_ = 0;
  int begun_ = 0;
  bool may_have_come_ = false; // by a try before
};

} // namespace godwit::executor
