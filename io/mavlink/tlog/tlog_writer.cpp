#include "io/mavlink/tlog/tlog_writer.hpp"

#include <array>
#include <cassert>
#include <string>
#include <system_error>
#include <utility>

#include "io/mavlink/signing/link_policy.hpp"
#include "io/mavlink/signing/strip_signature.hpp"
#include "io/mavlink/tlog/tlog_reader.hpp"

namespace godwit::io::mavlink {

namespace fs = std::filesystem;

mcap::result<void> tlog_writer::open(tlog_writer_options options) {
  if (auto closed = close(); !closed)
    return closed;
  const auto refuse = [&](std::string what) {
    return tl::make_unexpected(mcap::error{mcap::errc::invalid_argument, options.file.string(), std::move(what), 0});
  };
  if (!options.file.has_filename() && !options.next_file)
    return refuse("a .tlog needs the name of a file");
  if (options.file_bytes < buffer_bytes)
    return refuse("file_bytes must be at least " + std::to_string(buffer_bytes));
  if (options.older_files > max_older_files)
    return refuse("older_files must be at most " + std::to_string(max_older_files));
  options_ = std::move(options);
  buffer_.reserve(buffer_bytes);
  return {};
}

mcap::result<void> tlog_writer::write(std::uint64_t timestamp_us, const frame_view& frame) {
  if (!may_be_logged(frame.id())) {
    ++counts_.keys_withheld;
    return {};
  }
  unsigned_frame_bytes copy;
  const frame_view bare = strip_signature(frame, copy);
  assert(!bare.is_signed());
  mcap::result<void> outcome;
  if (buffer_.size() + tlog_time_size + bare.size() > buffer_bytes)
    outcome = flush();
  std::array<std::byte, tlog_time_size> time;
  store_tlog_time(time, timestamp_us);
  buffer_.insert(buffer_.end(), time.begin(), time.end());
  buffer_.insert(buffer_.end(), bare.bytes().begin(), bare.bytes().end());
  ++frames_in_buffer_;
  return outcome;
}

mcap::result<void> tlog_writer::flush() {
  if (buffer_.empty())
    return {};
  auto written = provide_file().and_then([this] { return file_.append(buffer_); });
  (written ? counts_.frames_written : counts_.frames_lost) += std::exchange(frames_in_buffer_, 0);
  buffer_.clear();
  if (!written) {
    ++counts_.failures;
    if (written.error().code != mcap::errc::disk_full)
      give_up_file();
  }
  return written;
}

// A disk that was taken away and is back is not the one that the open file belongs to. What nothing was written into
// must not push out older files.
void tlog_writer::give_up_file() {
  const bool is_empty = file_.is_open() && file_.size_bytes() == 0;
  static_cast<void>(file_.close());
  std::error_code code;
  if (is_empty && fs::is_regular_file(file_.name(), code))
    fs::remove(file_.name(), code);
}

mcap::result<void> tlog_writer::close() {
  auto flushed = flush();
  auto closed = file_.close();
  return flushed ? closed : flushed;
}

mcap::result<void> tlog_writer::provide_file() {
  if (file_.is_open() && file_.size_bytes() + buffer_.size() <= options_.file_bytes)
    return {};
  return file_.close()
      .and_then([this] { return next_name(); })
      .and_then([this](const fs::path& name) { return file_.create(name); })
      .map([this] { ++counts_.files_opened; });
}

mcap::result<fs::path> tlog_writer::next_name() {
  if (options_.next_file)
    return options_.next_file();
  return make_room_for_name().map([this] { return name_of(0); });
}

// Every file becomes one older; the oldest gives way. From the oldest on, so that a stop in between loses no more.
mcap::result<void> tlog_writer::make_room_for_name() {
  std::error_code code;
  if (!fs::is_regular_file(name_of(0), code))
    return {}; // there is none, or it is a device, which does not get older
  if (options_.older_files == 0)
    fs::remove(name_of(0), code);
  for (unsigned age = options_.older_files; age > 0 && !code; --age)
    if (fs::exists(name_of(age - 1), code) && !code)
      fs::rename(name_of(age - 1), name_of(age), code);
  if (code)
    return tl::make_unexpected(mcap::system_error(name_of(0).string(), "rotate", code.value()));
  return {};
}

fs::path tlog_writer::name_of(unsigned age) const {
  if (age == 0)
    return options_.file;
  fs::path name = options_.file;
  return name.replace_filename(options_.file.stem().string() + "." + std::to_string(age) +
                               options_.file.extension().string());
}

} // namespace godwit::io::mavlink
