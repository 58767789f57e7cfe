#include "programs/godwit-drill/flight_simulation/flight_record.hpp"

#include <algorithm>
#include <cstdio>
#include <span>
#include <utility>

#include "actors/domain/geo/geodesic.hpp"
#include "io/fields/binary.hpp"

namespace godwit::drill {

void flight_record::begin_process(const runtime::directory& names, const runtime::time_source& time,
                                  std::uint64_t seed) {
  directory_ = &names;
  time_ = &time;
  wall_offset_ns_ = time.wall_ns() - time.monotonic_ns();
  incarnations_.clear();
  ++run_;
  seeds_.push_back(seed);
  if (!trace_folder_.empty())
    open_trace(names, time);
}

void flight_record::open_trace(const runtime::directory& names, const runtime::time_source& time) {
  trace_.reset(); // that of the process before has its end
  runtime::trace_options options;
  options.folder = trace_folder_;
  options.run = run_;
  options.program = "godwit-drill";
  auto opened = runtime::trace_renderer::open(std::move(options), names, time, trace_health_,
                                              runtime::tick_scale::of_nanoseconds());
  if (opened)
    trace_ = *std::move(opened);
  else
    std::fprintf(stderr, "godwit-drill: %s\n", opened.error().c_str());
}

void flight_record::record(const runtime::trace_entry& entry, const runtime::message_type& type,
                           const void* body) noexcept {
  ++deliveries_;
  const auto& actor = directory_->name(entry.actor);
  auto& newest = incarnations_[actor];
  newest = std::max(newest, entry.incarnation);
  const bool is_report = type.name == "mission_client.report_progress" && entry.how == runtime::outcome::handled;
  if (is_report && reports_until_forgotten_ > 0 && --reports_until_forgotten_ == 0)
    return;
  runtime::delivery each;
  each.run = run_;
  each.id = entry.id;
  each.cause = entry.cause;
  each.began_ns = entry.began;
  each.duration_ns = entry.ended - entry.began;
  if (entry.clock_ns != 0) {
    each.clock_offset_ns = entry.clock_ns - entry.began;
    each.wall_offset_ns = entry.wall_ns - entry.began - wall_offset_ns_;
  }
  each.actor = names_.number(actor);
  each.sender = names_.number(directory_->name(entry.sender));
  each.type = names_.number(type.name);
  each.incarnation = entry.incarnation;
  each.how = entry.how;
  io::byte_sink sink(memory_);
  type.encode(sink, body);
  text_.clear();
  if (sink.overflow()) {
    each.oversize = true;
  } else {
    io::byte_source source(std::span<const std::byte>(memory_.data(), sink.used()));
    type.append_decoded(text_, source);
  }
  each.body = text_;
  if (trace_)
    trace_->write(entry, type, std::span<const std::byte>(memory_.data(), sink.used()), sink.overflow());
  checker_.take(each, names_);
  if (!listen_)
    return;
  each.began_ns += wall_offset_ns_;
  listen_(each);
}

std::uint32_t flight_record::incarnation_of(const std::string& actor) const {
  const auto found = incarnations_.find(actor);
  return found == incarnations_.end() ? 0 : found->second;
}

std::vector<std::string> flight_record::broken() const {
  std::vector<std::string> result;
  for (const auto& each : checker_.judge())
    if (each.how == invariants::verdict::violated)
      result.push_back(std::string(each.which->name) + ": " + each.findings.front().what);
  return result;
}

void flight_track::look(const sim::vehicle& vehicle, std::int64_t now_ns) {
  next_look_ns_ = now_ns + look_every_ns;
  const auto seen = vehicle.describe().where;
  const bool stands = !places_.empty() && places_.back().latitude_deg == seen.latitude_deg &&
                      places_.back().longitude_deg == seen.longitude_deg;
  if (!stands)
    places_.push_back({now_ns, seen.latitude_deg, seen.longitude_deg});
}

bool flight_track::was_near(const mission::position& where, double metres, std::int64_t upto_ns) const {
  return std::ranges::any_of(places_, [&](const place& each) {
    return each.at_ns <= upto_ns && geo::distance_m(geo::point{each.latitude_deg, each.longitude_deg},
                                                    geo::point{where.latitude, where.longitude}) <= metres;
  });
}

} // namespace godwit::drill
