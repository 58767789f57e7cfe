#include "actors/movement_detector/eyes_process.hpp"

#include <string>

namespace godwit::movement_detector {

void eyes_process::open(runtime::gateway gateway, port_handle actor) {
  // Both callbacks come in the one thread of the helper, and so share one gateway.
  const auto way_in = std::make_shared<runtime::gateway>(std::move(gateway));
  process_->attach({[way_in, actor](std::uint32_t run, io::eyes::message said) {
                      if (auto* status = std::get_if<io::eyes::status>(&said))
                        way_in->tell(actor, helper_status{run, std::move(*status)});
                      else if (auto* seen = std::get_if<io::eyes::candidates>(&said))
                        way_in->tell(actor, helper_candidates{run, std::move(*seen)});
                    },
                    [way_in, actor](std::uint32_t run, std::string why) {
                      way_in->tell(actor, helper_ended{run, std::move(why)});
                    }});
}

void eyes_process::keep_picture(std::uint32_t track, std::int64_t captured_ns, const std::string& id) {
  auto seen = process_->slot().read_cutout(track);
  if (seen && seen->captured_ns <= captured_ns && captured_ns - seen->captured_ns <= cutout_lasts_ns)
    pictures_(id, *std::move(seen));
}

} // namespace godwit::movement_detector
