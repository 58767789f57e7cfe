#include "programs/godwitd/audit_reader.hpp"

#include <utility>

#include <boost/asio/post.hpp>

#include "actors/operator_bridge/audit_table.hpp"
#include "runtime/journal/journal_file.hpp"

namespace godwit::daemon {

namespace {

// The file may have been saved elsewhere since the last page.
audit_page_or_why read_from(const std::string& journal, const operator_bridge::audit_query& wanted) {
  const auto file = runtime::journal_in_use(journal);
  auto opened = runtime::open_for_reading(file, {});
  if (!opened)
    return tl::make_unexpected(opened.error().message());
  return operator_bridge::read_page(*opened, wanted).map_error([&](const io::sqlite::error& why) {
    return "the audit can not be read in " + file + ": " + why.message;
  });
}

} // namespace

audit_reader::~audit_reader() {
  thread_.stop();
  thread_.join();
}

void audit_reader::read(const operator_bridge::audit_query& wanted,
                        std::function<void(const audit_page_or_why&)> then) {
  if (waiting_.fetch_add(1) >= max_waiting) {
    --waiting_;
    return then(tl::make_unexpected(std::string("too many read the audit; ask again in a moment")));
  }
  boost::asio::post(thread_, [this, wanted, then = std::move(then)] {
    then(read_from(journal_, wanted));
    --waiting_;
  });
}

} // namespace godwit::daemon
