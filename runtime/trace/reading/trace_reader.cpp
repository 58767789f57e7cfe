#include "runtime/trace/reading/trace_reader.hpp"

#include <algorithm>
#include <system_error>
#include <tuple>
#include <utility>
#include <variant>

#include <nlohmann/json.hpp>

namespace godwit::runtime {

namespace {

constexpr std::string_view trace_loss_name = "runtime.trace_loss"; // trace_renderer.hpp
constexpr std::string_view run_metadata = "godwit.run";
constexpr std::string_view lost_metadata = "godwit.lost";
constexpr std::string_view unknown_type = "?";

std::uint64_t size_of(const trace_file& file) {
  std::error_code code;
  const auto size = std::filesystem::file_size(file.path, code);
  return code ? 0 : size;
}

std::uint64_t number_in(const io::mcap::string_map& values, const std::string& name) {
  const auto found = values.find(name);
  return found == values.end() ? 0 : std::strtoull(found->second.c_str(), nullptr, 10);
}

} // namespace

trace_reader::trace_reader(std::vector<trace_file> files, name_table& names, time_span_ns wanted)
    : files_(std::move(files)), names_(names), wanted_(wanted), trace_loss_type_(names.number(trace_loss_name)) {
  for (const auto& each : files_)
    total_bytes_ += size_of(each);
}

bool trace_reader::next(delivery& to) {
  for (;;) {
    if (resume_at_ ? !go_on() : !reader_ && !open_next())
      return false;
    const auto item = reader_->next();
    if (!item) {
      note({.kind = loss_kind::unreadable, .what = item.error().what, .is_hole = true});
      end_file();
    } else if (const auto* message = std::get_if<io::mcap::message_record>(&*item)) {
      if (take(*message, to))
        return true;
    } else if (const auto* defined = std::get_if<io::mcap::channel_record>(&*item)) {
      define(defined->id, defined->topic);
    } else if (const auto* metadata = std::get_if<io::mcap::metadata_record>(&*item)) {
      take(*metadata);
    } else if (const auto* lost = std::get_if<io::mcap::unreadable>(&*item)) {
      take(*lost);
    } else if (std::holds_alternative<io::mcap::end_of_file>(*item)) {
      end_file();
    }
  }
}

void trace_reader::look_for_files() {
  if (!list_)
    return;
  for (auto& each : list_()) {
    const bool is_newer =
        files_.empty() || std::tie(each.run, each.number) > std::tie(files_.back().run, files_.back().number);
    if (is_newer)
      files_.push_back(std::move(each));
  }
}

// The open file may have grown, or has been ended and followed by another one.
bool trace_reader::go_on() {
  look_for_files();
  auto now = std::make_unique<io::mcap::file_source>();
  const bool is_there = now->open(files_[next_file_ - 1].path).has_value();
  const bool has_grown = is_there && now->size_bytes() > *resume_at_;
  if (!has_grown && next_file_ == files_.size())
    return false;
  if (is_there)
    source_ = std::move(now); // else it was deleted to keep the bound, and what we have of it is all
  reader_.emplace(*source_, io::mcap::read_limits{}, *resume_at_);
  resume_at_.reset();
  return true;
}

bool trace_reader::open_next() {
  if (next_file_ == files_.size())
    look_for_files();
  while (next_file_ < files_.size()) {
    const auto& file = files_[next_file_++];
    begin_run(file);
    source_ = std::make_unique<io::mcap::file_source>();
    if (const auto opened = source_->open(file.path); !opened) {
      note({.kind = loss_kind::unreadable, .what = opened.error().what, .is_hole = true});
      continue;
    }
    channels_.clear();
    const auto summary = io::mcap::read_summary(*source_);
    if (summary && *summary) {
      if (!is_wanted(**summary)) {
        ++counts_.files_skipped;
        done_bytes_ += source_->size_bytes();
        continue;
      }
      for (const auto& each : (*summary)->channels)
        define(each.id, each.topic);
    }
    reader_.emplace(*source_);
    ++counts_.files;
    counts_.bytes += source_->size_bytes();
    return true;
  }
  return false;
}

bool trace_reader::is_wanted(const io::mcap::file_summary& summary) const {
  if (!summary.statistics)
    return true;
  const auto& of = *summary.statistics;
  return of.message_count == 0 || (static_cast<std::int64_t>(of.start_time_ns) < wanted_.to_ns &&
                                   static_cast<std::int64_t>(of.end_time_ns) >= wanted_.from_ns);
}

void trace_reader::begin_run(const trace_file& file) {
  if (file.run != run_ || next_file_ == 1) {
    run_ = file.run;
    number_ = 0;
    newest_ns_ = 0;
    dropped_ = 0;
    unwritten_ = 0;
    if (file.number > 1)
      note({.kind = loss_kind::begin_missing,
            .what = "the first " + std::to_string(file.number - 1) + " segments of the run are not there"});
  } else if (file.number > number_ + 1) {
    note({.kind = loss_kind::gap,
          .what = std::to_string(file.number - number_ - 1) + " segments before this one are not there",
          .is_hole = true});
  }
  number_ = file.number;
}

void trace_reader::define(io::mcap::channel_id id, std::string_view topic) {
  const auto slash = topic.rfind('/');
  if (slash == std::string_view::npos || slash == 0 || !topic.starts_with('/'))
    return; // not one of the trace's
  const auto at = static_cast<std::size_t>(id);
  if (channels_.size() <= at)
    channels_.resize(at + 1);
  channels_[at] = {true, names_.number(topic.substr(1, slash - 1)), names_.number(topic.substr(slash + 1)), 0};
}

std::uint32_t trace_reader::number_of(std::string_view name, std::uint32_t& guess) {
  if (names_.name(guess) != name)
    guess = names_.number(name);
  return guess;
}

bool trace_reader::take(const io::mcap::message_record& message, delivery& to) {
  record_fields fields;
  const std::string_view text(reinterpret_cast<const char*>(message.data.data()), message.data.size());
  if (!parser_.parse(text, fields)) {
    ++unknown_;
    return false;
  }
  const auto at = static_cast<std::size_t>(message.channel);
  if (channels_.size() <= at)
    channels_.resize(at + 1);
  auto& from = channels_[at];
  if (!from.is_known) {
    ++unknown_;
    from.type = names_.number(unknown_type);
  }
  const auto at_ns = static_cast<std::int64_t>(message.log_time_ns);
  newest_ns_ = std::max(newest_ns_, at_ns);
  if (from.type == trace_loss_type_)
    note_trace_loss(fields.body);
  if (!wanted_.contains(at_ns))
    return false;
  to = {.run = run_,
        .id = fields.id,
        .cause = fields.cause,
        .began_ns = at_ns,
        .duration_ns = fields.duration_ns,
        .clock_offset_ns = fields.clock_offset_ns,
        .wall_offset_ns = fields.wall_offset_ns,
        .actor = number_of(fields.actor, from.actor),
        .sender = number_of(fields.sender, from.sender),
        .type = from.type,
        .incarnation = fields.incarnation,
        .how = fields.how,
        .oversize = fields.oversize,
        .body = fields.body};
  ++counts_.deliveries;
  constexpr std::uint64_t progress_mask = (1U << 15U) - 1;
  if (progress_ && (counts_.deliveries & progress_mask) == 0)
    progress_(done_bytes_, total_bytes_);
  return true;
}

void trace_reader::note_trace_loss(std::string_view body) {
  const auto told = nlohmann::json::parse(body, nullptr, false);
  const auto number = [&](const char* name) {
    return told.is_object() && told.contains(name) && told[name].is_number_unsigned() ? told[name].get<std::uint64_t>()
                                                                                      : std::uint64_t{0};
  };
  const auto dropped = number("dropped");
  const auto unwritten = number("unwritten");
  if (dropped > dropped_)
    note({.kind = loss_kind::dropped,
          .records = dropped - dropped_,
          .what = "more was recorded than the trace could take",
          .is_hole = true});
  if (unwritten > unwritten_)
    note(
        {.kind = loss_kind::unwritten, .records = unwritten - unwritten_, .what = "the disk refused", .is_hole = true});
  dropped_ = std::max(dropped, dropped_);
  unwritten_ = std::max(unwritten, unwritten_);
}

void trace_reader::take(const io::mcap::metadata_record& metadata) {
  if (metadata.name == run_metadata && run_ == 0)
    run_ = number_in(metadata.values, "run");
  if (metadata.name == run_metadata)
    about_[run_].insert(metadata.values.begin(), metadata.values.end());
  if (metadata.name == lost_metadata)
    note({.kind = loss_kind::unwritten,
          .records = number_in(metadata.values, "messages"),
          .what = "the disk refused",
          .is_hole = true});
}

const trace_reader::string_map& trace_reader::about(std::uint64_t run) const {
  static const string_map nothing;
  const auto found = about_.find(run);
  return found == about_.end() ? nothing : found->second;
}

// A cut is a hole only if records of this run stand after it.
void trace_reader::take(const io::mcap::unreadable& lost) {
  if (list_ && lost.is_cut && next_file_ == files_.size()) {
    resume_at_ = lost.offset;
    reader_.reset();
    return;
  }
  const bool is_last = next_file_ == files_.size() || files_[next_file_].run != run_;
  note({.kind = lost.is_cut ? loss_kind::cut : loss_kind::unreadable,
        .offset = lost.offset,
        .bytes = lost.bytes,
        .what = lost.why,
        .is_hole = lost.may_hold_messages && !(lost.is_cut && is_last)});
}

void trace_reader::note(loss what) {
  if (losses_.size() == max_losses) {
    ++losses_not_kept_;
    return;
  }
  what.run = run_;
  what.file = files_[next_file_ - 1].path.string();
  what.after_ns = newest_ns_;
  losses_.push_back(std::move(what));
}

void trace_reader::end_file() {
  if (const auto unknown = std::exchange(unknown_, 0); unknown > 0)
    note({.kind = loss_kind::unknown,
          .records = unknown,
          .what = "records are no deliveries, or of a channel that is not known",
          .is_hole = true});
  done_bytes_ += source_->size_bytes();
  reader_.reset();
  source_.reset();
  if (progress_)
    progress_(done_bytes_, total_bytes_);
}

} // namespace godwit::runtime
