// Tells what a person cares about, out of everything that a vehicle does: armed, mode, in the air, mission, items,
// texts, battery, GPS; and which stations speak to it. A line for each, without its end.
//
// Pictures may come as often as one likes; a sentence comes when something has changed. Frames tell what a picture
// would miss between two looks. Pure. Thread: one at a time.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/mavlink/frame.hpp"
#include "programs/godwit-sim/vehicle/vehicle.hpp"

namespace godwit::sim {

class event_watch {
public:
  static constexpr std::size_t max_stations = 16; // further ones are not told; so many peers a link has
  static constexpr double battery_step_percent = 10;

  // What has changed since the last picture; nothing for the first.
  [[nodiscard]] std::vector<std::string> look(const vehicle_picture& now);
  // What the vehicle sends: the sentence, or none.
  [[nodiscard]] std::string sent(const io::mavlink::frame_view& frame);
  // What a station sends: the sentence when it is a new one, or none.
  [[nodiscard]] std::string heard(const io::mavlink::frame_view& frame);

private:
  bool has_looked_ = false;
  vehicle_picture last_;
  int reached_ = -1; // the item told last: some autopilots repeat themselves
  std::vector<io::mavlink::sender> stations_;
};

} // namespace godwit::sim
