#include "runtime/trace/trace_renderer.hpp"

#include <concepts>
#include <utility>

#include <nlohmann/json.hpp>

#include "io/fields/binary.hpp"
#include "io/fields/json_text.hpp"

namespace godwit::runtime {

namespace {

// The record around a message, as JSON Schema.
nlohmann::json record_schema(const message_type& type) {
  using nlohmann::json;
  const json whole{{"type", "integer"}};
  const json text{{"type", "string"}};
  return {{"$schema", "http://json-schema.org/draft-07/schema#"},
          {"title", type.name},
          {"type", "object"},
          {"properties",
           {{"id", whole},
            {"cause", whole},
            {"actor", text},
            {"incarnation", whole},
            {"sender", text},
            {"duration_ns", whole},
            {"clock_offset_ns", whole},
            {"wall_offset_ns", whole},
            {"outcome", text},
            {"message", type.schema()},
            {"oversize", {{"type", "boolean"}}}}},
          {"required", {"id", "cause", "actor", "incarnation", "sender", "duration_ns", "outcome"}}};
}

template <std::integral N>
void append_member(std::string& out, std::string_view name, N value) {
  out += name;
  io::append_json_number(out, value);
}

} // namespace

tl::expected<std::unique_ptr<trace_renderer>, std::string>
trace_renderer::open(trace_options options, const directory& names, const time_source& time, health_board& health,
                     tick_scale scale) {
  std::unique_ptr<trace_renderer> result(new trace_renderer(names, time, health, scale));
  io::mcap::rotating_writer_options files;
  files.segments.folder = options.folder;
  files.segments.segment_bytes = options.segment_bytes;
  files.segments.total_bytes = options.total_bytes;
  files.run = options.run;
  files.run_info = {{"program", options.program},
                    {"run", std::to_string(options.run)},
                    {"monotonic_to_utc_ns", std::to_string(result->wall_offset_ns_)}};
  files.run_info.insert(options.about.begin(), options.about.end());
  files.flush_interval_ns = static_cast<std::uint64_t>(std::chrono::nanoseconds(options.flush).count());
  if (auto opened = result->writer_.open(std::move(files)); !opened)
    return tl::unexpected("the trace can not be written: " + opened.error().message());
  for (const auto& each : result->writer_.folder().complete_all())
    if (!each.outcome)
      health.post("trace", health_colour::yellow,
                  "an earlier segment is damaged and was left as it is: " + each.outcome.error().message());
  return result;
}

trace_renderer::channel* trace_renderer::channel_for(const trace_entry& entry, const message_type& type) {
  const auto [found, is_new] = channels_.try_emplace({entry.actor, &type});
  if (!is_new)
    return &found->second;
  const auto schema_text = record_schema(type).dump();
  const auto schema = writer_.add_schema(std::string(type.name), "jsonschema", io::mcap::bytes_of(schema_text));
  if (schema) {
    const auto topic = '/' + names_.name(entry.actor) + '/' + std::string(type.name);
    if (const auto added = writer_.add_channel(*schema, topic, "json")) {
      found->second.id = *added;
      return &found->second;
    }
  }
  channels_.erase(found);
  return nullptr;
}

const std::string& trace_renderer::quoted_name(std::uint32_t actor) {
  while (quoted_names_.size() <= actor) {
    const auto number = static_cast<std::uint32_t>(quoted_names_.size());
    io::append_json_string(quoted_names_.emplace_back(), names_.name(number));
  }
  return quoted_names_[actor];
}

// What the clocks of the system showed the handler: the times in the trace are those of the processor's counter.
void trace_renderer::append_clocks(const trace_entry& entry) {
  if (entry.clock_ns == 0)
    return;
  const auto began_ns = scale_.to_monotonic_ns(entry.began);
  append_member(text_, R"(,"clock_offset_ns":)", entry.clock_ns - began_ns);
  append_member(text_, R"(,"wall_offset_ns":)", entry.wall_ns - began_ns - wall_offset_ns_);
}

void trace_renderer::render(const trace_entry& entry, const message_type& type, std::span<const std::byte> payload,
                            bool oversize) {
  text_.clear();
  append_member(text_, R"({"id":)", entry.id);
  append_member(text_, R"(,"cause":)", entry.cause);
  text_ += R"(,"actor":)";
  text_ += quoted_name(entry.actor);
  append_member(text_, R"(,"incarnation":)", entry.incarnation);
  text_ += R"(,"sender":)";
  text_ += quoted_name(entry.sender);
  append_member(
      text_, R"(,"duration_ns":)",
      static_cast<std::uint64_t>(std::max<std::int64_t>(scale_.to_duration_ns(entry.ended - entry.began), 0)));
  append_clocks(entry);
  text_ += R"(,"outcome":")";
  text_ += io::name_of(entry.how);
  if (oversize) {
    text_ += R"(","oversize":true})";
    return;
  }
  text_ += R"(","message":)";
  io::byte_source source(payload);
  type.append_decoded(text_, source);
  text_ += '}';
}

void trace_renderer::write(const trace_entry& entry, const message_type& type, std::span<const std::byte> payload,
                           bool oversize) {
  auto* const to = channel_for(entry, type);
  if (to == nullptr) {
    ++without_channel_;
    return;
  }
  render(entry, type, payload, oversize);
  const auto at_ns = static_cast<std::uint64_t>(scale_.to_monotonic_ns(entry.began) + wall_offset_ns_);
  ++given_;
  check(writer_.write({to->id, to->sequence++, at_ns, at_ns, io::mcap::bytes_of(text_)}));
}

void trace_renderer::note_dropped(std::uint64_t total) {
  const trace_loss now{total, unwritten_.load(std::memory_order_relaxed)};
  if (io::equal(now, told_))
    return;
  told_ = now;
  std::array<std::byte, sizeof(trace_loss)> memory{};
  io::byte_sink sink(memory);
  io::encode_value(sink, now);
  trace_entry entry;
  entry.began = tick_clock::now();
  entry.ended = entry.began;
  write(entry, type_of<trace_loss>(), std::span<const std::byte>(memory.data(), sink.used()), false);
}

void trace_renderer::check(const io::mcap::result<void>& result) {
  if (result.has_value() != failing_)
    return;
  failing_ = !result.has_value();
  if (failing_ && result.error().code == io::mcap::errc::gone)
    removed_ns_ = time_.monotonic_ns();
  if (failing_)
    health_.post("trace", health_colour::yellow, "the trace is not written: " + result.error().message());
  else if (removed_ns_)
    health_.post("trace", health_colour::yellow,
                 "the trace was removed while it was written, and what was in it is lost; it goes on in a new file");
  else
    health_.post("trace", health_colour::green, {});
}

void trace_renderer::show_removed() {
  if (failing_ || !removed_ns_ || time_.monotonic_ns() - *removed_ns_ < removed_shown_ns)
    return;
  removed_ns_.reset();
  health_.post("trace", health_colour::green, {});
}

void trace_renderer::tick() {
  scale_.adjust();
  check(writer_.tick(static_cast<std::uint64_t>(time_.monotonic_ns())));
  show_removed();
  publish_counts();
}

void trace_renderer::publish_counts() {
  const auto lost = writer_.counts().messages_lost;
  written_.store(given_ - lost, std::memory_order_relaxed);
  unwritten_.store(lost + without_channel_, std::memory_order_relaxed);
}

void trace_renderer::close() {
  check(writer_.close());
  publish_counts();
}

trace_counts trace_renderer::counts() const {
  trace_counts result;
  result.written = written_.load();
  result.unwritten = unwritten_.load();
  return result;
}

} // namespace godwit::runtime
