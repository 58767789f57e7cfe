#include "programs/godwit-trace/tlog_recording.hpp"

#include <filesystem>
#include <system_error>

namespace godwit::trace_tool {

namespace fs = std::filesystem;

tl::expected<void, std::string> tlog_recording::open(const std::string& file) {
  std::error_code ignored;
  const auto folder = fs::path(file).parent_path();
  if (fs::is_directory(file, ignored))
    return tl::make_unexpected(file + ": it is a folder, not a file");
  if (!folder.empty() && !fs::is_directory(folder, ignored))
    return tl::make_unexpected(file + ": there is no folder " + folder.string());
  const auto opened = writer_.open({.file = file, .file_bytes = file_bytes, .older_files = older_files});
  if (!opened)
    return tl::make_unexpected(opened.error().message());
  file_ = file;
  return {};
}

std::string tlog_recording::write(std::uint64_t time_us, const io::mavlink::frame_view& frame) {
  return file_.empty() ? std::string() : once(writer_.write(time_us, frame));
}

std::string tlog_recording::flush() { return once(writer_.flush()); }

std::string tlog_recording::close() {
  if (file_.empty())
    return {};
  const auto closed = writer_.close();
  const auto& counts = writer_.counts();
  std::string sentence = file_ + ": " + std::to_string(counts.frames_written) + " frames recorded";
  if (counts.keys_withheld != 0)
    sentence += ", " + std::to_string(counts.keys_withheld) + " with a key left out";
  if (counts.frames_lost != 0)
    sentence += ", " + std::to_string(counts.frames_lost) + " lost";
  return closed ? sentence : sentence + " (" + closed.error().message() + ")";
}

std::string tlog_recording::once(const io::mcap::result<void>& result) {
  if (result || told_)
    return {};
  told_ = true;
  return "the recording can not be written: " + result.error().message();
}

} // namespace godwit::trace_tool
