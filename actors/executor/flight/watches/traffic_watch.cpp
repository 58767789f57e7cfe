#include "actors/executor/flight/watches/traffic_watch.hpp"

#include <algorithm>

namespace godwit::executor {

void traffic_watch::look(effects& out, instant now) {
  if (!flight_.view.is_armed())
    return told_.clear();
  if (now.now_ns - looked_ns_ < look_period_ns)
    return;
  looked_ns_ = now.now_ns;
  for (const auto& each : flight_.traffic.warnings(now.now_ns))
    on_close(out, "collision " + std::to_string(each.source) + " " + std::to_string(each.id),
             "the autopilot warns no more of a collision with " + each.name, each.sentence, now);
  const auto seen = flight_.traffic.all(flight_.configured.close_traffic, now.now_ns);
  for (const auto& each : seen.aircraft)
    if (each.is_close)
      on_close(out, "aircraft " + std::to_string(each.icao),
               "aircraft " + each.name + " is close no more, as far as it is heard", "aircraft close: " + each.sentence,
               now);
  std::erase_if(told_, [&](const told& each) {
    const bool is_over = now.now_ns - each.close_ns >= apart_for_ns;
    if (is_over)
      out.emplace_back(announce{each.end, false});
    return is_over;
  });
}

void traffic_watch::on_close(effects& out, const std::string& key, const std::string& end, const std::string& sentence,
                             instant now) {
  const auto known = std::ranges::find(told_, key, &told::key);
  if (known != told_.end()) {
    known->close_ns = now.now_ns;
    return;
  }
  if (told_.size() == max_told)
    return;
  told_.push_back({key, end, now.now_ns});
  out.emplace_back(announce{sentence, true});
}

} // namespace godwit::executor
